#pragma once
// What hangs together in a stack of layers, by brute force on pixels: the judge
// of the layer graph.
//
// Pixels are the cells of a square grid. Of each layer some are wholly solid,
// some wholly void, and an edge passes through the rest, which count for both.
// So two answers bound the exact one: what hangs together through wholly solid
// pixels does, and what does not through pixels that may be solid does not.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/contour/layer.h"

namespace lamina::support {

class PixelGraph {
 public:
  // pitch  of the pixels [mm]
  PixelGraph(const std::vector<slicer::Layer>& layers, double pitch);

  // What the findings say wrongly of islands and resin traps, minor ones
  // included: one that must be there and is not, one that cannot be. A sentence
  // each.
  std::vector<std::string> complaints(
      const std::vector<slicer::Finding>& findings) const;

  std::size_t sure_islands() const { return sure_islands_; }
  std::size_t sure_traps() const { return sure_traps_; }

 private:
  // Bits of a pixel.
  static constexpr std::uint8_t kMayBeSolid = 1;
  static constexpr std::uint8_t kMayBeVoid = 2;

  std::size_t index(std::size_t layer, std::size_t row,
                    std::size_t column) const {
    return (layer * rows_ + row) * columns_ + column;
  }
  std::size_t pixel_at(std::size_t layer, Vec2 place) const;
  void draw(std::size_t layer, const plane::Contours& contours);
  // Numbers pixels with that bit, and without `not_bit`, by what hangs together
  // in a layer, or in all of them; 0 has none.
  template <bool kInSpace, bool kWithCorners>
  std::vector<std::uint32_t> label(std::uint8_t bit,
                                   std::uint8_t not_bit) const;
  void judge_islands(const std::vector<slicer::Finding>& findings,
                     std::vector<std::string>& words) const;
  void judge_traps(const std::vector<slicer::Finding>& findings,
                   std::vector<std::string>& words) const;

  double pitch_;
  Vec2 low_;
  std::size_t layers_;
  std::size_t rows_;
  std::size_t columns_;
  std::vector<std::uint8_t> pixels_;
  mutable std::size_t sure_islands_ = 0;
  mutable std::size_t sure_traps_ = 0;
};

}  // namespace lamina::support
