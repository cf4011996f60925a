#pragma once
// All samplers by one name, for tests that hold of each.

#include <memory>
#include <ostream>

#include "csg/scene.h"
#include "ldni/gl/face_raster.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {

std::ostream& operator<<(std::ostream& out, SamplerKind kind);

// Scene and grids must outlive the sampler. Throws where OpenGL is missing: a
// test that needs it must fail.
std::unique_ptr<Sampler> make_sampler(SamplerKind kind, const csg::Scene& scene,
                                      const RayGrid& rays,
                                      const LayerGrid& layers);

// Draws by a raster that all tests of a process share: to make one takes longer
// than most tests.
std::unique_ptr<FaceRaster> shared_raster(GlMethod method);

}  // namespace lamina::ldni
