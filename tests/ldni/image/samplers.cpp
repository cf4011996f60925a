#include "tests/ldni/image/samplers.h"

#include "ldni/image/sampler.h"
#include "tests/ldni/gl/shared_raster.h"

namespace lamina::ldni {

std::ostream& operator<<(std::ostream& out, SamplerKind kind) {
  switch (kind) {
    case SamplerKind::kScanline:
      return out << "scanline";
    case SamplerKind::kGl:
      return out << "gl";
  }
  return out;
}

std::unique_ptr<Sampler> make_sampler(SamplerKind kind, const csg::Scene& scene,
                                      const RayGrid& rays,
                                      const LayerGrid& layers) {
  if (kind == SamplerKind::kScanline) {
    return make_scanline_sampler(scene, rays, layers);
  }
  return make_gl_sampler(scene, rays, layers, shared_raster());
}

}  // namespace lamina::ldni
