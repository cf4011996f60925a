#pragma once
// What `lamina compare` prints: a table of layers, totals, a verdict; the same
// as JSON.

#include <string>

#include "compiler/tasks/comparison.h"

namespace lamina::cli {

// Ended by '\n'. With lists_all a row for each layer, else those that differ
// most.
std::string comparison_text(const compiler::ComparisonResult& result,
                            bool lists_all);

std::string comparison_json(const compiler::ComparisonResult& result);

}  // namespace lamina::cli
