#pragma once
// Bottom-left fill of plates, by bitmaps.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "slicer/plate/detail/cell_shape.h"
#include "slicer/plate/detail/plate_bitmap.h"
#include "slicer/plate/detail/turned_piece.h"

namespace lamina::slicer {

// A copy of a piece on a plate.
struct LaidPiece {
  std::size_t turned = 0;  // index of the turned piece
  std::size_t plate = 0;
  Vec2 corner = Vec2(0);  // of the box, from that of the free area [mm]
};

// Plates that fill up. Pieces come in the order in which they are laid.
class BottomLeftFill {
 public:
  // area  of a plate, without its margin [mm]; none is larger
  // cell  side of the bitmap's cells [mm]
  // gap   between two pieces [mm]
  BottomLeftFill(std::span<const TurnedPiece> turned, unsigned turns, Vec2 area,
                 double cell, double gap);

  // Lays a copy of the piece on the first plate with room; returns nothing
  // where there is none and no plate may be added.
  std::optional<LaidPiece> lay(std::size_t piece, std::size_t most_plates);

 private:
  static constexpr std::int32_t kFull =
      std::numeric_limits<std::int32_t>::max();

  struct PlateState {
    PlateBitmap bitmap;
    // Left of this column is no place for the turned piece: plates only fill
    // up.
    std::vector<std::int32_t> first_columns;
  };

  std::optional<LaidPiece> lay_on(std::size_t plate, std::size_t piece);
  CellPlace last_place(std::size_t turned) const;
  void add_plate();

  std::span<const TurnedPiece> turned_;
  unsigned turns_;
  Vec2 area_;
  double cell_;
  std::int32_t border_;  // cells around the area, for growth
  std::vector<CellShape> shapes_;
  std::vector<PlateState> plates_;
};

}  // namespace lamina::slicer
