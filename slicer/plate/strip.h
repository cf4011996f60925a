#pragma once
// Lays pieces on a strip of given depth, as short as the packer finds: the
// irregular strip packing problem, for which others have published results.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slicer/plate/packer.h"

namespace lamina::slicer {

struct Strip {
  double depth = 0;    // along y [mm]
  double gap = 0;      // least distance between two pieces [mm]
  unsigned turns = 2;  // evenly around z, from 0°: 1 to 36
  // How many million numbers the guided local search may look at; 0: the strip
  // is that of the bottom-left fill.
  double work = 1000;
  std::uint32_t seed = 1;  // of the search
};

struct StripPlan {
  std::vector<Placement> placements;  // piece by piece; all on plate 0
  double length = 0;                  // along x [mm]
};

// Every piece must fit the depth in one of the turns. Heights do not matter.
//
// throws  LimitExceeded for coordinates beyond plane::kGreatestCoordinate
StripPlan pack_strip(std::span<const Piece> pieces, const Strip& strip);

}  // namespace lamina::slicer
