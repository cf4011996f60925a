#pragma once
// The solid of each layer, to be asked of places.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/edge_tree.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

class LayerSolids {
 public:
  // layers  must outlive it
  explicit LayerSolids(std::span<const Layer> layers);

  std::size_t count() const { return layers_.size(); }
  const Layer& layer(std::size_t i) const { return layers_[i]; }

  // How deep the place lies in the solid of layer i: the distance to its
  // contours, less than 0 outside [mm].
  double depth(std::size_t i, Vec2 place) const;
  // Whether all of the solid of layer i is farther from the place than that.
  bool is_free(std::size_t i, Vec2 place, double distance) const;
  // Whether the place, on the surface of a part in layer i, is on that of these
  // solids, as far as rounding and the tolerance of contours say. What was
  // subtracted there leaves its surface, so the layer below is asked, too.
  bool touches(std::size_t i, Vec2 place) const;
  // The nearest point of layer i's contours. There must be one.
  Vec2 nearest(std::size_t i, Vec2 place) const;

  // The first layer whose top is above the height; count() where none is.
  std::size_t layer_above(double height) const;

 private:
  struct Solid {
    plane::EdgeTree edges;
    Box2 box;
  };
  const Solid& solid(std::size_t i) const { return solids_[solid_of_[i]]; }

  std::span<const Layer> layers_;
  std::vector<Solid> solids_;  // layers with the same contours share one
  std::vector<std::size_t> solid_of_;
};

}  // namespace lamina::slicer
