#include "slicer/machine/build_volume.h"

namespace lamina::slicer {
namespace {

// A part as large as the volume fits, whatever rounding its numbers saw [mm].
constexpr double kSlack = 1e-6;

}  // namespace

BuildVolumeSink::BuildVolumeSink(const Printer& printer, LayerSink& sink)
    : ForwardingSink(sink), printer_(printer), size_(0) {}

void BuildVolumeSink::begin(const Box3& box) {
  size_ = box.size();
  const Vec3 half = printer_.build_volume() / 2.0 + kSlack;
  box_ = {box.center() - half, box.center() + half};
  ForwardingSink::begin(box);
}

void BuildVolumeSink::take_encoded(const Layer& layer,
                                   const std::string& encoded) {
  if (!has_layer_) {
    box_.low.z = layer.bottom;
    box_.high.z = layer.bottom + printer_.build_volume().z + kSlack;
    has_layer_ = true;
  }
  bool fits = layer.top <= box_.high.z;
  for (const Vec2& point : layer.contours.points) {
    fits = fits && point.x >= box_.low.x && point.x <= box_.high.x &&
           point.y >= box_.low.y && point.y <= box_.high.y;
  }
  if (!fits) throw TooLarge(printer_, size_);
  ForwardingSink::take_encoded(layer, encoded);
}

}  // namespace lamina::slicer
