#pragma once
// roof(): a solid over a region, its faces rising at 45° from the outline.
//
// The roof is what cutters leave of the upright prism over the region. Each
// cutter is convex and stands on its tip or its edge: at height z it covers
// what the outline, moving inwards at unit speed, has swept there by the time
// z. So no skeleton is ever built, and the Booleans that layers need anyway
// join the faces.
//
// Cutters as high as the roof would all cross each other near its top. So it is
// raised in stages, each over what the outline has left at its bottom. What
// bounds a point of the roof bounds what is left at each height below that
// point, too, as the part of the outline that comes there first has come
// straight: so a stage has the cutters of those parts alone that bound what is
// left at its bottom, and these reach back no farther than that.
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

#include <functional>
#include <vector>

#include "csg/scene.h"
#include "plane/region/region.h"

namespace lamina::csg {

// The prism over `region` from `bottom` to `top`, less the cutters. The roof is
// the union of all stages.
struct RoofStage {
  plane::Region region;
  double bottom = 0;  // [mm]
  double top = 0;     // [mm]; the roof's own, or a share of 2e-5 more
  Mesh cutters;       // they overlap each other, and reach beyond the prism
};

// "voronoi". `arc_step_deg` says how far a side of an arc of a radius turns.
std::vector<RoofStage> round_roof(
    const plane::Region& region,
    const std::function<double(double radius)>& arc_step_deg);

// "straight". Throws LimitExceeded where the region has more than kMostTracks
// reflex corners.
std::vector<RoofStage> sharp_roof(const plane::Region& region);

}  // namespace lamina::csg
