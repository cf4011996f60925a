#pragma once
// Thin features as a table for people.

#include <span>
#include <string>
#include <string_view>

#include "slicer/check/thin_features.h"

namespace lamina::slicer {

// Whether the thin place goes on for fewer layers than make the width that was
// asked for.
// Such are the tops of domes, the lines where surfaces meet at a slant, and
// wires that lie flat.
bool is_low(const ThinFeature& feature, double width);

// Whether two sides meet there in an edge: it has no width.
bool is_edge(const ThinFeature& feature);

// "wall" or "gap".
std::string_view name_of(ThinKind kind);

// How many there are and where, the thinnest first and edges, which have no
// width, last; features of one origin in one line, which shows the thinnest.
// Low ones are only counted. Each line is ended by '\n'.
//
// width    that they are thinner than [mm]
// origins  what made each, one text a feature; empty if that is not known
std::string feature_table(std::span<const ThinFeature> features, double width,
                          std::span<const std::string> origins);

}  // namespace lamina::slicer
