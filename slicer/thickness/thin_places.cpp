#include "slicer/thickness/thin_places.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numbers>
#include <tuple>

#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/union_find.h"
#include "slicer/check/thin/facing_cells.h"

namespace lamina::slicer {
namespace {

// Balls of one place have middles no farther apart than this [pitches]: as far
// as neighbours may be along a surface, and twice that where it bends.
constexpr double kJoined = 2 * kCover;

// Points that one task takes.
constexpr std::size_t kPointsPerTask = 1 << 12;

struct ThinBall {
  std::uint32_t point = 0;
  Ball ball;
};

// The balls that are thin, on one side of the surface, by ascending point.
std::vector<ThinBall> find_thin_balls(const SolidSamples& samples,
                                      const BallFinder& balls, double width,
                                      double side) {
  const std::size_t count = samples.points.size();
  std::vector<std::vector<ThinBall>> found((count + kPointsPerTask - 1) /
                                           kPointsPerTask);
  for_each_index(found.size(), [&](std::size_t task) {
    const std::size_t first = task * kPointsPerTask;
    const std::size_t end = std::min(first + kPointsPerTask, count);
    for (std::size_t i = first; i < end; ++i) {
      const SurfacePoint& point = samples.points[i];
      const Ball ball = balls.grow(point.place, side * point.normal, width / 2);
      if (ball.stop && ball.angle >= std::numbers::pi - kFacingAngle) {
        found[task].push_back({static_cast<std::uint32_t>(i), ball});
      }
    }
  });
  std::vector<ThinBall> all;
  for (const auto& part : found)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Numbers of balls whose middles hang together.
UnionFind join(const std::vector<ThinBall>& thin, double distance) {
  std::vector<SurfacePoint> middles(thin.size());
  for (std::size_t i = 0; i < thin.size(); ++i) {
    middles[i].place = thin[i].ball.centre;
  }
  const BallFinder near(middles);
  UnionFind places(thin.size());
  for (std::uint32_t i = 0; i < thin.size(); ++i) {
    for (const std::uint32_t other :
         near.points_within(middles[i].place, distance)) {
      places.unite(i, other);
    }
  }
  return places;
}

void add_places(const SolidSamples& samples, const std::vector<ThinBall>& thin,
                bool is_gap, std::vector<ThinPlace>& places) {
  UnionFind joined = join(thin, kJoined * samples.pitch);
  std::map<std::uint32_t, ThinPlace> by_root;
  for (std::uint32_t i = 0; i < thin.size(); ++i) {
    const auto& [number, ball] = thin[i];
    const SurfacePoint& touch = samples.points[number];
    const SurfacePoint& stop = samples.points[*ball.stop];
    ThinPlace& place = by_root[joined.find(i)];
    const double width = 2 * ball.radius;
    if (place.area == 0 || width < place.width) {
      place.width = width;
      place.place = ball.centre;
      place.across = glm::normalize(stop.place - touch.place);
      place.instances = {touch.instance, stop.instance};
    }
    place.is_gap = is_gap;
    place.area += touch.area / 2;  // each side has its own points
    place.box.add(ball.centre);
  }
  for (const auto& [root, place] : by_root) places.push_back(place);
}

}  // namespace

std::vector<ThinPlace> find_thin_places(const SolidSamples& samples,
                                        const BallFinder& balls, double width) {
  std::vector<ThinPlace> places;
  for (const bool is_gap : {false, true}) {
    add_places(samples,
               find_thin_balls(samples, balls, width, is_gap ? 1.0 : -1.0),
               is_gap, places);
  }
  std::stable_sort(
      places.begin(), places.end(),
      [](const ThinPlace& a, const ThinPlace& b) { return a.width < b.width; });
  return places;
}

}  // namespace lamina::slicer
