#include "slicer/check/thin/thin_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace lamina::slicer {
namespace {

// The boundary may reach into a disk by this much [mm]: the rounding of a disk
// that touches three sides at once. The kinetic ray moves no point by more.
constexpr double kTouchDistance = 1e-8;

// A wall is thin only where it falls short of the limit by more than this [mm]:
// one that was designed as thick as the limit is not.
constexpr double kSlack = 1e-6;

// Cuts that clear a range of what blocks it, at most. Each is final but for
// rounding, so that few are needed.
constexpr int kMostCuts = 1000;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const double kCosFacing = std::cos(kFacingAngle);
// From the place where a disk touches the edge in hand, the other one is seen
// within half the facing angle.
const double kTanHalfFacing = std::tan(kFacingAngle / 2);

double squared(double a) { return a * a; }

// Whether the segment comes nearer to the point than `distance`.
bool is_near(const LayerEdge& edge, Vec2 point, double distance) {
  const Vec2 to = point - edge.from;
  const double along = std::clamp(dot(to, edge.along), 0.0, edge.length);
  const Vec2 away = to - along * edge.along;
  return dot(away, away) < distance * distance;
}

}  // namespace

void ThinFinder::Range::keep_where_positive(double c0, double c1) {
  if (c1 > 0) {
    keep_above(-c0 / c1);
  } else if (c1 < 0) {
    keep_below(-c0 / c1);
  } else if (c0 < 0) {
    low = kInfinity;
  }
}

ThinFinder::ThinFinder(double width) : width_(width - kSlack) {}

void ThinFinder::find(const plane::Contours& contours,
                      std::vector<ThinStretch>& stretches) {
  stretches.clear();
  stretches_ = &stretches;
  collect_edges(contours, edges_);
  is_thin_.assign(contours.loop_count(), false);
  cells_.build(edges_, width_);
  last_blocker_ = 0;
  if (cells_.has_facing()) {
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      cells_.gather(i, neighbours_);
      if (neighbours_.empty()) continue;
      take_in_hand(i, ThinKind::kWall);
      look_around();
      take_in_hand(i, ThinKind::kGap);
      look_around();
      face_corners(i);
    }
  }
  add_small_loops();
}

// --- The frame of the edge in hand -------------------------------------------
// Seen from the other side a void is a solid: in either frame the disk rolls to
// the left of all edges.

void ThinFinder::take_in_hand(std::uint32_t number, ThinKind kind) {
  number_ = number;
  edge_ = edges_[number];
  kind_ = kind;
  side_ = kind == ThinKind::kWall ? 1 : -1;
}

ThinFinder::Seen ThinFinder::see(std::uint32_t other) const {
  const LayerEdge& edge = edges_[other];
  const Vec2 to = edge.from - edge_.from;
  return {other,
          dot(to, edge_.along),
          side_ * cross(edge_.along, to),
          dot(edge.along, edge_.along),
          side_ * cross(edge_.along, edge.along),
          edge.length};
}

Vec2 ThinFinder::in_layer(double s, double h) const {
  return edge_.from + s * edge_.along + (side_ * h) * left_of(edge_.along);
}

// --- What faces the edge in hand ---------------------------------------------

void ThinFinder::look_around() {
  for (const std::uint32_t i : neighbours_) {
    if (i == number_) continue;
    const Seen seen = see(i);
    // The first of two edges rolls its disk along the second.
    if (i > number_ && seen.u <= -kCosFacing) face_edge(seen);
    if (seen.h > kTouchDistance && seen.h < width_) face_corner(seen);
  }
}

// A disk that touches the edge in hand at s has its centre at (s, r); it
// touches the other edge's line if its centre is r to the left of that line.
void ThinFinder::face_edge(const Seen& seen) {
  const double c1 = -seen.v / (1 - seen.u);
  const double c0 = (seen.v * seen.s - seen.u * seen.h) / (1 - seen.u);
  Range range{0, edge_.length};
  range.keep_where_positive(c0, c1);
  range.keep_where_positive(width_ / 2 - c0, -c1);
  // Between the ends of the other edge.
  const double t0 = -seen.u * seen.s + seen.v * (c0 - seen.h);
  const double t1 = seen.u + seen.v * c1;
  range.keep_where_positive(t0, t1);
  range.keep_where_positive(seen.length - t0, -t1);
  if (range.is_empty()) return;
  // Where two edges meet, a disk of no width lies on either side; it grows on
  // the sharp side only.
  const Polynomial radius{c0, c1, 0};
  if (std::max(radius(range.low), radius(range.high)) < kTouchDistance) return;
  roll({seen.edge, false, 0, radius, range});
}

