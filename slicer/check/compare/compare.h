#pragma once
// Compares two stacks of layers, layer by layer (`lamina compare`).
//
// Layers at the same heights are compared in the plane: by the area that only
// one of them covers, and by how far the contours of one are from those of the
// other at most. The distance tells a wall that moved from one that is missing;
// the area tells how much of it. Loops are counted but decide nothing: two
// squares that touch in a corner are one loop or two.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plane/sweep/region_areas.h"
#include "slicer/check/compare/contour_distance.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

struct LoopCount {
  std::size_t regions = 0;  // loops that run counter-clockwise
  std::size_t holes = 0;

  bool operator==(const LoopCount&) const = default;
};

struct LayerDifference {
  std::size_t number = 0;  // from 1
  double z = 0;            // of the section in a, else in b [mm]
  double thickness = 0;    // 0: not known [mm]
  plane::RegionAreas areas;
  LoopCount loops_a;
  LoopCount loops_b;
  // Infinite where only one of them has contours.
  ContourDistance distance;
  // A design cut for the comparison was cut this much above z, to be on the
  // same side of a horizontal face in the plane of the section [mm].
  double moved = 0;

  double area() const { return areas.only_a + areas.only_b; }
};

// Loops narrower than this on the whole (2 · area / perimeter) count for areas
// and numbers, not for distances [mm]: ten times the distance of a tie, and
// what float32 numbers of a part of 100 mm resolve.
constexpr double kSliverWidth = 1e-5;

LayerDifference compare_layers(const plane::Contours& a,
                               const plane::Contours& b);

// Throws GeometryError where a layer's section is not higher than the one
// before.
void require_rising(const std::vector<Layer>& layers, const std::string& name);

// A layer of each; one may be null, where there is none.
struct LayerPair {
  const Layer* a = nullptr;
  const Layer* b = nullptr;
};

// Pairs layers whose sections are within kSameHeight. A layer below or above
// all layers of the other stack stays alone, or is left out where it is empty.
//
// shift   added to heights of b [mm]
// names   for messages
// throws  GeometryError where a layer between layers of the other has no
//         partner, and as require_rising() does
std::vector<LayerPair> pair_layers(const std::vector<Layer>& a,
                                   const std::vector<Layer>& b, double shift,
                                   const std::string& name_a,
                                   const std::string& name_b);
constexpr double kSameHeight = 1e-4;  // [mm], float32's rounding included

// shift  of b in the plane [mm]
LayerDifference compare_pair(const LayerPair& pair, Vec2 shift);

// Compares and numbers all pairs, on all processors.
std::vector<LayerDifference> compare(const std::vector<LayerPair>& pairs,
                                     Vec2 shift);

// The shift that moves the lower left corner of b's box, over all layers, and
// the lower side of its lowest layer with contours to those of a; 0 where one
// of them has no contour.
Vec3 aligning_shift(const std::vector<Layer>& a, const std::vector<Layer>& b);

// Sums over all layers.
struct ComparisonTotals {
  std::size_t layers = 0;
  std::size_t outside = 0;      // layers beyond the tolerance
  std::size_t other_loops = 0;  // layers whose loops differ in number
  double volume_a = 0;          // [mm³]
  double volume_b = 0;
  double volume_only_a = 0;
  double volume_only_b = 0;
  std::optional<std::size_t> worst;  // index of the layer; none: no layer
};

// The worst layer has the greatest distance, and of such the greatest area that
// differs.
ComparisonTotals sum_up(const std::vector<LayerDifference>& layers,
                        double tolerance);

}  // namespace lamina::slicer
