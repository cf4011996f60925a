#include "tests/ldni/image/samplers.h"

#include "ldni/image/gl_sampler.h"
#include "ldni/image/scanline_sampler.h"

namespace lamina::ldni {
namespace {

FaceRaster& raster_of_all_tests(GlMethod method) {
  static const auto platform = open_gl(least_version(GlMethod::kList));
  static const auto list = make_face_raster(*platform, GlMethod::kList);
  static const auto peeling = make_face_raster(*platform, GlMethod::kPeeling);
  return method == GlMethod::kList ? *list : *peeling;
}

class SharedRaster : public FaceRaster {
 public:
  explicit SharedRaster(FaceRaster& raster) : raster_(raster) {}

  bool draw(std::span<const RasterCorner> corners, int width, int height,
            std::vector<Fragment>& fragments) override {
    return raster_.draw(corners, width, height, fragments);
  }

 private:
  FaceRaster& raster_;
};

}  // namespace

std::ostream& operator<<(std::ostream& out, SamplerKind kind) {
  switch (kind) {
    case SamplerKind::kScanline:
      return out << "scanline";
    case SamplerKind::kGl:
      return out << "gl";
    case SamplerKind::kGlPeeling:
      return out << "peeling";
  }
  return out;
}

std::unique_ptr<FaceRaster> shared_raster(GlMethod method) {
  return std::make_unique<SharedRaster>(raster_of_all_tests(method));
}

std::unique_ptr<Sampler> make_sampler(SamplerKind kind, const csg::Scene& scene,
                                      const RayGrid& rays,
                                      const LayerGrid& layers) {
  if (kind == SamplerKind::kScanline) {
    return make_scanline_sampler(scene, rays, layers);
  }
  return make_gl_sampler(
      scene, rays, layers,
      shared_raster(kind == SamplerKind::kGl ? GlMethod::kList
                                             : GlMethod::kPeeling));
}

}  // namespace lamina::ldni
