#include "plane/cascade/crossing_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>

namespace lamina::plane {
namespace {

bool change_order(std::span<const Vec2> a, std::span<const Vec2> b,
                  double tie_distance) {
  const double left = std::max(a.front().x, b.front().x);
  const double right = std::min(a.back().x, b.back().x);
  if (left >= right) return false;
  const double at_left = y_at(a, left) - y_at(b, left);
  const double at_right = y_at(a, right) - y_at(b, right);
  return std::min(std::abs(at_left), std::abs(at_right)) > tie_distance &&
         (at_left > 0) != (at_right > 0);
}

}  // namespace

double sample_crossings_per_chain(const LayerChains& layer,
                                  double tie_distance) {
  const std::size_t count = layer.chains.size();
  std::mt19937 random;
  const auto draw = [&] {
    const std::uint64_t place = random() * std::uint64_t{count} >> 32;
    return layer.chains[place].points_in(layer.points);
  };
  std::size_t crossed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const Vec2> a = draw();
    const std::span<const Vec2> b = draw();
    if (change_order(a, b, tie_distance)) ++crossed;
  }
  // There are half as many pairs as `count` squared, and `count` were drawn.
  return static_cast<double>(crossed) / 2;
}

}  // namespace lamina::plane
