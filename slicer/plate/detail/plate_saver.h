#pragma once
// Saves a plate: moves the pieces of the last one to those before it.
//
// A piece is put on a full plate, where it overlaps others, and the guided
// local search looks for places for all of them. If it finds some, the plate
// has them; else it stays as it was.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "slicer/plate/detail/bottom_left.h"
#include "slicer/plate/detail/guided_search.h"
#include "slicer/plate/detail/turned_piece.h"

namespace lamina::slicer {

class PlateSaver {
 public:
  // area  of a plate, without its margin [mm]
  // work  as for GuidedSearch
  PlateSaver(std::span<const TurnedPiece> turned, unsigned turns, Vec2 area,
             double work);

  // Adds a copy of the piece to one of these plates, the last of them first,
  // and moves others on it; false, and nothing moves, where no plate has room.
  bool add(std::size_t piece, std::size_t plates, std::vector<LaidPiece>& laid);

  // Moves all pieces of the last plate to the others; false, and nothing moves,
  // where that fails.
  bool empty_last(std::size_t plates, std::vector<LaidPiece>& laid);

 private:
  bool add_to(std::size_t plate, std::size_t piece,
              std::vector<LaidPiece>& laid);
  double covered(std::size_t turned) const;

  std::span<const TurnedPiece> turned_;
  unsigned turns_;
  Vec2 area_;
  NoFitTables tables_;
  GuidedSearch search_;
};

}  // namespace lamina::slicer
