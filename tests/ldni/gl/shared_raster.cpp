#include "tests/ldni/gl/shared_raster.h"

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

std::unique_ptr<FaceRaster> shared_raster(GlMethod method) {
  return std::make_unique<SharedRaster>(raster_of_all_tests(method));
}

}  // namespace lamina::ldni
