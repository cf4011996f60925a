#pragma once
// The pipeline of a job: one thread or several turn blocks of layers into
// contours, which leave in order.

#include "ldni/section/grid.h"
#include "slicer/check/thin_features.h"
#include "slicer/slice/detail/block_slicer.h"
#include "slicer/slice/settings.h"
#include "slicer/slice/slice.h"

namespace lamina::slicer {

// Hands the layers of `grid` to `sink`. Empty layers wait until another layer
// with a contour follows, unless the settings give heights: each of those is
// wanted.
//
// features  gets the thin places of the layers; may be null
// report    gets times and counts
void run_slice_job(const Plan& plan, const ldni::LayerGrid& grid,
                   const Settings& settings, LayerSink& sink,
                   FeatureCollector* features, SliceReport& report);

}  // namespace lamina::slicer
