#include "slicer/thickness/engravings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/union_find.h"

namespace lamina::slicer {
namespace {

// A wall rises from the floor by more than 50°.
const double kMostUpright = std::cos(0.8726646259971648);

// Walls face each other where they deviate from opposite directions by less
// than 40°, as walls of gaps do (thin_places.cpp).
const double kLeastFacing = std::cos(0.6981317007977318);

// A ball that is as wide as the widest groove, but for this share, finds room
// before the mouth: the surface around may rise a little, as in a ring.
constexpr double kMouthShare = 0.9;

// Where a line between two rims is steeper than 20°, a groove lies at the foot
// of a step.
const double kSteepest = std::tan(0.3490658503988659);

// Floors of one groove have points no farther apart than this [pitches].
constexpr double kSameFloor = 2 * kCover;

// The share of a floor that is no deeper than its groove is said to be.
constexpr double kDepthShare = 0.9;

// What a point of the floor finds around itself.
struct Floor {
  std::uint32_t point = 0;
  std::uint32_t wall = 0;  // the nearer one; a point
  double depth = 0;        // [mm]
  double width = 0;        // [mm]
};

// A point near a place of the floor, seen from there.
struct Neighbour {
  std::uint32_t point = 0;
  Vec3 flat = Vec3(0);  // the way there, without its height
  double height = 0;    // along the floor's normal [mm]
  bool is_wall = false;
  Vec3 facing = Vec3(0);  // a wall's normal within the floor; unit length
  double distance = 0;    // from the plane of a wall that the place is before
};

class FloorFinder {
 public:
  FloorFinder(const SolidSamples& samples, const BallFinder& balls,
              const EngravingLimits& limits)
      : points_(samples.points),
        balls_(balls),
        limits_(limits),
        beside_(kCover * samples.pitch),
        behind_(kRimSteps * samples.pitch) {
    // The ball that touches the middle of a floor of the greatest width, half
    // a pitch deep, and its rims.
    const double half = limits.width / 2;
    const double depth = samples.pitch / 2;
    roller_ = (half * half + depth * depth) / (2 * depth);
  }

