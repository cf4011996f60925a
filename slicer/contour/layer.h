#pragma once
// A finished layer, and who takes it.

#include <string>

#include "base/vec.h"
#include "ldni/section/contours.h"

namespace lamina::slicer {

struct Layer {
  double section_z = 0;  // height of the section [mm]
  double bottom = 0;     // the layer's lower side [mm]
  double top = 0;        // its upper side; = bottom = section_z for --heights
  double compensation = 0;  // contours have been moved inwards by this [mm]
  // No vertex is known to be nearer to a foreign edge than this, in x and in y
  // [mm]; 0: not known.
  double clearance = 0;
  ldni::Contours contours;
  // What the sink's encode() made of the layer; empty where it was not asked.
  std::string encoded;
};

// Takes the layers of a job in ascending order: a writer, a comparison, a test.
// Empty layers below the first and above the last non-empty one have been left
// out already (not under --heights: there each height gives a layer).
class LayerSink {
 public:
  virtual ~LayerSink() = default;
  // Once, before the first layer. box: no contour reaches beyond it but by
  // what --compensate adds.
  virtual void begin(const Box3& /*box*/) {}
  // Once, after begin(): no more layers than these will come.
  virtual void expect(std::uint32_t /*layers*/) {}
  // The part of the work on a layer that needs neither another layer nor its
  // heights: layers with the same contours share what it makes. Called by
  // several threads at once, between begin() and the layer's take(), for layers
  // with contours.
  virtual std::string encode(const Layer& /*layer*/) const { return {}; }
  virtual void take(const Layer& layer) = 0;
};

}  // namespace lamina::slicer
