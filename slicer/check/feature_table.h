#pragma once
// Thin features as a table for people.

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "slicer/check/thin_features.h"

namespace lamina::slicer {

// Whether its thin place is lower than it may be wide. Such are the tops of
// domes, the lines where surfaces meet at a slant, and wires that lie flat. A
// place in one layer without thickness is not: its height is not known.
bool is_low(const ThinFeature& feature, double width);

// Whether its sides meet in an edge: it has no width.
bool is_edge(const ThinFeature& feature);

// Tables list features in ascending order of this: the thinnest first, edges
// last.
std::pair<bool, double> rank_of(const ThinFeature& feature);

// "wall" or "gap".
std::string_view name_of(ThinKind kind);

// How many features there are and where, the thinnest first and edges last.
// Features of one origin share a line, which shows the thinnest; low ones are
// only counted. Each line ends with '\n'.
//
// width    that they are thinner than [mm]
// origins  what made each, one text for a feature; empty if not known
std::string feature_table(std::span<const ThinFeature> features, double width,
                          std::span<const std::string> origins);

}  // namespace lamina::slicer
