#pragma once
// A finished layer, and who takes it.

#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::slicer {

// What of a layer has a color of its own.
struct ColoredPart {
  std::int32_t color = 0;  // 0xRRGGBB
  plane::Contours contours;
};

struct Layer {
  double section_z = 0;  // height of the section [mm]
  double bottom = 0;     // the layer's lower side [mm]
  double top = 0;        // its upper side; = bottom = section_z for --heights
  // Contours have been moved inwards by this [mm], by their foot, too.
  double compensation = 0;
  // Every vertex is known to keep this far from foreign edges, in x or in y
  // [mm]; 0: nothing is known.
  double clearance = 0;
  plane::Contours contours;
  // Of a design with supports: the part and its supports by themselves. Tips of
  // supports are in the part.
  plane::Contours part;
  plane::Contours supports;
  // Of a design with color(), if asked for: the same colors in all layers.
  std::vector<ColoredPart> colored;
};

// Takes the layers of a job in ascending order: a writer, a comparison, a test.
// Empty layers below the first and above the last non-empty one are left out
// (not under --heights: there each height gives a layer).
class LayerSink {
 public:
  virtual ~LayerSink() = default;
  // Called once, before the first layer. No contour reaches beyond `box` but by
  // what --compensate adds.
  virtual void begin(const Box3& /*box*/) {}
  // Called once, after begin(): no more layers than these will come.
  virtual void expect(std::uint32_t /*layers*/) {}
  // Does the part of the work on a layer that needs neither another layer nor
  // its heights: layers with the same contours share the result. Several
  // threads call it at once, between begin() and the layer's take(), for layers
  // with contours.
  virtual std::string encode(const Layer& /*layer*/) const { return {}; }
  virtual void take(const Layer& layer) = 0;
  // Takes a layer with what encode() made of it.
  virtual void take_encoded(const Layer& layer,
                            const std::string& /*encoded*/) {
    take(layer);
  }
};

// Takes layers for jobs of which only the report matters.
class LayerDrain : public LayerSink {
 public:
  void take(const Layer& /*layer*/) override {}
};

// Hands all on to another sink, which outlives it.
class ForwardingSink : public LayerSink {
 public:
  explicit ForwardingSink(LayerSink& sink) : sink_(sink) {}

  void begin(const Box3& box) override { sink_.begin(box); }
  void expect(std::uint32_t layers) override { sink_.expect(layers); }
  std::string encode(const Layer& layer) const override {
    return sink_.encode(layer);
  }
  void take(const Layer& layer) override { take_encoded(layer, {}); }
  void take_encoded(const Layer& layer, const std::string& encoded) override {
    sink_.take_encoded(layer, encoded);
  }

 private:
  LayerSink& sink_;
};

// Keeps all layers.
struct LayerList : LayerSink {
  void take(const Layer& layer) override { layers.push_back(layer); }
  std::vector<Layer> layers;
};

}  // namespace lamina::slicer
