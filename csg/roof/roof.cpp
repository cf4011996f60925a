#include "csg/roof/roof.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csg/boundary/convex_hull.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/degrees.h"
#include "csg/roof/detail/roof_border.h"
#include "csg/roof/detail/tracks.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "plane/region/offset.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using plane::Region;

constexpr double kRadians = std::numbers::pi / 180;

// How far the cutters of a stage go, for them to cut through its top [tops].
constexpr double kBeyond = 1.01;

// Where the cutters of later stages begin [bottoms].
constexpr double kRear = 0.95;

// Where the prisms of later stages begin, so that they do not only touch those
// below [bottoms].
constexpr double kOverlap = 0.98;

// Stages grow by this factor: more stages cost prisms, fewer let cutters of one
// stage cross each other more often.
constexpr double kGrowth = 1.5;

// How far back over both strips the part between them reaches, so that no two
// faces only touch; and, as a share of the way there, where it begins behind
// the front.
constexpr double kReach = 120 * kRadians;
constexpr double kRearReach = 0.1;

Vec2 turned(Vec2 v, double angle) {
  return std::cos(angle) * v + std::sin(angle) * left_of(v);
}

// Appends a point at two heights.
void add_upright(std::vector<Vec3>& points, Vec2 point, double low,
                 double high) {
  points.emplace_back(point, low);
  points.emplace_back(point, high);
}

// Convex solids, each the hull of its points, that go up to one height: what
// the outline sweeps while it moves on from one time, the bottom, to another
// one, the top. At each height z between them they cover what is left at the
// bottom and swept by the time z. What was swept before, they cover if the
// bottom is 0 and need not else.
class Cutters {
 public:
  Cutters(double bottom, double top)
      : bottom_(bottom), top_(top), rear_(kRear * bottom) {}

  double bottom() const { return bottom_; }
  double top() const { return top_; }
  double rear() const { return rear_; }

  void add(std::vector<Vec3> points) { solids_.push_back(std::move(points)); }

  // Adds what moves on from a part of an edge along its normal. From the
  // outline it goes to both sides.
  void add_strip(const Edge& edge, Part part) {
    if (part.is_empty()) return;
    const Vec2 normal = edge.normal();
    std::vector<Vec3> points;
    for (const Vec2 end : {edge.at(part.from), edge.at(part.to)}) {
      points.emplace_back(end + rear_ * normal, rear_);
      points.emplace_back(end + (is_first() ? -top_ : rear_) * normal, top_);
      points.emplace_back(end + top_ * normal, top_);
    }
    add(std::move(points));
  }

  bool is_first() const { return !(bottom_ > 0); }

  Mesh mesh() {
    Mesh mesh;
    for (std::vector<Vec3>& points : solids_) {
      append(mesh, convex_hull(std::move(points)));
    }
    return mesh;
  }

  // Returns what they leave of the region at their top.
  Region rest(const Region& region) const {
    std::vector<Region> regions = {region};
    for (const std::vector<Vec3>& points : solids_) {
      std::vector<Vec2> section;
      for (const Vec3 point : points) {
        if (point.z == top_) section.emplace_back(point);
      }
      regions.push_back(plane::convex_hull(std::move(section)));
    }
    return plane::subtract(regions);
  }

 private:
  double bottom_;
  double top_;
  double rear_;  // the time from which they cover what was swept
  std::vector<std::vector<Vec3>> solids_;
};

// Adds the strips of those edges that still bound what is left.
void add_strips(Cutters& cutters, const Region& region,
                const RoofBorder& border, double reach) {
  for (const Edge& edge : edges_of(region)) {
    const Vec2 way = edge.normal() * cutters.bottom();
    cutters.add_strip(
        edge, border.near_part({edge.begin + way, edge.end + way}, reach));
  }
}

// The polygon of the arc around a reflex corner.
struct Fan {
  Fan(const ReflexCorner& around, double step_deg) : corner(around) {
    const Vec2 first = corner.before.normal();
    const double turn = corner.turn();
    const int parts = std::max(
        1, static_cast<int>(std::ceil(-turn / (step_deg * kRadians) - 1e-9)));
    for (int i = 0; i < parts; ++i) {
      directions.push_back(turned(first, turn * i / parts));
    }
    directions.push_back(corner.after.normal());
  }

  // A side moves slower than the corners, by this share of what they move.
  double lag() const {
    return 1 / glm::length((directions[0] + directions[1]) / 2.0) - 1;
  }

  ReflexCorner corner;
  std::vector<Vec2> directions;  // of its corners
};

