#pragma once
// How far written contours can be from the exact section of the design.

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "ldni/section/leaf_section.h"
#include "plane/tie_distance.h"

namespace lamina::slicer {

// Bounds [mm], by cause, on how far any point of a written contour is from the
// boundary of the Boolean of the leaves in the plane of the section, which
// --compensate may have moved. Walls and gaps thinner than a tie have no bound.
struct Deviation {
  double ties = kTieDistance;              // faces this near are one
  double clusters = plane::kClusterWidth;  // what the ray takes for one x
  double compensation = 0;                 // arcs of moved contours
  double simplification = 0;               // vertices left out
  double rounding = 0;                     // of the format's coordinates
  std::optional<double> facets = {};  // of leaves, from their curves, if known

  // From the exact section of the facetted leaves.
  double from_section() const {
    return ties + clusters + compensation + simplification + rounding;
  }
  // From the section of the curved solids.
  std::optional<double> from_curves() const {
    if (!facets) return std::nullopt;
    return from_section() + *facets;
  }
};

// The most that rounding to 32-bit numbers moves a point whose coordinates are
// up to `greatest` in magnitude [mm].
inline double float32_rounding(double greatest) {
  const auto rounded = static_cast<float>(greatest);
  const float next =
      std::nextafter(rounded, std::numeric_limits<float>::infinity());
  // Half a step in x and in y.
  return (static_cast<double>(next) - rounded) / 2 * std::numbers::sqrt2;
}

}  // namespace lamina::slicer
