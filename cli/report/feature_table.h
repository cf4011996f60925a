#pragma once
// Thin features as a table for people.

#include <cstddef>
#include <span>
#include <string>

#include "slicer/check/thin/thin_features.h"

namespace lamina::cli {

// Of a table on the terminal.
inline constexpr std::size_t kMostLines = 20;

// How many features there are and where, the thinnest first and edges last.
// Features of one source line share a line, which shows the thinnest; low ones
// are only counted. Each line ends with '\n'.
//
// width    that they are thinner than [mm]
// source_lines  what made each, one text for a feature; empty if not known
std::string feature_table(std::span<const slicer::ThinFeature> features,
                          double width,
                          std::span<const std::string> source_lines);

}  // namespace lamina::cli
