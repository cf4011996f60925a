#pragma once
// Lays pieces on the plates of a printer.
//
// A piece is known by its footprint and its height; copies of it are turned
// about z and shifted, on as few plates as the packer finds. The highest piece
// decides how long a plate takes, so pieces of like height share one.
//
// 1. Bottom-left fill: piece by piece, the higher and larger first, each at the
//    first free place from the plate's left side on, in the turn that reaches
//    the least far, on the first plate that has room. Whether a place is free
//    is asked of bitmaps, which hold more than the pieces.
// 2. Guided local search: pieces of the last plate are put on a plate before
//    it, where they overlap others; then pieces move to where they overlap
//    least until none does. A pair that goes on to overlap gets a higher weight
//    (detail/guided_search.h).
// 3. The outlines themselves are checked (distance.h).
//
// A piece may lie in the hole of another one. Whatever the number of threads,
// the same pieces give the same plates.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/region/region.h"

namespace lamina::slicer {

struct Piece {
  plane::Region footprint;  // of all its layers, with its supports [mm]
  double height = 0;        // [mm]
  std::size_t quantity = 1;
};

// From (0, 0) to `size`.
struct Plate {
  Vec2 size = Vec2(0);  // along x and y [mm]
  double gap = 0;       // least distance between two pieces [mm]
  double margin = 0;    // least distance between a piece and the edge [mm]
  unsigned turns = 8;   // evenly around z, from 0°: 1 to 36
  std::size_t most_plates = 0;  // 0: as many as are needed
  // How many million numbers the guided local search may look at, about a
  // second for a thousand; 0: none. Unlike seconds, it gives the same plan on
  // every machine.
  double work = 500;
};

// Where a copy lies: turned about the origin, then shifted (place() of
// footprint.h).
struct Placement {
  std::size_t piece = 0;
  std::size_t plate = 0;
  double turn_deg = 0;   // counter-clockwise
  Vec2 shift = Vec2(0);  // [mm]
  bool operator==(const Placement&) const = default;
};

struct PlatePlan {
  std::vector<Placement> placements;  // plate by plate, then piece by piece
  std::size_t plates = 0;
  // Pieces that fit an empty plate in no turn, ascending.
  std::vector<std::size_t> too_large;
  // Of each piece the copies for which `most_plates` had no room.
  std::vector<std::size_t> left_over;
};

// throws  LimitExceeded for coordinates beyond plane::kGreatestCoordinate
PlatePlan pack_plates(std::span<const Piece> pieces, const Plate& plate);

}  // namespace lamina::slicer
