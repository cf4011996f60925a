#pragma once
// The pole of inaccessibility of a region: the place inside it that is farthest
// from its boundary, which is where a mark or a support stands best.
//
// A square is halved as long as it may hold a better place: its middle's
// distance and half its diagonal say so (Garcia-Castellanos and Lombardo 2007;
// the halving is that of Mapbox's polylabel). A sliver of length l and width w
// takes l / w squares, and a layer may have as many slivers as that. So where
// squares do not get far, the middles of some chords across a sliver are asked
// as well: 10,000 slivers of a layer cost a tenth.

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::slicer {

// region  loops with winding 1 inside and 0 outside, at least one
// returns a place inside whose distance from the boundary is 80 % of the
//         greatest, where that takes no thousands of looks; of a sliver, the
//         best place of some
Vec2 pole_of(const plane::Contours& region);

}  // namespace lamina::slicer
