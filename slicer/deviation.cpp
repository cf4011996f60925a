#include "slicer/deviation.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "slicer/compensate.h"

namespace lamina::slicer {

std::optional<Deviation> promised_deviation(const Settings& settings) {
  if (settings.contour == ContourMode::kPaper) return std::nullopt;
  Deviation deviation;
  deviation.simplification = settings.tolerance;
  if (settings.compensation != 0) {
    deviation.compensation = kArcTolerance;
  }
  return deviation;
}

double float32_rounding(double greatest) {
  const auto rounded = static_cast<float>(greatest);
  const float next =
      std::nextafter(rounded, std::numeric_limits<float>::infinity());
  // Half a step in x and in y.
  return (static_cast<double>(next) - rounded) / 2 * std::numbers::sqrt2;
}

}  // namespace lamina::slicer
