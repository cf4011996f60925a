#pragma once
// The contours of layers in float32 numbers, as SLC, CLI, SVG and 3MF hold
// them.
//
// They are rounded so that loops stay simple and disjoint (round_loops.h). What
// headers say of all layers together is gathered on the way.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/loop_area.h"
#include "ldni/section/contours.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/round_loops.h"

namespace lamina::slicer {

// A point as the file holds it.
struct FloatPoint {
  float x;
  float y;
};

class FloatContours {
 public:
  // Replaces the layer in hand.
  void take(const Layer& layer);

  // The loops of the layer in hand. The last point of loop() repeats its first;
  // open_loop() is without it.
  std::size_t loop_count() const { return ends_.size(); }
  std::span<const FloatPoint> loop(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return {points_.data() + begin, ends_[i] - begin};
  }
  std::span<const FloatPoint> open_loop(std::size_t i) const {
    return loop(i).first(loop(i).size() - 1);
  }
  bool is_hole(std::size_t i) const {
    return signed_area(rounded_.loop(i)) < 0;
  }

  // Box of all layers taken; (0, 0) to (0, 0) where no layer had a loop.
  FloatPoint low() const { return low_; }
  FloatPoint high() const { return high_; }

  // Greatest distance that rounding moved a point by, so far [mm].
  double greatest_rounding() const;
  // Layers that needed more than rounding each point (round_loops.h).
  std::uint64_t snapped_layers() const { return rounder_.snapped_layers(); }

  // Warns where float32 numbers are too coarse for what was taken.
  // format  as messages name it: "SLC"
  void warn_of_coarse_numbers(std::string_view format,
                              Diagnostics& diagnostics) const;

 private:
  void extend();

  LoopRounder rounder_;
  ldni::Contours rounded_;
  std::vector<FloatPoint> points_;
  std::vector<std::size_t> ends_;
  bool has_loops_ = false;  // so far
  FloatPoint low_ = {0, 0};
  FloatPoint high_ = {0, 0};
  double reach_ = 0;  // greatest coordinate before rounding
};

}  // namespace lamina::slicer