  // By ascending point.
  std::vector<Floor> find() const {
    std::vector<std::vector<Floor>> found(
        (points_.size() + kPointsPerTask - 1) / kPointsPerTask);
    for_each_index(found.size(), [&](std::size_t task) {
      const std::size_t first = task * kPointsPerTask;
      const std::size_t end = std::min(first + kPointsPerTask, points_.size());
      for (std::size_t i = first; i < end; ++i) {
        if (const auto floor = floor_at(static_cast<std::uint32_t>(i))) {
          found[task].push_back(*floor);
        }
      }
    });
    std::vector<Floor> all;
    for (const std::vector<Floor>& part : found) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

 private:
  bool holds_point(const SurfacePoint& from, double height,
                   double radius) const {
    return balls_.nearest(from.place + height * from.normal, radius)
        .has_value();
  }

  std::optional<Floor> floor_at(std::uint32_t number) const {
    const SurfacePoint& point = points_[number];
    if (!holds_point(point, roller_, roller_ * (1 - 1e-6))) return {};
    const std::vector<Neighbour> around = look_around(number);
    const auto walls = walls_of(around);
    if (!walls) return {};
    const auto& [near, far] = *walls;
    const double depth = depth_under(rim_behind(*near, around),
                                     rim_behind(*far, around), near->facing);
    const double room = limits_.width / 2;
    if (holds_point(point, depth + room, kMouthShare * room)) return {};
    return Floor{number, near->point, std::min(depth, limits_.depth),
                 near->distance + far->distance};
  }

  // How far the floor lies from the line between two rims, or below the lower
  // one where that line is too steep.
  //
  // across  from wall to wall; unit length
  static double depth_under(const Neighbour& rim, const Neighbour& other,
                            Vec3 across) {
    const double here = std::abs(glm::dot(rim.flat, across));
    const double run = here + std::abs(glm::dot(other.flat, across));
    const double rise = other.height - rim.height;
    if (!(std::abs(rise) <= kSteepest * run)) {
      return std::min(rim.height, other.height);
    }
    // The height of the line over the floor, seen along the line's normal.
    return (rim.height + rise * here / run) * run / std::hypot(run, rise);
  }

  std::vector<Neighbour> look_around(std::uint32_t number) const {
    const SurfacePoint& point = points_[number];
    std::vector<Neighbour> around;
    for (const std::uint32_t other : balls_.points_within(
             point.place, std::hypot(limits_.width + behind_, limits_.depth))) {
      const SurfacePoint& seen = points_[other];
      const Vec3 way = seen.place - point.place;
      Neighbour one = {other};
      one.height = glm::dot(way, point.normal);
      one.flat = way - one.height * point.normal;
      const double upright = glm::dot(seen.normal, point.normal);
      if (std::abs(upright) < kMostUpright && one.height >= 0) {
        one.facing = glm::normalize(seen.normal - upright * point.normal);
        one.distance = -glm::dot(one.facing, one.flat);
        one.is_wall = one.distance >= 0 && one.distance <= limits_.width &&
                      is_beside(one, one.facing);
      }
      around.push_back(one);
    }
    return around;
  }

  // Whether a point is straight that way, or straight behind.
  bool is_beside(const Neighbour& one, Vec3 way) const {
    return glm::length(one.flat - glm::dot(one.flat, way) * way) <= beside_;
  }

  // The nearest wall that has one on the other side, and that, if both are no
  // farther apart than a groove is wide.
  std::optional<std::pair<const Neighbour*, const Neighbour*>> walls_of(
      std::span<const Neighbour> around) const {
    std::vector<const Neighbour*> walls;
    for (const Neighbour& one : around) {
      if (one.is_wall) walls.push_back(&one);
    }
    std::sort(walls.begin(), walls.end(),
              [](const Neighbour* a, const Neighbour* b) {
                return std::tuple(a->distance, a->point) <
                       std::tuple(b->distance, b->point);
              });
    for (auto near = walls.begin(); near != walls.end(); ++near) {
      if (2 * (*near)->distance > limits_.width) break;
      for (auto far = near + 1; far != walls.end(); ++far) {
        if ((*near)->distance + (*far)->distance > limits_.width) break;
        if (-glm::dot((*near)->facing, (*far)->facing) >= kLeastFacing) {
          return std::pair(*near, *far);
        }
      }
    }
    return std::nullopt;
  }

  // The highest point at a wall or closely behind it.
  const Neighbour& rim_behind(const Neighbour& wall,
                              std::span<const Neighbour> around) const {
    const Neighbour* highest = &wall;
    for (const Neighbour& one : around) {
      const double beyond = -glm::dot(one.flat, wall.facing) - wall.distance;
      if (beyond < 0 || beyond > behind_ || !is_beside(one, wall.facing)) {
        continue;
      }
      if (one.height > highest->height) highest = &one;
    }
    return *highest;
  }

  std::span<const SurfacePoint> points_;
  const BallFinder& balls_;
  EngravingLimits limits_;
  double beside_ = 0;  // how far from straight across [mm]
  double behind_ = 0;  // how far behind a wall its rim may be [mm]
  double roller_ = 0;  // radius of the ball that touches no floor [mm]
};

// Which floors hang together.
class Grooves {
 public:
  Grooves(const SolidSamples& samples, std::vector<Floor> floors)
      : points_(samples.points), floors_(std::move(floors)) {
    std::vector<SurfacePoint> places;
    for (const Floor& floor : floors_) places.push_back(points_[floor.point]);
    const BallFinder near(places);
    joined_ = UnionFind(floors_.size());
    for (std::uint32_t i = 0; i < floors_.size(); ++i) {
      for (const std::uint32_t other :
           near.points_within(places[i].place, kSameFloor * samples.pitch)) {
        joined_.unite(i, other);
      }
    }
  }

  std::vector<Engraving> collect() {
    std::map<std::uint32_t, std::vector<Floor>> by_root;
    for (std::uint32_t i = 0; i < floors_.size(); ++i) {
      by_root[joined_.find(i)].push_back(floors_[i]);
    }
    std::vector<Engraving> engravings;
    for (auto& [root, floors] : by_root) {
      engravings.push_back(engraving_of(floors));
    }
    std::stable_sort(engravings.begin(), engravings.end(),
                     [](const Engraving& a, const Engraving& b) {
                       return a.depth < b.depth;
                     });
    return engravings;
  }

 private:
  Engraving engraving_of(std::vector<Floor>& floors) const {
    Engraving engraving;
    for (const Floor& floor : floors) {
      engraving.area += points_[floor.point].area;
    }
    std::sort(floors.begin(), floors.end(), [](const Floor& a, const Floor& b) {
      return std::tuple(a.width, a.point) < std::tuple(b.width, b.point);
    });
    engraving.width = floors[floors.size() / 2].width;
    std::sort(floors.begin(), floors.end(), [](const Floor& a, const Floor& b) {
      return std::tuple(a.depth, a.point) < std::tuple(b.depth, b.point);
    });
    const Floor& deep = floors[static_cast<std::size_t>(
        kDepthShare * static_cast<double>(floors.size() - 1))];
    const SurfacePoint& point = points_[deep.point];
    engraving.depth = deep.depth;
    engraving.place = point.place;
    engraving.out = point.normal;
    engraving.instances = {point.instance, points_[deep.wall].instance};
    return engraving;
  }

  std::span<const SurfacePoint> points_;
  std::vector<Floor> floors_;
  UnionFind joined_;
};

}  // namespace

std::vector<Engraving> find_engravings(const SolidSamples& samples,
                                       const BallFinder& balls,
                                       const EngravingLimits& limits) {
  return Grooves(samples, FloorFinder(samples, balls, limits).find()).collect();
}

}  // namespace lamina::slicer
