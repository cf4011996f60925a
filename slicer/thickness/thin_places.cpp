#include "slicer/thickness/thin_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "base/parallel.h"
#include "base/union_find.h"

namespace lamina::slicer {
namespace {

// Balls of one place have middles no farther apart than this [pitches]: as far
// as neighbours may be along a surface, and twice that where it bends.
constexpr double kJoined = 2 * kCover;

// A ball that touches two sides is empty where no point is within this share of
// its radius: facets of a wire, down to those of a prong of five sides, bend
// into the ball that touches one of them beside its middle.
constexpr double kEmptyShare = 0.75;

// How far sides that face each other may deviate from opposite directions
// [rad]: 40°. A little more than in a layer (kFacingAngle), so that facets of a
// prong of five sides do, 36° from opposite: OpenSCAD makes thin cylinders so.
constexpr double kSpaceFacingAngle = 0.6981317007977318;
const double kLeastSine = std::cos(kSpaceFacingAngle / 2);
const double kLeastCosine = std::cos(kSpaceFacingAngle);

// A place tapers to an edge where its thinnest ball is thinner than this share
// of its middle one.
constexpr double kEdgeShare = 0.25;

// Middles of the balls of a wire lie along a line: across it they spread by
// less than this share of its diameter. In a wall they spread as far as one
// looks, a diameter.
constexpr double kWireShare = 0.3;

struct ThinBall {
  std::uint32_t point = 0;
  Ball ball;
};

// Finds the balls that are thin, on one side of the surface.
class ThinBalls {
 public:
  // side  1: outside, where gaps are; -1: inside
  ThinBalls(const SolidSamples& samples, const BallFinder& balls, double width,
            double side)
      : samples_(samples), balls_(balls), most_(width / 2), side_(side) {}

  // By ascending point.
  std::vector<ThinBall> find() const {
    const std::size_t count = samples_.points.size();
    std::vector<std::vector<ThinBall>> found((count + kPointsPerTask - 1) /
                                             kPointsPerTask);
    for_each_index(found.size(), [&](std::size_t task) {
      const std::size_t first = task * kPointsPerTask;
      const std::size_t end = std::min(first + kPointsPerTask, count);
      for (std::size_t i = first; i < end; ++i) {
        const auto point = static_cast<std::uint32_t>(i);
        if (const auto ball = facing_ball(point)) {
          found[task].push_back({point, *ball});
        }
      }
    });
    std::vector<ThinBall> all;
    for (const std::vector<ThinBall>& part : found) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

 private:
  // The smallest ball that touches the point and another one that faces it, if
  // nothing else reaches far into it.
  std::optional<Ball> facing_ball(std::uint32_t number) const {
    const SurfacePoint& point = samples_.points[number];
    const Vec3 direction = side_ * point.normal;
    const Vec3 centre = point.place + most_ * direction;
    if (!balls_.nearest(centre, most_)) return std::nullopt;
    Ball ball = {centre, most_};
    for (const std::uint32_t other : balls_.points_within(centre, most_)) {
      if (other != number) touch(point, direction, other, ball);
    }
    if (!ball.stop || balls_.nearest(ball.centre, kEmptyShare * ball.radius)) {
      return std::nullopt;
    }
    return ball;
  }

  // Shrinks the ball to where it touches the other point, if that faces it.
  void touch(const SurfacePoint& point, Vec3 direction, std::uint32_t number,
             Ball& ball) const {
    const SurfacePoint& other = samples_.points[number];
    const Vec3 chord = other.place - point.place;
    const double along = glm::dot(chord, direction);
    const double length = glm::length(chord);
    // The angle between the two places is twice that between the chord and the
    // side's plane.
    if (along < kLeastSine * length) return;
    if (-glm::dot(point.normal, other.normal) < kLeastCosine) return;
    const double radius = length * length / (2 * along);
    if (!(radius < ball.radius)) return;
    ball = {point.place + radius * direction, radius, number};
  }

  const SolidSamples& samples_;
  const BallFinder& balls_;
  const double most_;
  const double side_;
};

// The balls on one side of the surface, and what hangs together.
class ThinSide {
 public:
  ThinSide(const SolidSamples& samples, const BallFinder& balls,
           std::vector<ThinBall> thin)
      : samples_(samples),
        balls_(balls),
        thin_(std::move(thin)),
        middles_(middles_of(thin_)),
        near_(middles_),
        joined_(thin_.size()) {
    for (std::uint32_t i = 0; i < thin_.size(); ++i) {
      for (const std::uint32_t other :
           near_.points_within(middles_[i].place, kJoined * samples_.pitch)) {
        joined_.unite(i, other);
      }
    }
  }

