#pragma once
// The exact sampler, the reference for all others: it intersects faces with
// layers, and the segments that arise with rays, in double precision.
//
// A face is a triangle of a mesh, or of a loft a whole side quad or cap: they
// are planar, which saves half the segments, and no triangle of a primitive is
// ever stored.
//
// Watertight by three rules. A vertex is above a section or not by
// LayerGrid::layers_below alone. Where an edge crosses a section is computed
// from its lower to its upper end, so that both faces beside it get the same
// bits. And RayGrid::rays_below of these points decides which rays a segment
// meets. So the segments of a layer form closed loops, every ray enters a leaf
// as often as it leaves it, and rounding can only move a sample.

#include <memory>

#include "csg/scene.h"
#include "ldni/image/ray_grid.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {

// All arguments must outlive the sampler.
//
// Cost of an image: the rings of lofts, the vertices of rings that meet the
// box, the vertices and triangles of meshes, the samples, the pixels of the
// box.
std::unique_ptr<Sampler> make_scanline_sampler(const csg::Scene& scene,
                                               const RayGrid& rays,
                                               const LayerGrid& layers);

}  // namespace lamina::ldni
