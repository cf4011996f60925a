#include "tests/ldni/gl/shared_raster.h"

namespace lamina::ldni {
namespace {

FaceRaster& raster_of_all_tests() {
  static const auto raster = make_face_raster(*open_gl());
  return *raster;
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

std::unique_ptr<FaceRaster> shared_raster() {
  return std::make_unique<SharedRaster>(raster_of_all_tests());
}

}  // namespace lamina::ldni
