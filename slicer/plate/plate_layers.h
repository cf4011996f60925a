#pragma once
// The layers of a plate: those of its pieces, turned and shifted.
//
// Each piece is sliced once, however many copies of it lie on plates, and its
// layers wait in memory. All pieces stand at height 0 and have layers of one
// thickness, so layer i of a plate holds layer i of each.

#include <cstddef>
#include <span>
#include <vector>

#include "slicer/contour/layer.h"
#include "slicer/plate/packer.h"

namespace lamina::slicer {

class PlateLayers {
 public:
  // pieces      the layers of each, ascending, without gaps; outlives it
  // placements  of one plate
  // thickness   of all layers [mm]
  PlateLayers(std::span<const std::vector<Layer>> pieces,
              std::vector<Placement> placements, double thickness);

  std::size_t count() const { return count_; }
  Box3 box() const;
  Layer layer(std::size_t index) const;

  // Hands all layers to a sink, encoded by several threads.
  void send_to(LayerSink& sink) const;

 private:
  // The index of a piece's first layer among those from height 0 on.
  std::size_t first_of(const std::vector<Layer>& layers) const;

  std::span<const std::vector<Layer>> pieces_;
  std::vector<Placement> placements_;
  double thickness_;
  std::size_t count_ = 0;
};

}  // namespace lamina::slicer