// Adds the whole fan, from the reflex corner on.
void add_fan(Cutters& cutters, const Fan& fan) {
  const Vec2 corner = fan.corner.point;
  std::vector<Vec3> points = {Vec3(corner, 0)};
  const auto add = [&](Vec2 direction) {
    points.emplace_back(corner + direction * cutters.top(), cutters.top());
  };
  add(turned(fan.directions.front(), kReach));
  for (const Vec2 direction : fan.directions) add(direction);
  add(turned(fan.directions.back(), -kReach));
  cutters.add(std::move(points));
}

// Returns the way from a point beside the end of an edge's strip a little back
// over the strip: of the edge before a corner or of the one after it.
Vec2 back_over(const Edge& edge, bool is_before, double rear) {
  const double length = glm::distance(edge.begin, edge.end);
  const double way = std::min(length, kRearReach * rear);
  return edge.direction() * (is_before ? -way : way);
}

// Adds what the sides of a fan's polygon that are near the border sweep, from
// the rear on. Each reaches a little over what is beside it.
void add_blades(Cutters& cutters, const Fan& fan, const RoofBorder& border,
                double reach) {
  const double rear = cutters.rear();
  const double top = cutters.top();
  const ReflexCorner& corner = fan.corner;
  const auto& directions = fan.directions;
  const auto at = [&](Vec2 direction, double time) {
    return corner.point + direction * time;
  };
  for (std::size_t i = 0; i + 1 < directions.size(); ++i) {
    const Edge side = {directions[i], directions[i + 1]};
    const Part part = border.near_part(
        {at(side.begin, cutters.bottom()), at(side.end, cutters.bottom())},
        reach);
    if (part.is_empty()) continue;
    const Vec2 first = side.at(part.from);
    const Vec2 last = side.at(part.to);
    std::vector<Vec3> points;
    for (const Vec2 direction : {first, last}) {
      add_upright(points, at(direction, rear), rear, top);
      points.emplace_back(at(direction, top), top);
    }
    if (part.from == 0) {
      const Vec2 beside =
          i > 0 ? at(glm::mix(first, directions[i - 1], kRearReach), rear)
                : at(first, rear) + back_over(corner.before, true, rear);
      add_upright(points, beside, rear, top);
    }
    if (part.to == 1) {
      const Vec2 beside =
          i + 2 < directions.size()
              ? at(glm::mix(last, directions[i + 2], kRearReach), rear)
              : at(last, rear) + back_over(corner.after, false, rear);
      add_upright(points, beside, rear, top);
    }
    cutters.add(std::move(points));
  }
}

// The front of one edge beside a track: where it moves straight on from the
// track's start, and where it ends, on the track and later beside it.
struct Flank {
  const Track& track;
  bool is_before;  // of the edge before the corner

  const Edge& edge() const { return is_before ? track.before : track.after; }
  Vec2 normal() const { return edge().normal(); }
  Vec2 inner(double time) const {
    return track.start + (time - track.start_time) * normal();
  }
  Vec2 outer(double time) const {
    const double on_track = std::min(time, track.end_time);
    return track.at(on_track) + (time - on_track) * normal();
  }
  Edge front(double time) const { return {inner(time), outer(time)}; }
};

// Adds what it sweeps after the track has ended.
void add_flank(Cutters& cutters, const Flank& flank) {
  const double top = cutters.top();
  const Track& track = flank.track;
  const Vec2 end = flank.outer(track.end_time);
  cutters.add({Vec3(track.start, track.start_time), Vec3(end, track.end_time),
               Vec3(track.start, top), Vec3(end, top),
               Vec3(flank.inner(top), top), Vec3(flank.outer(top), top)});
}

// Adds what it sweeps from the rear on.
void add_late_flank(Cutters& cutters, const Flank& flank) {
  const double rear = cutters.rear();
  const double top = cutters.top();
  const Track& track = flank.track;
  std::vector<Vec3> points;
  const Vec2 inner = flank.inner(rear);
  const Vec2 outer = flank.outer(rear);
  add_upright(points, inner, rear, top);
  add_upright(points, outer, rear, top);
  add_upright(points, inner + back_over(flank.edge(), flank.is_before, rear),
              rear, top);
  if (track.end_time > cutters.bottom()) {
    // A little over the track.
    const Vec2 beyond = Flank{track, !flank.is_before}.inner(rear);
    add_upright(points, glm::mix(outer, beyond, kRearReach / 2), rear, top);
  }
  if (track.end_time > rear && track.end_time < top) {
    add_upright(points, flank.outer(track.end_time), track.end_time, top);
  }
  points.emplace_back(flank.inner(top), top);
  points.emplace_back(flank.outer(top), top);
  cutters.add(std::move(points));
}