// A disk touches a corner that points at it: one where the boundary turns to
// the right. There the normal lies between those of the two edges. Towards s =
// x the normal is turned by an angle of which x / h is the tangent of the half.
void ThinFinder::face_corner(const Seen& seen) {
  const double h = seen.h;
  if (seen.s < -h || seen.s > edge_.length + h) return;
  const LayerEdge& before = edges_[edges_[seen.edge].previous];
  const double before_u = dot(before.along, edge_.along);
  const double before_v = side_ * cross(edge_.along, before.along);
  if (before_u * seen.v - before_v * seen.u >= 0) return;
  const double most = before_u < 1 ? -before_v / (1 - before_u) : kInfinity;
  const double least = seen.u < 1 ? -seen.v / (1 - seen.u) : -kInfinity;
  Range half_tangents{-kTanHalfFacing, kTanHalfFacing};
  // The normals may include the one straight away from the edge in hand.
  const bool is_split = least > most;
  if (!is_split || most >= -kTanHalfFacing) half_tangents.keep_below(most);
  if (!is_split || most < -kTanHalfFacing) half_tangents.keep_above(least);
  if (half_tangents.is_empty()) return;

  Range range{h * half_tangents.low, h * half_tangents.high};
  const double reach = std::sqrt(h * (width_ - h));
  range.keep_above(std::max(-reach, -seen.s));
  range.keep_below(std::min(reach, edge_.length - seen.s));
  if (range.is_empty()) return;
  roll({seen.edge, true, seen.s, {h / 2, 0, 1 / (2 * h)}, range});
}

// --- The disk that rolls -----------------------------------------------------

// Cuts what blocks the disk out of the range and keeps the rest.
void ThinFinder::roll(const Facing& facing) {
  ranges_.assign(1, facing.range);
  for (int cuts = 0; !ranges_.empty() && cuts < kMostCuts;) {
    const Range range = ranges_.back();
    ranges_.pop_back();
    bool is_free = true;
    for (const double x :
         {least(facing.radius, range), range.low, range.high}) {
      const double radius = facing.radius(x);
      const LayerEdge* const blocker =
          find_blocker(in_layer(facing.origin + x, radius), radius);
      if (blocker == nullptr) continue;
      const Range blocked = blocked_range(*blocker, facing, x);
      if (blocked.low > range.low) ranges_.push_back({range.low, blocked.low});
      if (blocked.high < range.high) {
        ranges_.push_back({blocked.high, range.high});
      }
      ++cuts;
      is_free = false;
      break;
    }
    if (is_free) add_stretch(facing, range);
  }
}

// The place of the least radius; the middle where it is the same everywhere.
double ThinFinder::least(const Polynomial& radius, const Range& range) {
  if (radius.c2 > 0) {
    return std::clamp(-radius.c1 / (2 * radius.c2), range.low, range.high);
  }
  const double growth = radius.c1 * (range.high - range.low);
  if (std::abs(growth) < kTouchDistance) return (range.low + range.high) / 2;
  return growth > 0 ? range.low : range.high;
}

// What blocked the disk last often does so again.
const LayerEdge* ThinFinder::find_blocker(Vec2 centre, double radius) {
  const double distance = radius - kTouchDistance;
  if (!(distance > 0)) return nullptr;
  const auto blocks = [&](std::uint32_t edge) {
    return is_near(edges_[edge], centre, distance);
  };
  if (blocks(last_blocker_)) return &edges_[last_blocker_];
  const auto near = cells_.near(centre);
  const auto blocker = std::ranges::find_if(near, blocks);
  if (blocker == near.end()) return nullptr;
  last_blocker_ = *blocker;
  return &edges_[*blocker];
}

// The range about x in which the same part of the edge, its interior or an end,
// lies in the disk, whose centre is at (s, r).
ThinFinder::Range ThinFinder::blocked_range(const LayerEdge& blocker,
                                            const Facing& facing,
                                            double x) const {
  const Seen seen = see(static_cast<std::uint32_t>(&blocker - edges_.data()));
  const Polynomial& r = facing.radius;
  const double s = seen.s - facing.origin;
  // How far along the edge the disk's centre is, and how far to its left.
  const Polynomial along{-seen.u * s + seen.v * (r.c0 - seen.h),
                         seen.u + seen.v * r.c1, seen.v * r.c2};
  const double at = along(x);
  // So near an end the end is in the disk, too. A disk that rolls level with it
  // would be in the interior by rounding, and leave that at once.
  if (at > kTouchDistance && at < seen.length - kTouchDistance) {
    const Polynomial left{seen.v * s + seen.u * (r.c0 - seen.h),
                          -seen.v + seen.u * r.c1, seen.u * r.c2};
    Range range{-kInfinity, kInfinity};
    for (const Polynomial& inside :
         {along, Polynomial{seen.length - along.c0, -along.c1, -along.c2},
          Polynomial{r.c0 - left.c0, r.c1 - left.c1, r.c2 - left.c2},
          Polynomial{r.c0 + left.c0, r.c1 + left.c1, r.c2 + left.c2}}) {
      const Range part = range_around(inside, x);
      range.keep_above(part.low);
      range.keep_below(part.high);
    }
    return range;
  }
  const double end = at > seen.length / 2 ? seen.length : 0;
  const double end_s = s + seen.u * end;
  const double end_h = seen.h + seen.v * end;
  // r² - (distance)² = 2 r h - (x - s)² - h²
  return range_around({2 * r.c0 * end_h - squared(end_s) - squared(end_h),
                       2 * r.c1 * end_h + 2 * end_s, 2 * r.c2 * end_h - 1},
                      x);
}