  void add_places(bool is_gap, std::vector<ThinPlace>& places) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
    for (std::uint32_t i = 0; i < thin_.size(); ++i) {
      by_root[joined_.find(i)].push_back(i);
    }
    for (auto& [root, members] : by_root) {
      places.push_back(place_of(members));
      places.back().is_gap = is_gap;
    }
  }

 private:
  static std::vector<SurfacePoint> middles_of(
      const std::vector<ThinBall>& thin) {
    std::vector<SurfacePoint> middles(thin.size());
    for (std::size_t i = 0; i < thin.size(); ++i) {
      middles[i].place = thin[i].ball.centre;
    }
    return middles;
  }

  ThinPlace place_of(std::vector<std::uint32_t>& members) const {
    std::sort(members.begin(), members.end(),
              [&](std::uint32_t a, std::uint32_t b) {
                return std::tuple(thin_[a].ball.radius, a) <
                       std::tuple(thin_[b].ball.radius, b);
              });
    const auto& [number, ball] = thin_[members.front()];
    const SurfacePoint& touch = samples_.points[number];
    const SurfacePoint& stop = samples_.points[*ball.stop];
    ThinPlace place;
    place.width = 2 * ball.radius;
    place.place = ball.centre;
    place.across = glm::normalize(stop.place - touch.place);
    place.instances = {touch.instance, stop.instance};
    for (const std::uint32_t member : members) {
      // Each side has its own points.
      place.area += samples_.points[thin_[member].point].area / 2;
      place.box.add(thin_[member].ball.centre);
    }
    const Ball& middle = thin_[members[members.size() / 2]].ball;
    if (ball.radius < kEdgeShare * middle.radius) {
      place.shape = ThinShape::kEdge;
    } else if (is_line(middle)) {
      place.shape = ThinShape::kWire;
      // Towards its axis, from the middle of a ball beside it; once more, as a
      // small ball does not go far.
      const double reach = ball.radius / 2;
      const Ball inscribed =
          balls_.climb(balls_.climb(ball.centre, reach).centre, reach);
      place.place = inscribed.centre;
      place.width = 2 * inscribed.radius;
    }
    return place;
  }

  // Whether the middles of balls near this one lie along a line. The variance
  // along it is the greatest eigenvalue of their covariance, found by powers.
  bool is_line(const Ball& ball) const {
    const double diameter = 2 * ball.radius;
    const std::vector<std::uint32_t> near =
        near_.points_within(ball.centre, diameter);
    const auto count = static_cast<double>(near.size());
    Vec3 mean(0);
    for (const std::uint32_t i : near) mean += middles_[i].place / count;
    glm::dmat3 covariance(0.0);
    for (const std::uint32_t i : near) {
      const Vec3 offset = middles_[i].place - mean;
      covariance += glm::outerProduct(offset, offset) / count;
    }
    Vec3 along(0.6, 0.5, 0.62);
    for (int i = 0; i < 40; ++i) {
      const Vec3 next = covariance * along;
      if (glm::length(next) == 0) return true;  // they are all the same
      along = glm::normalize(next);
    }
    const double whole = covariance[0][0] + covariance[1][1] + covariance[2][2];
    const double across = whole - glm::dot(along, covariance * along);
    return std::sqrt(std::max(across, 0.0)) < kWireShare * diameter;
  }

  const SolidSamples& samples_;
  const BallFinder& balls_;
  const std::vector<ThinBall> thin_;
  const std::vector<SurfacePoint> middles_;
  const BallFinder near_;
  UnionFind joined_;
};

}  // namespace

bool is_too_thin(const ThinPlace& place, double least) {
  const bool is_large = place.shape == ThinShape::kWire
                            ? glm::length(place.box.size()) >= least
                            : place.area >= least * least;
  return is_large && place.width < kLetPass * least;
}

std::vector<ThinPlace> find_thin_places(const SolidSamples& samples,
                                        const BallFinder& balls, double width) {
  std::vector<ThinPlace> places;
  for (const bool is_gap : {false, true}) {
    ThinSide(samples, balls,
             ThinBalls(samples, balls, width, is_gap ? 1.0 : -1.0).find())
        .add_places(is_gap, places);
  }
  // Wires may be thicker than the balls beside their axes.
  std::erase_if(places,
                [&](const ThinPlace& place) { return place.width > width; });
  std::stable_sort(
      places.begin(), places.end(),
      [](const ThinPlace& a, const ThinPlace& b) { return a.width < b.width; });
  return places;
}

}  // namespace lamina::slicer
