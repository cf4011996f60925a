#pragma once
// Counts layers on their way to a sink.

#include <cstdint>
#include <functional>

#include "slicer/contour/layer.h"

namespace lamina::compiler {

// Called with the number of layers done and of all that there can be: with 0
// before the first layer, after each, and with both equal after the last. By
// one thread at a time.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;

// Passes layers on. Both must outlive it; the progress may be empty.
class CountingSink : public slicer::LayerSink {
 public:
  CountingSink(slicer::LayerSink& sink, const Progress& progress)
      : sink_(sink), progress_(progress) {}

  void begin(const Box3& box) override { sink_.begin(box); }
  void expect(std::uint32_t layers) override {
    all_ = layers;
    sink_.expect(layers);
    if (progress_) progress_(0, all_);
  }
  std::string encode(const slicer::Layer& layer) const override {
    return sink_.encode(layer);
  }
  void take(const slicer::Layer& layer) override { take_encoded(layer, {}); }
  void take_encoded(const slicer::Layer& layer,
                    const std::string& encoded) override {
    sink_.take_encoded(layer, encoded);
    if (progress_) progress_(++done_, all_);
  }
  // Fewer layers can come than were expected.
  void finish() const {
    if (progress_) progress_(all_, all_);
  }

 private:
  slicer::LayerSink& sink_;
  const Progress& progress_;
  std::uint64_t done_ = 0;
  std::uint64_t all_ = 0;
};

}  // namespace lamina::compiler
