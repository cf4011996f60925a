#pragma once
// What the layer graph found, for people and as JSON.

#include <optional>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "slicer/check/print/layer_graph.h"
#include "slicer/supports/support_contacts.h"

namespace lamina::cli {

// "2 islands, 1 resin trap", "no problems found"; what is too small to matter
// is counted apart.
std::string finding_counts(const slicer::PrintCheck& print);

// The counts, a line for each finding that matters, and the peel. Each line
// ends with '\n'.
//
// source_lines  what made each finding, one text for each; empty if not known
std::string finding_table(const slicer::PrintCheck& print,
                          std::span<const std::string> source_lines);

// What supports touch, as a line, and as one for each source line of the part.
// Empty where there are no supports.
std::string contact_table(
    const std::optional<slicer::SupportMeasures>& supports,
    std::span<const std::string> source_lines);

nlohmann::ordered_json finding_json(const slicer::Finding& finding);
nlohmann::ordered_json peel_json(const slicer::Peel& peel);

}  // namespace lamina::cli
