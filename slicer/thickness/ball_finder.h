#pragma once
// Balls inside a solid, or outside, that touch its surface.
//
// The thickness at a place is the diameter of the largest ball in the solid
// that touches the surface there: its centre is on the medial axis (Blum 1967).
// Source: Ma, Bae and Choi, 3D medial axis point approximation using nearest
// neighbors and the normal field, The Visual Computer 2012: a ball too large
// shrinks to touch the point nearest to its centre, until none is inside.
//
// The surface is known by points, of which any place of it has one within
// kCover pitches c. A ball that holds no point may so reach out of the solid:
// where the surface is plane or bends away by (1 - cos of half the angle) of
// it, less than c² / (2 · radius); where a sharp edge points into the solid, c.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "slicer/thickness/solid_samples.h"

namespace lamina::slicer {

struct Ball {
  Vec3 centre = Vec3(0);
  double radius = 0;  // [mm]
  // The point that stops it; none where it has the greatest radius that was
  // asked for.
  std::optional<std::uint32_t> stop = {};
};

class BallFinder {
 public:
  // The points must outlive it.
  explicit BallFinder(std::span<const SurfacePoint> points);
  ~BallFinder();
  BallFinder(const BallFinder&) = delete;
  BallFinder& operator=(const BallFinder&) = delete;

  struct Nearest {
    std::uint32_t point = 0;
    double distance = 0;  // [mm]
  };
  // The nearest point; no value where none is nearer than `within` [mm].
  //
  // doubt  another may be nearer by this share: much faster where many points
  //        are about as far
  std::optional<Nearest> nearest(Vec3 place, double within,
                                 double doubt = 0) const;

  // All points that are not farther than this [mm], in no order.
  std::vector<std::uint32_t> points_within(Vec3 place, double distance) const;

  // Returns the largest ball that touches `touch`, holds no point and has its
  // centre in this direction (unit length).
  //
  // most  greatest radius [mm]
  Ball grow(Vec3 touch, Vec3 direction, double most) const;

  // Returns the largest ball whose centre is within `reach` [mm] of a place,
  // and can be found uphill from there: in steps that shrink to a hundredth of
  // the reach. No farther than half the ball around the place is wide, so that
  // it stays on its side of the surface.
  Ball climb(Vec3 place, double reach) const;

 private:
  struct Tree;
  std::span<const SurfacePoint> points_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace lamina::slicer
