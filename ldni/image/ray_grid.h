#pragma once
// The rays of a layer, and boxes in whole rays and layers.
//
// All layers have their rays at the same x. The global box holds every ray and
// layer that can meet the result (GEBB of Zeng et al. 2011, section 3); the
// local box of an instance those that can meet that leaf (LBB). A depth image
// in a local box is read through the paper's index map
//   global ray   = ray_start   + local ray
//   global layer = layer_start + local layer
// so both boxes give the same samples, and only memory differs.

#include <cstdint>

#include "base/vec.h"
#include "ldni/section/grid.h"

namespace lamina::ldni {

// Rays along +y at x_j = origin + j·pitch, j < ray_count.
class RayGrid {
 public:
  RayGrid() = default;
  // The rays that meet [low_x, high_x]. The first one stands an irrational
  // share of the pitch inside: designs keep to round coordinates, and whether a
  // ray within a wall parallel to it meets the solid would be a matter of
  // chance.
  //
  // pitch  > 0 [mm]
  RayGrid(double low_x, double high_x, double pitch);

  std::uint32_t ray_count() const { return ray_count_; }
  double pitch() const { return pitch_; }
  double ray_x(std::uint32_t ray) const { return origin_ + ray * pitch_; }

  // Number of rays left of x. Rays [rays_below(a), rays_below(b)) meet a
  // segment from a to b > a: half-open, so that of two segments that share an
  // end exactly one meets a ray there. Never falls as x grows.
  std::uint32_t rays_below(double x) const {
    const double rays = (x - origin_) * rays_per_mm_;
    if (!(rays > 0)) return 0;
    if (rays >= ray_count_) return ray_count_;
    const auto whole = static_cast<std::uint32_t>(rays);
    return whole + (rays > whole ? 1 : 0);
  }

 private:
  double origin_ = 0;
  double pitch_ = 1;
  double rays_per_mm_ = 1;
  std::uint32_t ray_count_ = 0;
};

// A box of whole rays and layers of the grids.
struct GridBox {
  std::uint32_t ray_start = 0;
  std::uint32_t ray_count = 0;
  std::uint32_t layer_start = 0;
  std::uint32_t layer_count = 0;

  std::uint32_t ray_end() const { return ray_start + ray_count; }
  std::uint32_t layer_end() const { return layer_start + layer_count; }
  bool is_empty() const { return ray_count == 0 || layer_count == 0; }
  // Rays of all layers together.
  std::size_t pixel_count() const {
    return std::size_t{ray_count} * layer_count;
  }
};

// Whether each leaf is sampled in its own box or in that of the whole scene.
// The latter is the paper's normal LDNI, the baseline of its table 3.
enum class BoxMode : std::uint8_t { kLocal, kGlobal };

GridBox global_box(const RayGrid& rays, const LayerGrid& layers);

// Returns the rays and layers that `box` [mm] can meet, with a margin for the
// rounding of its bounds.
GridBox local_box(const Box3& box, const RayGrid& rays,
                  const LayerGrid& layers);

// Returns the part of `box` in layers [first_layer, first_layer + layer_count).
GridBox clip_to_layers(const GridBox& box, std::uint32_t first_layer,
                       std::uint32_t layer_count);

}  // namespace lamina::ldni