// The range about x, where the polynomial is positive, up to its roots.
ThinFinder::Range ThinFinder::range_around(const Polynomial& polynomial,
                                           double x) {
  Range range{-kInfinity, kInfinity};
  // In y = place - x: value + slope y + c2 y².
  const double value = polynomial(x);
  const double slope = polynomial.c1 + 2 * polynomial.c2 * x;
  const double discriminant = slope * slope - 4 * polynomial.c2 * value;
  if (discriminant < 0) return range;
  const double q = -(slope + std::copysign(std::sqrt(discriminant), slope)) / 2;
  for (const double root : {q / polynomial.c2, value / q}) {
    if (root > 0) range.keep_below(x + root);
    if (root <= 0) range.keep_above(x + root);
  }
  return range;
}

void ThinFinder::add_stretch(const Facing& facing, const Range& range) {
  const double x = least(facing.radius, range);
  const double r = facing.radius(x);
  const double s = facing.origin + x;
  const LayerEdge& other = edges_[facing.edge];
  ThinStretch stretch;
  stretch.kind = kind_;
  stretch.width = std::max(2 * r, 0.0);
  stretch.place = in_layer(s, r);
  stretch.sides[0] = in_layer(s, 0);
  stretch.sides[1] = facing.is_corner
                         ? other.from
                         : stretch.place - (side_ * r) * left_of(other.along);
  const double from_radius = facing.radius(range.low);
  const double to_radius = facing.radius(range.high);
  stretch.from = in_layer(facing.origin + range.low, from_radius);
  stretch.to = in_layer(facing.origin + range.high, to_radius);
  stretch.reach = std::max(from_radius, to_radius);
  stretches_->push_back(stretch);
  is_thin_[edge_.loop] = true;
  is_thin_[other.loop] = true;
}

// --- Corners -----------------------------------------------------------------

// Finds necks between two corners that point at each other. Beside a neck the
// disk grows, and touches edges as soon as it leaves the corners.
void ThinFinder::face_corners(std::uint32_t number) {
  const Vec2 here = edges_[number].from;
  const double turn =
      cross(edges_[edges_[number].previous].along, edges_[number].along);
  if (turn == 0) return;
  for (const std::uint32_t i : neighbours_) {
    if (i <= number) continue;
    const LayerEdge& other = edges_[i];
    const Vec2 step = other.from - here;
    const double squared_distance = dot(step, step);
    if (!(squared_distance < width_ * width_) || squared_distance == 0 ||
        turn * cross(edges_[other.previous].along, other.along) <= 0 ||
        !points_to(number, step) || !points_to(i, -step)) {
      continue;
    }
    const double distance = std::sqrt(squared_distance);
    const Vec2 centre = here + 0.5 * step;
    if (find_blocker(centre, distance / 2) != nullptr) continue;
    stretches_->push_back({turn < 0 ? ThinKind::kWall : ThinKind::kGap,
                           distance,
                           centre,
                           {here, other.from},
                           centre,
                           centre,
                           distance / 2});
    is_thin_[edges_[number].loop] = true;
    is_thin_[other.loop] = true;
  }
}

// Whether the direction lies between the normals of the edges at the corner
// where this edge begins.
bool ThinFinder::points_to(std::uint32_t number, Vec2 direction) const {
  const LayerEdge& edge = edges_[number];
  return dot(direction, edges_[edge.previous].along) >= 0 &&
         dot(direction, edge.along) <= 0;
}

// Adds loops that are thin as a whole. One that encloses nothing is neither
// wall nor gap.
void ThinFinder::add_small_loops() {
  for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
    const std::uint32_t loop = edges_[begin].loop;
    const Vec2 origin = edges_[begin].from;
    double doubled_area = 0;
    double length = 0;
    Vec2 moment(0);  // first moment of six times the area
    Box2 box;
    std::size_t longest = begin;
    for (end = begin; end < edges_.size() && edges_[end].loop == loop; ++end) {
      const Vec2 a = edges_[end].from - origin;
      const Vec2 b = edges_[end].to() - origin;
      doubled_area += cross(a, b);
      moment += cross(a, b) * (a + b);
      length += edges_[end].length;
      box.add(edges_[end].from);
      if (edges_[end].length > edges_[longest].length) longest = end;
    }
    const double width = 2 * std::abs(doubled_area) / length;
    if (is_thin_[loop] || !(width < width_) || doubled_area == 0) continue;
    // The centroid of a loop that crosses itself may lie anywhere.
    const Vec2 centre =
        glm::clamp(origin + moment / (3 * doubled_area), box.low, box.high);
    const Vec2 side = edges_[longest].from +
                      (edges_[longest].length / 2) * edges_[longest].along;
    stretches_->push_back({doubled_area > 0 ? ThinKind::kWall : ThinKind::kGap,
                           width,
                           centre,
                           {side, side},
                           centre,
                           centre,
                           width / 2});
  }
}

}  // namespace lamina::slicer
