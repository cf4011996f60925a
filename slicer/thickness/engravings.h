#pragma once
// How deep and how wide engravings are.
//
// An engraving is a groove: a floor between two walls that face each other, and
// a mouth through which a tool reaches the floor. At a place of the floor the
// way out is along its normal. The depth is the distance from the line between
// the rims on both sides, or, where that line deviates by more than 20°, at the
// foot of a step, the height of the lower rim. The width is the distance
// between the walls. So neither asks where the surface would be without the
// groove, which on a bent surface nobody can say.
//
// What a groove ends in sideways does not matter: a blind hole is one, and so
// is the ground between raised letters. A step has one wall and is none, a hole
// that goes through has no floor, and a notch whose walls meet in an edge has
// none either. A recess that is wider than a limit is not a groove.
//
// Floors are looked for among points of the surface that a large ball outside
// cannot touch. Walls and rims are points too, so that heights over a plane
// floor are exact where the surface around is plane. Where it bends inward, as
// in a ring, the rim is found up to kRimSteps pitches too far behind the wall.

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "slicer/thickness/ball_finder.h"
#include "slicer/thickness/solid_samples.h"

namespace lamina::slicer {

// How far behind its wall a rim is looked for [pitches]: a wall that leans by
// 20° and is five pitches high has its rim two pitches behind its foot.
inline constexpr double kRimSteps = 2.5;

struct Engraving {
  // Nine tenths of its floor are no deeper [mm]: where walls meet, or a groove
  // crosses a hole, a few places may be.
  double depth = 0;
  double width = 0;      // from wall to wall, in the middle of all places [mm]
  Vec3 place = Vec3(0);  // of the floor, with that depth
  Vec3 out = Vec3(0);    // through its mouth there; unit length
  double area = 0;       // of its floor [mm²]
  // The leaves of the floor and of a wall: indices into csg::Scene::instances.
  std::array<std::uint32_t, 2> instances = {0, 0};
};

struct EngravingLimits {
  double width = 0;  // of the widest groove [mm]
  // Deeper ones have this depth, or are left out [mm].
  double depth = 0;
};

// Returns engravings whose floors hang together, the shallowest first. What is
// shallower than a pitch of the samples, or narrower than two, may be missed.
std::vector<Engraving> find_engravings(const SolidSamples& samples,
                                       const BallFinder& balls,
                                       const EngravingLimits& limits);

}  // namespace lamina::slicer
