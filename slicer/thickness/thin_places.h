#pragma once
// Walls and gaps that are thin in space, however they lie.
//
// What is thin within a layer is found exactly, layer by layer
// (slicer/check/thin). A plate that lies flat is not thin in any layer, and a
// wall that leans is thinner than its layers show. Here a place is thin where
// the largest ball that touches the surface is thinner than a width and touches
// two sides that face each other, as disks do there: so an edge of 90° is not
// thin, however small the balls in it.

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "slicer/thickness/ball_finder.h"
#include "slicer/thickness/solid_samples.h"

namespace lamina::slicer {

// A wall or a gap between walls, a wire (which is thin either way, as a prong
// is), or an edge: sides that meet, so that no thickness is its own.
enum class ThinShape : std::uint8_t { kWall, kWire, kEdge };

struct ThinPlace {
  bool is_gap = false;  // of the void, not of the solid
  ThinShape shape = ThinShape::kWall;
  double width = 0;       // of its thinnest ball [mm]
  Vec3 place = Vec3(0);   // the middle of that
  Vec3 across = Vec3(0);  // from side to side there; unit length
  double area = 0;        // of one side [mm²]
  Box3 box;               // of the middles of its balls
  // The leaves of the two sides: indices into csg::Scene::instances.
  std::array<std::uint32_t, 2> instances = {0, 0};
};

// What is thinner than it should be by less than this share passes: facets of a
// round wire are nearer to its middle than its nominal radius is.
inline constexpr double kLetPass = 0.95;

// Whether a place is too thin where it should be so thick [mm], and large
// enough to matter: a wire as long, or a side as large as a square of that.
// Crevices where surfaces meet are smaller.
bool is_too_thin(const ThinPlace& place, double least);

// The pitch of samples that show what is thinner than a width, as a share of
// it.
inline constexpr double kThinPitchShare = 0.4;

// Returns places whose balls hang together, the thinnest first.
//
// width  [mm]; should be two pitches of the samples or more: finer gaps may be
//        missed
std::vector<ThinPlace> find_thin_places(const SolidSamples& samples,
                                        const BallFinder& balls, double width);

}  // namespace lamina::slicer
