#pragma once
// Trees of supports: a pillar that leans over to another one needs no way of
// its own down to the bed.

#include <span>
#include <vector>

#include "slicer/supports/detail/support_router.h"
#include "slicer/supports/detail/symmetry.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer::detail {

// Lets pillars lean by 45° to neighbours that stay upright, where that saves
// resin and the way is free; those that save most come first. What is done to a
// support is done to its images as well, or not at all.
//
// bed  its height [mm]
void merge_pillars(std::span<const Isometry> symmetries,
                   const SupportRouter& router, const SupportSizes& sizes,
                   double bed, std::vector<Support>& supports);

}  // namespace lamina::slicer::detail
