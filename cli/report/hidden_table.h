#pragma once
// Thin places that no layer shows, as a table for people.

#include <optional>
#include <string>
#include <vector>

#include "compiler/look_at.h"

namespace lamina::cli {

// Empty where there are none; a line where they were not searched for. Each
// line ends with '\n'.
//
// width  that they are thinner than [mm]
std::string hidden_table(
    const std::optional<std::vector<compiler::HiddenThin>>& hidden,
    double width);

}  // namespace lamina::cli
