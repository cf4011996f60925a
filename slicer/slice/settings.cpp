#include "slicer/slice/settings.h"

#include "slicer/contour/compensate.h"

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

}  // namespace lamina::slicer
