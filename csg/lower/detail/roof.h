#pragma once
// roof(): a solid over a region, its faces rising at 45° from the outline.
//
// The roof is what cutters leave of the upright prism over the region. Each
// cutter is convex and stands on its tip or its edge: at height z it covers
// what the outline, moving inwards at unit speed, has swept there by the time
// z. So no skeleton is ever built, and the Booleans that layers need anyway
// join the faces.
//
// The swept part is a strip along each edge and a part at each reflex corner:
//
// - "voronoi": a sector of a circle, drawn as a polygon that it contains. What
//   is left has its points above those of the region farther than z from the
//   outline.
// - "straight": the strips' sharp join, which runs ahead along the corner's
//   bisector until it meets an edge or the track of another one (the motorcycle
//   graph: Eppstein, Erickson 1999). What is left has the faces of the straight
//   skeleton: these are the lower envelope of the planes of the edges, each
//   bounded by such tracks (Cheng, Vigneron 2007; Huber, Held 2012).

#include "csg/plane/region.h"
#include "csg/scene.h"

namespace lamina::csg {

// No point of the region is farther from its outline: the least such distance
// [mm], or up to a share of 2e-5 more.
double greatest_depth(const planar::Region& region);

// The cutters of a roof "voronoi" up to z = top [mm], as one mesh. They overlap
// each other, and reach beyond the outline.
//
// corner_step_deg  greatest angle of a side of a rounded corner
Mesh round_cutters(const planar::Region& region, double top,
                   double corner_step_deg);

// Those of a roof "straight". Throws LimitExceeded where the region has more
// than kMostTracks reflex corners.
Mesh sharp_cutters(const planar::Region& region, double top);

}  // namespace lamina::csg
