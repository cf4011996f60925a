#pragma once
// What of a part's surface is seen when it is worn: that of the leaves whose
// `$visible` is true in the design. Whoever must leave a mark on the part, as
// supports do, asks where it may not be.

#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "csg/scene.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_solids.h"

namespace lamina::slicer {

class VisibleSurface {
 public:
  // No value where no leaf is visible.
  //
  // layers  of the whole part, in ascending order
  static std::optional<VisibleSurface> of(const csg::Scene& scene,
                                          std::span<const Layer> layers);

  // Whether a visible leaf makes the part's surface at this place, which is on
  // it. A subtracted leaf makes the surface that it leaves.
  bool is_at(Vec3 place) const;

  // The solids point into the layers.
  VisibleSurface(VisibleSurface&&) = default;
  VisibleSurface& operator=(VisibleSurface&&) = default;
  VisibleSurface(const VisibleSurface&) = delete;
  VisibleSurface& operator=(const VisibleSurface&) = delete;

 private:
  explicit VisibleSurface(std::vector<Layer> layers);

  std::vector<Layer> layers_;  // of the visible leaves, at all heights
  LayerSolids solids_;
};

}  // namespace lamina::slicer
