#pragma once
// Whether a part fits into what a printer builds.

#include "slicer/contour/layer.h"
#include "slicer/machine/printer.h"

namespace lamina::slicer {

// Hands layers on, and throws TooLarge at the first that reaches beyond what
// the printer builds around the middle of the part.
class BuildVolumeSink : public LayerSink {
 public:
  // Both must outlive it.
  BuildVolumeSink(const Printer& printer, LayerSink& sink);

  void begin(const Box3& box) override;
  void expect(std::uint32_t layers) override { sink_.expect(layers); }
  std::string encode(const Layer& layer) const override {
    return sink_.encode(layer);
  }
  void take(const Layer& layer) override { take_encoded(layer, {}); }
  void take_encoded(const Layer& layer, const std::string& encoded) override;

 private:
  const Printer& printer_;
  LayerSink& sink_;
  Box3 box_;   // that the part may have
  Vec3 size_;  // of the part, as begin() says
  bool has_layer_ = false;
};

}  // namespace lamina::slicer