// Adds the sharp join along a track, from its start on, and what it leaves
// behind.
void add_track(Cutters& cutters, const Track& track) {
  const double top = cutters.top();
  const double end_time = std::min(track.end_time, top);
  const double length = end_time - track.start_time;
  if (!(length > 0)) return;
  const Vec2 before = track.before.normal();
  const Vec2 after = track.after.normal();
  std::vector<Vec3> points = {Vec3(track.start, track.start_time)};
  for (const Vec2 direction : {turned(before, kReach), before, track.velocity,
                               after, turned(after, -kReach)}) {
    add_upright(points, track.start + direction * length, end_time, top);
  }
  cutters.add(std::move(points));
  if (track.end_time < top) {
    add_flank(cutters, {track, true});
    add_flank(cutters, {track, false});
  }
}

// Halves the range until it is a share of 1e-5 of its end, and returns its end.
// `is_beyond` does not hold at `low`, and holds at `high`.
template <typename IsBeyond>
double find_depth(double low, double high, IsBeyond is_beyond) {
  constexpr double kDigits = 1e-5;
  while (high - low > high * kDigits) {
    const double middle = (low + high) / 2;
    (is_beyond(middle) ? high : low) = middle;
  }
  return high;
}

// A front nearer than this to a border may be part of it.
double rounding(double top) { return 1e-7 + 1e-6 * top; }

double border_of(const Region& region) {
  double border = 0;
  for (const Contour& contour : region.contours) border += perimeter(contour);
  return border;
}

// Raises the roof stage by stage. `cut(border, bottom, top)` makes the cutters
// of those parts of the outline that still bound what is left at the bottom.
template <typename Cut>
std::vector<RoofStage> raise(const Region& region, Cut cut) {
  Box2 box;
  for (const Contour& contour : region.contours) box.add(contour);
  // No point is farther from the outline.
  const double most = std::min(box.size().x, box.size().y) / 2 * kBeyond;
  std::vector<RoofStage> stages;
  Region left = region;
  double bottom = 0;
  const double border_length = border_of(region);
  const auto edge_count = static_cast<double>(plane::corner_count(region));
  double top = std::min(
      {border_length / edge_count, plane::area(region) / border_length, most});
  while (true) {
    const RoofBorder border(left);
    Region rest = cut(border, bottom, top).rest(left);
    const bool is_last = rest.is_empty() || top >= most;
    if (is_last) {
      Region some = left;  // what is left at the greatest depth that leaves any
      top = find_depth(bottom, top, [&](double depth) {
        Region next = cut(border, bottom, depth).rest(some);
        if (next.is_empty()) return true;
        some = std::move(next);
        return false;
      });
    }
    stages.push_back({std::move(left), kOverlap * bottom, top,
                      cut(border, bottom, top * kBeyond).mesh()});
    if (is_last) return stages;
    left = std::move(rest);
    bottom = top;
    top = std::min(top * kGrowth, most);
  }
}

}  // namespace

std::vector<RoofStage> round_roof(
    const Region& region,
    const std::function<double(double radius)>& arc_step_deg) {
  constexpr double kTolerance = 1e-5;  // of an arc [depths]
  const auto is_beyond = [&](double amount) {
    return plane::offset(region, -amount, plane::Join::kRound,
                         amount * kTolerance)
        .is_empty();
  };
  // That of a convex region is no less, and at most twice that; that of a band
  // is that.
  double low = 0;
  double high = plane::area(region) / border_of(region);
  for (; !is_beyond(high); high *= 1.5) low = high;
  const double step_deg = arc_step_deg(find_depth(low, high, is_beyond));

  std::vector<Fan> fans;
  double lag = 0;
  for (const ReflexCorner& corner : reflex_corners(region)) {
    fans.emplace_back(corner, step_deg);
    lag = std::max(lag, fans.back().lag());
  }
  return raise(region,
               [&](const RoofBorder& border, double bottom, double top) {
                 const double reach = lag * (top - bottom) + rounding(top);
                 Cutters cutters(bottom, top);
                 add_strips(cutters, region, border, reach);
                 for (const Fan& fan : fans) {
                   if (cutters.is_first()) {
                     add_fan(cutters, fan);
                   } else {
                     add_blades(cutters, fan, border, reach);
                   }
                 }
                 return cutters;
               });
}

std::vector<RoofStage> sharp_roof(const Region& region) {
  const std::vector<Track> tracks = trace_corners(region);
  return raise(
      region, [&](const RoofBorder& border, double bottom, double top) {
        const double reach = rounding(top);
        Cutters cutters(bottom, top);
        add_strips(cutters, region, border, reach);
        for (const Track& track : tracks) {
          if (track.start_time >= cutters.rear()) {
            add_track(cutters, track);
            continue;
          }
          for (const bool is_before : {true, false}) {
            const Flank flank = {track, is_before};
            if (!border.near_part(flank.front(bottom), reach).is_empty()) {
              add_late_flank(cutters, flank);
            }
          }
        }
        return cutters;
      });
}

}  // namespace lamina::csg
