#pragma once
// The sampler of Zeng et al. 2011: OpenGL draws each leaf as seen along the
// rays, one pixel for a ray in a layer, and what is drawn over a pixel's middle
// is what the ray meets.
//
// OpenGL says which faces (face_raster.h); where they are met is computed here,
// in double precision, from the face's plane, and kept within the face's own
// depths. Corners are drawn up to 1/256 pixel from where they are
// (detail/face_projector.h), so a ray sees what the exact sampler sees, but for
// rays with an edge within 1/256 of pitch and thickness. There
//   - another face can be seen, and so another number of samples;
//   - depths differ by no more than twice what the steepest of faces so near
//     rises over that distance.
//
// Every pixel of a closed leaf is drawn as often from the front as from the
// back. Should it not be so, because a driver rasterises otherwise, the pixel
// is sampled exactly instead and counted.

#include <cstdint>
#include <memory>

#include "csg/scene.h"
#include "ldni/gl/face_raster.h"
#include "ldni/image/ray_grid.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {

class GlSampler final : public Sampler {
 public:
  // Scene and grids must outlive the sampler; layers of equal thickness.
  GlSampler(const csg::Scene& scene, const RayGrid& rays,
            const LayerGrid& layers, std::unique_ptr<FaceRaster> raster);
  ~GlSampler() override;

  // Cost: the leaf's vertices and triangles, made for it if it is a loft; a
  // drawing of those that can cover a pixel; the samples, the pixels of the
  // box. Memory: for the leaf, and at most 128 MiB for what is drawn at a time.
  void sample(std::uint32_t instance, const GridBox& box,
              LeafImages& out) override;

  std::uint64_t repaired_pixels() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lamina::ldni
