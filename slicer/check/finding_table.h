#pragma once
// What the layer graph found, for people and as JSON.

#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "slicer/check/layer_graph.h"

namespace lamina::slicer {

// "2 islands, 1 resin trap", "nothing found"; what is too small to matter is
// counted apart.
std::string finding_counts(const PrintCheck& print);

// The counts, a line for each finding that matters, and the peel. Each line
// ends with '\n'.
//
// origins  what made each finding, one text for each; empty if not known
std::string finding_table(const PrintCheck& print,
                          std::span<const std::string> origins);

// "0.0356 mm², joined in layer 72": how much of it there is.
std::string size_text(const Finding& finding);

nlohmann::ordered_json finding_json(const Finding& finding);
nlohmann::ordered_json peel_json(const Peel& peel);

}  // namespace lamina::slicer
