#pragma once
// The contours of layers as SLC and CLI hold them: float32 numbers, every loop
// closed by its first point.
//
// Rounded so that loops stay simple and disjoint (round_loops.h). Remembers
// what headers tell of all layers together.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "ldni/section/contours.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/round_loops.h"

namespace lamina::slicer {

// A point as the file holds it.
struct FloatPoint {
  float x;
  float y;
  friend bool operator==(const FloatPoint&, const FloatPoint&) = default;
};

// The signed area [mm²] of a loop whose last point repeats its
// first, positive where it runs counter-clockwise.
double signed_area(std::span<const FloatPoint> closed_loop);

class FloatContours {
 public:
  // Replaces the layer in hand.
  void take(const Layer& layer);

  // Of the layer in hand. A loop's last point repeats its first.
  std::size_t loop_count() const { return ends_.size(); }
  std::span<const FloatPoint> loop(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return {points_.data() + begin, ends_[i] - begin};
  }

  // Box of all layers taken; (0, 0) to (0, 0) where none had a loop.
  FloatPoint low() const { return low_; }
  FloatPoint high() const { return high_; }

  // What rounding moved a point by, at most, so far [mm].
  double greatest_rounding() const;
  // Layers that needed more than rounding each point.
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
