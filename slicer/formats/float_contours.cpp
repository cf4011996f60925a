#include "slicer/formats/float_contours.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "slicer/deviation.h"

namespace lamina::slicer {
namespace {

// Neighbouring numbers of a file may be nearer than this without a word [mm].
// A power of two, as their distances are: from 8192 mm on they are this far
// apart.
constexpr double kCoarse = 0x1p-10;

}  // namespace

double signed_area(std::span<const FloatPoint> closed_loop) {
  // From the first point, so that the products stay exact where it is far off.
  const FloatPoint origin = closed_loop.front();
  double twice_area = 0;
  for (std::size_t i = 1; i < closed_loop.size(); ++i) {
    const FloatPoint a = closed_loop[i - 1];
    const FloatPoint b = closed_loop[i];
    twice_area += (double{a.x} - origin.x) * (double{b.y} - origin.y) -
                  (double{a.y} - origin.y) * (double{b.x} - origin.x);
  }
  return twice_area / 2;
}

void FloatContours::take(const Layer& layer) {
  for (const Vec2& point : layer.contours.points) {
    reach_ = std::max({reach_, std::abs(point.x), std::abs(point.y)});
  }
  rounded_ = layer.contours;
  rounder_.round(rounded_, layer.clearance);
  points_.clear();
  ends_.clear();
  for (std::size_t i = 0; i < rounded_.loop_count(); ++i) {
    const std::size_t begin = points_.size();
    for (const Vec2& point : rounded_.loop(i)) {
      points_.push_back(
          {static_cast<float>(point.x), static_cast<float>(point.y)});
    }
    extend(std::span(points_).subspan(begin));
    points_.push_back(points_[begin]);
    ends_.push_back(points_.size());
  }
}

void FloatContours::extend(std::span<const FloatPoint> loop) {
  if (!has_loops_) low_ = high_ = loop.front();
  has_loops_ = true;
  for (const FloatPoint& point : loop) {
    low_ = {std::min(low_.x, point.x), std::min(low_.y, point.y)};
    high_ = {std::max(high_.x, point.x), std::max(high_.y, point.y)};
  }
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
