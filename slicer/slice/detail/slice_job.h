#pragma once
// The pipeline of a job: one thread or several turn blocks of layers into
// contours, which leave in order.

#include <cstdint>
#include <optional>
#include <vector>

#include "ldni/section/grid.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/check/thin/thin_features.h"
#include "slicer/slice/detail/block_slicer.h"
#include "slicer/slice/detail/layer_insets.h"
#include "slicer/slice/settings.h"
#include "slicer/slice/slice.h"
#include "slicer/supports/support_contacts.h"

namespace lamina::slicer {

// Who looks at the layers besides their sink; none where null.
struct Checks {
  FeatureCollector* features = nullptr;
  LayerGraph* graph = nullptr;
  SupportMeter* supports = nullptr;
};

struct ColoredPlan {
  std::int32_t color = 0;  // 0xRRGGBB
  Plan plan;
};

// How a job makes its layers.
struct Plans {
  Plan whole;
  // Of a scene with supports, the part and its supports by themselves.
  std::optional<Plan> part;
  std::optional<Plan> supports;
  // Of the part, what has a color, by itself.
  std::vector<ColoredPlan> colored;
};

// Hands the layers of `grid` to `sink`. Empty layers wait until another layer
// with a contour follows, unless the settings give heights: each of those is
// wanted.
//
// report  gets times and counts
void run_slice_job(const Plans& plans, const ldni::LayerGrid& grid,
                   const LayerInsets& insets, const Settings& settings,
                   LayerSink& sink, const Checks& checks, SliceReport& report);

}  // namespace lamina::slicer
