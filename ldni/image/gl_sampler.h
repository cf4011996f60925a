#pragma once
// The sampler of Zeng et al. 2011: OpenGL draws each leaf as seen along the
// rays, one pixel for a ray in a layer, and what is drawn over a pixel's middle
// is what the ray meets.
//
// OpenGL says which faces a ray meets (face_raster.h); where it meets them is
// computed here, in double precision, from the face's plane, and kept within
// the face's own depths. Corners are drawn up to 1/256 pixel from where they
// are (detail/face_projector.h). So a ray meets what the exact sampler meets,
// unless an edge passes it within 1/256 of pitch and thickness. There
//   - another face can be met, and so another number of samples;
//   - depths differ by no more than twice what the steepest of faces so near
//     rises over that distance.
//
// Every pixel of a closed leaf is drawn as often from the front as from the
// back. Where a driver that rasterises otherwise breaks this, the pixel is
// sampled exactly instead and counted.

#include <memory>

#include "csg/scene.h"
#include "ldni/gl/face_raster.h"
#include "ldni/image/ray_grid.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {

// Scene and grids must outlive the sampler; layers must be of equal thickness.
//
// Cost of an image: the leaf's vertices and triangles, made for it if it is a
// loft; a drawing of those that can cover a pixel; the samples, the pixels of
// the box. Memory: for the leaf, and at most 128 MiB for what is drawn at a
// time.
std::unique_ptr<Sampler> make_gl_sampler(const csg::Scene& scene,
                                         const RayGrid& rays,
                                         const LayerGrid& layers,
                                         std::unique_ptr<FaceRaster> raster);

}  // namespace lamina::ldni
