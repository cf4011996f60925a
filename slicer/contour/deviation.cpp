#include "slicer/contour/deviation.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace lamina::slicer {

double float32_rounding(double greatest) {
  const auto rounded = static_cast<float>(greatest);
  const float next =
      std::nextafter(rounded, std::numeric_limits<float>::infinity());
  // Half a step in x and in y.
  return (static_cast<double>(next) - rounded) / 2 * std::numbers::sqrt2;
}

}  // namespace lamina::slicer
