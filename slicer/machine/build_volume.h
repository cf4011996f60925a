#pragma once
// Whether a part fits into what a printer builds.

#include "slicer/contour/layer.h"
#include "slicer/machine/printer.h"

namespace lamina::slicer {

// Hands layers on, and throws TooLarge at the first that reaches beyond what
// the printer builds around the middle of the part.
class BuildVolumeSink : public ForwardingSink {
 public:
  // Both must outlive it.
  BuildVolumeSink(const Printer& printer, LayerSink& sink);

  void begin(const Box3& box) override;
  void take_encoded(const Layer& layer, const std::string& encoded) override;

 private:
  const Printer& printer_;
  Box3 box_;   // that the part may have
  Vec3 size_;  // of the part, as begin() says
  bool has_layer_ = false;
};

}  // namespace lamina::slicer
