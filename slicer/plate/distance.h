#pragma once
// The exact check of what a packer made: are pieces too near to each other?
//
// It knows nothing of bitmaps and tables. It measures edges of the outlines
// themselves, sorted into one grid of cells, and asks where a piece lies inside
// another one.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "plane/region/region.h"

namespace lamina::slicer {

// Two regions by their indices; the first is the lower one.
using NearPair = std::pair<std::size_t, std::size_t>;

// Returns the pairs of regions whose distance is less than `gap` [mm], but for
// rounding, in ascending order. Regions that overlap are too near at any gap.
// At gap 0 they may touch: what two have in common counts where its mean width
// is more than 1e-5 mm. A region may lie in a hole of another one.
//
// throws  LimitExceeded for coordinates beyond plane::kGreatestCoordinate
std::vector<NearPair> find_too_near(std::span<const plane::Region> regions,
                                    double gap);

}  // namespace lamina::slicer
