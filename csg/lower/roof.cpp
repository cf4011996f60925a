#include "csg/lower/detail/roof.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/plane.h"
#include "csg/boundary/convex_hull.h"
#include "csg/lower/detail/tracks.h"
#include "csg/plane/offset.h"

namespace lamina::csg {
namespace {

using planar::Contour;
using planar::Region;

constexpr double kRadians = std::numbers::pi / 180;

Vec2 turned(Vec2 v, double angle) {
  return std::cos(angle) * v + std::sin(angle) * left_of(v);
}

// Adds convex solids to one mesh.
class Cutters {
 public:
  // Begins with the strips along all edges of the region.
  Cutters(const Region& region, double top) {
    for (const Contour& contour : region.contours) {
      for (const Edge& edge : edges_of(contour)) add_strip(edge, top);
    }
  }

  void add(std::vector<Vec3> points) {
    const Mesh hull = convex_hull(std::move(points));
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), hull.vertices.begin(),
                          hull.vertices.end());
    for (const auto& [a, b, c] : hull.triangles) {
      mesh_.triangles.push_back({first + a, first + b, first + c});
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  // At each height z the strip that is nearer than z to the edge.
  void add_strip(const Edge& edge, double top) {
    const Vec2 out = edge.normal() * top;
    add({Vec3(edge.begin, 0), Vec3(edge.end, 0), Vec3(edge.begin - out, top),
         Vec3(edge.begin + out, top), Vec3(edge.end - out, top),
         Vec3(edge.end + out, top)});
  }

  Mesh mesh_;
};

// How far back over both strips the part between them reaches, so that no two
// faces only touch.
constexpr double kReach = 120 * kRadians;

void add_fan(Cutters& cutters, const ReflexCorner& corner, double top,
             double step_deg) {
  const Vec2 first = corner.before.normal();
  const double turn = corner.turn();
  const int parts = std::max(
      1, static_cast<int>(std::ceil(-turn / (step_deg * kRadians) - 1e-9)));
  std::vector<Vec3> points = {Vec3(corner.point, 0)};
  const auto add = [&](Vec2 direction) {
    points.emplace_back(corner.point + direction * top, top);
  };
  add(turned(first, kReach));
  for (int i = 0; i < parts; ++i) add(turned(first, turn * i / parts));
  add(corner.after.normal());
  add(turned(corner.after.normal(), -kReach));
  cutters.add(std::move(points));
}

// What the front of one edge sweeps beside a track that ended, after that.
void add_flank(Cutters& cutters, const Track& track, Vec2 normal, double top) {
  const Vec2 start = track.start;
  const Vec2 end = track.at(track.end_time);
  cutters.add({Vec3(start, track.start_time), Vec3(end, track.end_time),
               Vec3(start, top), Vec3(end, top),
               Vec3(start + (top - track.start_time) * normal, top),
               Vec3(end + (top - track.end_time) * normal, top)});
}

// The sharp join along a track, and what it leaves behind.
void add_track(Cutters& cutters, const Track& track, double top) {
  const double end_time = std::min(track.end_time, top);
  const double length = end_time - track.start_time;
  if (!(length > 0)) return;
  const Vec2 before = track.before.normal();
  const Vec2 after = track.after.normal();
  std::vector<Vec3> points = {Vec3(track.start, track.start_time)};
  for (const Vec2 direction : {turned(before, kReach), before, track.velocity,
                               after, turned(after, -kReach)}) {
    points.emplace_back(track.start + direction * length, end_time);
    points.emplace_back(track.start + direction * length, top);
  }
  cutters.add(std::move(points));
  if (track.end_time < top) {
    add_flank(cutters, track, before, top);
    add_flank(cutters, track, after, top);
  }
}

}  // namespace

double greatest_depth(const Region& region) {
  constexpr double kDigits = 1e-5;
  double border = 0;
  for (const Contour& contour : region.contours) {
    for (const Edge& edge : edges_of(contour)) {
      border += glm::distance(edge.begin, edge.end);
    }
  }
  // That of a convex region lies between: a step to find others from.
  double low = 0;
  double high = 2 * planar::area(region) / border;
  const auto is_beyond = [&](double depth) {
    return planar::offset(region, -depth, planar::Join::kRound, depth * kDigits)
        .is_empty();
  };
  for (; !is_beyond(high); high *= 1.5) low = high;
  while (high - low > high * kDigits) {
    const double middle = (low + high) / 2;
    (is_beyond(middle) ? high : low) = middle;
  }
  return high;
}

Mesh round_cutters(const Region& region, double top, double corner_step_deg) {
  Cutters cutters(region, top);
  for (const Contour& contour : region.contours) {
    for (const ReflexCorner& corner : reflex_corners(contour)) {
      add_fan(cutters, corner, top, corner_step_deg);
    }
  }
  return cutters.take();
}

Mesh sharp_cutters(const Region& region, double top) {
  Cutters cutters(region, top);
  for (const Track& track : trace_corners(region)) {
    add_track(cutters, track, top);
  }
  return cutters.take();
}

}  // namespace lamina::csg
