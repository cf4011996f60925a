#include "slicer/formats/detail/float_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/lanes.h"
#include "slicer/contour/deviation.h"

namespace lamina::slicer {
namespace {

// Neighbouring numbers this far apart [mm] draw a warning. A power of two, as
// such distances are: they reach it at 8192 mm.
constexpr double kCoarse = 0x1p-10;

}  // namespace

void FloatContours::take(const Layer& layer) {
  // Upright walls give layer after layer the same contours.
  if (is_kept_ && layer.clearance == clearance_ && layer.contours == taken_) {
    rounder_.count_again();
    return;
  }
  reach_ = std::max(reach_, greatest_coordinate(layer.contours.points));
  rounded_ = layer.contours;
  is_kept_ = rounder_.round(rounded_, layer.clearance);
  if (is_kept_) {
    clearance_ = layer.clearance;
    taken_ = layer.contours;
  }
  const std::size_t loops = rounded_.loop_count();
  points_.resize(rounded_.points.size() + loops);
  ends_.resize(loops);
  FloatPoint* end = points_.data();
  for (std::size_t i = 0; i < loops; ++i) {
    const FloatPoint* const begin = end;
    for (const Vec2& point : rounded_.loop(i)) {
      *end++ = {static_cast<float>(point.x), static_cast<float>(point.y)};
    }
    *end++ = *begin;
    ends_[i] = static_cast<std::size_t>(end - points_.data());
  }
  extend();
}

// Extends the box of the layers so far by that of this one.
void FloatContours::extend() {
  if (rounded_.is_empty()) return;
  Lanes low = lanes_of(rounded_.points.front());
  Lanes high = low;
  if (has_loops_) {
    low = Lanes{low_.x, low_.y};
    high = Lanes{high_.x, high_.y};
  }
  has_loops_ = true;
  for (const Vec2& point : rounded_.points) {
    low = least(low, lanes_of(point));
    high = greatest(high, lanes_of(point));
  }
  low_ = {static_cast<float>(low[0]), static_cast<float>(low[1])};
  high_ = {static_cast<float>(high[0]), static_cast<float>(high[1])};
}

double FloatContours::greatest_rounding() const {
  return rounder_.most_moves() * float32_rounding(reach_);
}

void FloatContours::warn_of_coarse_numbers(std::string_view format,
                                           Diagnostics& diagnostics) const {
  const auto farthest = static_cast<float>(reach_);
  const double spacing =
      std::nextafter(farthest, std::numeric_limits<float>::infinity()) -
      farthest;
  if (spacing < kCoarse) return;
  diagnostics.warning(
      {}, fmt::format("{:.6g} mm from the origin, the 32-bit numbers of {} are "
                      "{:.2g} mm apart: move the design nearer to the origin",
                      reach_, format, spacing));
}

}  // namespace lamina::slicer
