#pragma once
// Footprints in each of their turns, as both ways of packing take them.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/region/region.h"
#include "slicer/plate/packer.h"

namespace lamina::slicer {

// Places are those of the lower left corner of the footprint's box.
struct TurnedPiece {
  std::size_t piece = 0;
  double turn_deg = 0;
  Box2 box;  // of the footprint itself, turned [mm]
  // Holds all that is nearer than half the gap to the footprint; turned, the
  // corner of the box at the origin. It has few vertices.
  plane::Region grown;

  Vec2 size() const { return box.size(); }
};

// How far grown footprints reach beyond the footprints, at most [mm].
double greatest_growth(double gap);

// Turn by turn of piece by piece.
std::vector<TurnedPiece> turn_pieces(std::span<const Piece> pieces, double gap,
                                     unsigned turns);

}  // namespace lamina::slicer
