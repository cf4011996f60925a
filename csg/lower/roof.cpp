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
#include "csg/degrees.h"
#include "csg/lower/detail/tracks.h"
#include "csg/plane/boolean.h"
#include "csg/plane/offset.h"

namespace lamina::csg {
namespace {

using planar::Contour;
using planar::Region;

constexpr double kRadians = std::numbers::pi / 180;

// How far cutters go, for them to cut through the prism's top [tops].
constexpr double kBeyond = 1.01;

Vec2 turned(Vec2 v, double angle) {
  return std::cos(angle) * v + std::sin(angle) * left_of(v);
}

// Convex solids, each the hull of its points, that go up to one height.
class Cutters {
 public:
  // Begins with the strips along all edges of the region.
  Cutters(const Region& region, double top) {
    for (const Contour& contour : region.contours) {
      for (const Edge& edge : edges_of(contour)) add_strip(edge, top);
    }
  }

  void add(std::vector<Vec3> points) { solids_.push_back(std::move(points)); }

  Mesh mesh() {
    Mesh mesh;
    for (std::vector<Vec3>& points : solids_) {
      const Mesh hull = convex_hull(std::move(points));
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), hull.vertices.begin(),
                           hull.vertices.end());
      for (const auto& [a, b, c] : hull.triangles) {
        mesh.triangles.push_back({first + a, first + b, first + c});
      }
    }
    return mesh;
  }

  // What they leave of the region at their top.
  Region rest(const Region& region, double top) const {
    std::vector<Box2> boxes;
    for (const Contour& contour : region.contours) {
      boxes.emplace_back().add(contour);
    }
    std::vector<Region> regions = {region};
    for (const std::vector<Vec3>& points : solids_) {
      std::vector<Vec2> section;
      Box2 box;
      for (const Vec3 point : points) {
        if (point.z != top) continue;
        section.emplace_back(point);
        box.add(section.back());
      }
      const auto meets = [&box](Box2 other) {
        other.intersect(box);
        return !other.is_empty();
      };
      if (std::none_of(boxes.begin(), boxes.end(), meets)) continue;
      regions.push_back(planar::convex_hull(std::move(section)));
    }
    return planar::subtract(regions);
  }

 private:
  // At each height z the strip that is nearer than z to the edge.
  void add_strip(const Edge& edge, double top) {
    const Vec2 out = edge.normal() * top;
    add({Vec3(edge.begin, 0), Vec3(edge.end, 0), Vec3(edge.begin - out, top),
         Vec3(edge.begin + out, top), Vec3(edge.end - out, top),
         Vec3(edge.end + out, top)});
  }

  std::vector<std::vector<Vec3>> solids_;
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

Cutters sharp_cutters(const Region& region, const std::vector<Track>& tracks,
                      double top) {
  Cutters cutters(region, top);
  for (const Track& track : tracks) add_track(cutters, track, top);
  return cutters;
}

// The least depth beyond which nothing is left of the region, or up to a share
// of 2e-5 more.
template <typename IsBeyond>
double find_depth(const Region& region, IsBeyond is_beyond) {
  constexpr double kDigits = 1e-5;
  double border = 0;
  for (const Contour& contour : region.contours) {
    for (const Edge& edge : edges_of(contour)) {
      border += glm::distance(edge.begin, edge.end);
    }
  }
  // That of a convex region is no less, and at most twice that; that of a band
  // is that.
  double low = 0;
  double high = planar::area(region) / border;
  for (; !is_beyond(high); high *= 1.5) low = high;
  while (high - low > high * kDigits) {
    const double middle = (low + high) / 2;
    (is_beyond(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

RoofParts round_roof(const Region& region, const Fineness& corners) {
  constexpr double kTolerance = 1e-5;  // of an arc [depths]
  const double depth = find_depth(region, [&](double amount) {
    return planar::offset(region, -amount, planar::Join::kRound,
                          amount * kTolerance)
        .is_empty();
  });
  const double step_deg = arc_step_deg(depth, corners);
  // A polygon in a circle leaves more than the circle.
  const double top = depth / cos_deg(step_deg / 2);
  Cutters cutters(region, top * kBeyond);
  for (const Contour& contour : region.contours) {
    for (const ReflexCorner& corner : reflex_corners(contour)) {
      add_fan(cutters, corner, top * kBeyond, step_deg);
    }
  }
  return {top, cutters.mesh()};
}

RoofParts sharp_roof(const Region& region) {
  const std::vector<Track> tracks = trace_corners(region);
  Region rest = region;  // of the greatest depth that leaves any
  const double top = find_depth(region, [&](double depth) {
    Region next = sharp_cutters(region, tracks, depth).rest(rest, depth);
    if (next.is_empty()) return true;
    rest = std::move(next);
    return false;
  });
  return {top, sharp_cutters(region, tracks, top * kBeyond).mesh()};
}

}  // namespace lamina::csg
