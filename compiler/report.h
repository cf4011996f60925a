#pragma once
// What a compilation cost, what came of it, and how good it is.

#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/feature_origins.h"
#include "slicer/contour/deviation.h"
#include "slicer/slice/slice.h"

namespace lamina::compiler {

struct Report {
  // Processor seconds of the passes; those of slicing are in `slice`.
  double load_seconds = 0;
  double evaluate_seconds = 0;
  double lower_seconds = 0;
  slicer::SliceReport slice;
  // What made each of slice.features.
  std::vector<FeatureOrigins> origins;
  // No value where nothing is promised: the paper's contours.
  std::optional<slicer::Deviation> deviation;
  std::uint64_t snapped_layers = 0;  // slicer::LayerWriter
  std::uint64_t warnings = 0;
  std::uint64_t output_bytes = 0;
  double wall_seconds = 0;
};

}  // namespace lamina::compiler
