#pragma once
// All samplers by one name, for tests that hold of each.

#include <memory>
#include <ostream>

#include "csg/scene.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {

std::ostream& operator<<(std::ostream& out, SamplerKind kind);

// Scene and grids must outlive the sampler. Throws where OpenGL is missing: a
// test that needs it must fail.
std::unique_ptr<Sampler> make_sampler(SamplerKind kind, const csg::Scene& scene,
                                      const RayGrid& rays,
                                      const LayerGrid& layers);

}  // namespace lamina::ldni
