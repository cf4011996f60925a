#pragma once
// Layers of square cells: what their regions overlap can be counted cell by
// cell, which judges the overlay and the graph.

#include <cstdint>
#include <random>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "slicer/check/print/layer_overlay.h"

namespace lamina::slicer {

class CellLayer {
 public:
  // A rim of cells is void.
  static constexpr int kSize = 12;

  // Solid cells at random, of a hundred so many. No two touch in a corner only.
  static CellLayer any(std::mt19937& random, unsigned percent);
  // This one with so many cells turned over at random.
  CellLayer changed(std::mt19937& random, int cells) const;

  bool is_solid(int x, int y) const {
    return cells_[static_cast<std::size_t>(y * kSize + x)] != 0;
  }
  // The contours, with cells so wide [mm], turned by an angle [rad].
  plane::Contours contours(double width, double angle) const;
  // By cell, the region that it belongs to.
  std::vector<std::uint32_t> regions() const;
  // By loop.
  std::vector<std::uint32_t> around() const;

 private:
  struct Corner {
    int x = 0;
    int y = 0;
    bool operator==(const Corner&) const = default;
  };
  void set(int x, int y, bool is_solid) {
    cells_[static_cast<std::size_t>(y * kSize + x)] = is_solid ? 1 : 0;
  }
  void mend_corners();
  std::vector<std::vector<Corner>> loops() const;

  std::vector<std::uint8_t> cells_ =
      std::vector<std::uint8_t>(static_cast<std::size_t>(kSize * kSize));
};

}  // namespace lamina::slicer
