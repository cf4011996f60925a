#include "plane/region/offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "plane/limits.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "plane/tie_distance.h"

namespace lamina::plane {
namespace {

using std::numbers::pi;

constexpr double kGridPerMm = 1e8;

// Two grid diagonals: closer to the line between its neighbours, or to one of
// them, a vertex is rounding, not the design's, and so is a contour that is no
// wider.
constexpr double kCleanDistance = 1.415;

// OpenSCAD's limit for spikes at sharp corners of delta offsets [amounts].
constexpr double kMiterLimit = 1000000;

// Clipper's greatest tolerance of arcs whose steps go to the nearest number
// [amounts]: no arc has fewer than 4.35 sides of a circle.
constexpr double kGreatestTolerance = 0.25;

// OpenSCAD's limit for spikes of strokes [half widths].
constexpr double kStrokeMiterLimit = 2;

// Edges of a border that are shorter than this [amounts], and than a tie, are
// rounding.
constexpr double kShortestEdge = 0.01;

// Edges of a strip at most. All of them may cross all others; fewer make more
// strips to unite.
constexpr std::size_t kMostEdges = 16;

// Strips that are united at once: a union takes some kilobytes of memory for
// each.
constexpr std::size_t kMostStrips = 4096;

double round_to_grid(double x) {
  if (is_too_far(x)) fail_too_far();
  return static_cast<double>(std::llround(x * kGridPerMm)) / kGridPerMm;
}

Vec2 round_to_grid(Vec2 point) {
  return {round_to_grid(point.x), round_to_grid(point.y)};
}

// The region's contours without corners that are nearer than `distance` to the
// ones before them. An edge so short may go anywhere, be it by rounding: its
// corners would turn to the wrong side, or become spikes. A sliver, which has
// two other edges, stays as it is; a contour that has none is left out.
std::vector<Contour> border_of(const Region& region, double distance) {
  std::vector<Contour> border;
  for (const Contour& contour : region.contours) {
    Contour kept;
    for (const Vec2 point : contour) {
      if (kept.empty() || glm::distance(point, kept.back()) > distance) {
        kept.push_back(point);
      }
    }
    while (kept.size() > 1 &&
           glm::distance(kept.back(), kept.front()) <= distance) {
      kept.pop_back();
    }
    if (kept.size() < 2) continue;
    border.push_back(kept.size() > 2 ? std::move(kept) : contour);
  }
  return border;
}

Contour reversed(const Contour& contour) {
  return {contour.rbegin(), contour.rend()};
}

// Drops corners that the line between their neighbours all but passes.
void drop_straight(Contour& contour) {
  Contour kept;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 before = kept.empty() ? contour.back() : kept.back();
    const bool is_last = i + 1 == contour.size() && !kept.empty();
    const Vec2 after =
        is_last ? kept.front() : contour[(i + 1) % contour.size()];
    const Vec2 along = after - before;
    const Vec2 way = contour[i] - before;
    const double aside = std::abs(cross(way, along));
    const bool is_between = glm::dot(way, along) > 0 &&
                            glm::dot(way, along) < glm::dot(along, along);
    if (!is_between || aside * kGridPerMm > kCleanDistance * glm::length(along))
      kept.push_back(contour[i]);
  }
  contour = std::move(kept);
}

// Whether the contour runs once around a convex region on its left.
bool is_convex(const Contour& contour) {
  int turns = 0;  // from right to left and back
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 corner = contour[(i + 1) % contour.size()];
    const Vec2 along = corner - contour[i];
    const Vec2 next = contour[(i + 2) % contour.size()] - corner;
    if (cross(along, next) < 0) return false;
    if ((along.x < 0) != (next.x < 0)) ++turns;
  }
  return turns == 2;
}

// What is left of a convex region `amount` inside of all of its sides.
//
// The sides cut it off one after the other. Where the ring begins and ends it
// lies farthest beyond the next side: there the sides that have cut give way to
// those that have yet to. Every new corner lies between two others, so that
// rounding moves none farther than it moves the sides, however thin the rest is
// and however small the angles between them are.
Contour eroded(const Contour& contour, double amount) {
  std::deque<Vec2> ring(contour.begin(), contour.end());
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 along =
        glm::normalize(contour[(i + 1) % contour.size()] - contour[i]);
    const auto depth = [&](Vec2 point) {
      return cross(along, point - contour[i]) - amount;
    };
    const auto meet = [&](Vec2 inside, Vec2 outside) {
      const double height = depth(inside);
      return inside + (outside - inside) * (height / (height - depth(outside)));
    };
    if (depth(ring.front()) >= 0 && depth(ring.back()) >= 0) continue;
    // The corners that are cut off, in their order.
    Vec2 first = ring.front();
    Vec2 last = ring.back();
    for (; !ring.empty() && depth(ring.front()) < 0; ring.pop_front()) {
      last = ring.front();
    }
    for (; !ring.empty() && depth(ring.back()) < 0; ring.pop_back()) {
      first = ring.back();
    }
    if (ring.empty()) return {};
    const Vec2 begin = meet(ring.front(), last);
    const Vec2 end = meet(ring.back(), first);
    ring.push_front(begin);
    ring.push_back(end);
  }
  return {ring.begin(), ring.end()};
}

// What lies between the strips of two edges, outside of the corner.
enum class Bend { kRound, kMiter, kBevel, kNone };

// The bend that each Join and each Cap asks for.
constexpr std::array kBendsOfJoins = {Bend::kRound, Bend::kMiter, Bend::kBevel};
constexpr std::array kBendsOfCaps = {Bend::kNone, Bend::kRound, Bend::kBevel};

struct Corner {
  Vec2 point;
  Vec2 before;      // normal of the edge that ends here
  Vec2 after;       // of the one that begins
  double sine = 0;  // of the angle between these
  double cosine = 0;
  double shorter = 0;  // length of the shorter edge [mm]
  Bend bend = Bend::kRound;
};

// Moves contours, the inside on their left, to their right.
class Mover {
 public:
  Mover(double amount, Join join, double miter_limit, double arc_tolerance,
        ArcSteps steps)
      : amount_(amount),
        bend_(kBendsOfJoins[static_cast<std::size_t>(join)]),
        least_miter_(2 / (miter_limit * miter_limit)),
        steps_(steps) {
    const double size = std::abs(amount);
    const double greatest =
        steps == ArcSteps::kNearest ? kGreatestTolerance * size : size;
    // In Clipper's order: corners of 90° take 7.5 steps of 12°, or almost.
    sides_ = pi / std::acos(1 - std::min(arc_tolerance, greatest) / size);
    step_ = 2 * pi / sides_;
    steps_per_radian_ = sides_ / (2 * pi);
  }

  // Contours are walks along a path and back, which turn at the first corner
  // and half way.
  void set_cap(Cap cap) { cap_ = kBendsOfCaps[static_cast<std::size_t>(cap)]; }

  // A curve around what the contour winds around and what its edges sweep.
  Contour move(const Contour& contour) const {
    if (const auto shrunk = shrink(contour)) return *shrunk;
    Contour curve;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      add_corner(corner_at(contour, i), curve);
    }
    return curve;
  }

  // Appends what the edges sweep, some of them together.
  void add_strips(const Contour& contour, std::vector<Region>& strips) const {
    if (const auto shrunk = shrink(contour)) {
      strips.push_back(strip_of({*shrunk, reversed(contour)}));
      return;
    }
    const std::size_t count = 1 + (contour.size() - 1) / kMostEdges;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t begin = i * contour.size() / count;
      const std::size_t end = (i + 1) * contour.size() / count;
      strips.push_back(strip_of({around_edges(contour, begin, end)}));
    }
  }

  // Around a pen at a point.
  Contour around(Vec2 point) const {
    Contour curve;
    if (bend_ == Bend::kRound) {
      add_rays(point, {1, 0}, step_, std::floor(sides_), curve);
    } else {
      for (const Vec2 ray :
           {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
        add(point + ray * amount_, curve);
      }
    }
    return curve;
  }

 private:
  static Vec2 outwards(Vec2 begin, Vec2 end) {
    return -left_of(glm::normalize(end - begin));
  }

  // From a moved curve and the border backwards: they wind around a strip
  // counter-clockwise if it is on the border's right, else clockwise.
  static Region strip_of(const std::vector<Contour>& contours) {
    return from_contours(contours, FillRule::kNonZero);
  }

  // Returns what the moved edges of a convex region enclose that gets smaller:
  // all their strips would overlap.
  std::optional<Contour> shrink(const Contour& contour) const {
    if (cap_) return {};
    if (amount_ < 0) {
      return is_convex(contour) ? std::optional(shrunk(contour)) : std::nullopt;
    }
    const Contour hole = reversed(contour);
    return is_convex(hole) ? std::optional(reversed(shrunk(hole)))
                           : std::nullopt;
  }

  Contour shrunk(const Contour& contour) const {
    Contour curve;
    for (const Vec2 point : eroded(contour, std::abs(amount_))) {
      add(point, curve);
    }
    return curve;
  }

  // Around the strip of the edges from one corner to another, with its join.
  Contour around_edges(const Contour& contour, std::size_t begin,
                       std::size_t end) const {
    const Corner first = corner_at(contour, begin);
    const Corner last = corner_at(contour, end);
    Contour curve;
    add(first.point + first.after * amount_, curve);
    for (std::size_t i = begin + 1; i < end; ++i) {
      add_corner(corner_at(contour, i), curve);
    }
    if (is_inner(last)) {
      add(last.point + last.before * amount_, curve);
    } else {
      add_corner(last, curve);
      add(last.point + last.after * amount_, curve);
    }
    for (std::size_t i = end + 1; i-- > begin;) {
      curve.push_back(contour[i % contour.size()]);
    }
    return curve;
  }

  // Counted on around the contour.
  Corner corner_at(const Contour& contour, std::size_t i) const {
    const std::size_t size = contour.size();
    const Vec2 before = contour[(i + size - 1) % size];
    const Vec2 point = contour[i % size];
    const Vec2 after = contour[(i + 1) % size];
    const Vec2 normal_before = outwards(before, point);
    const Vec2 normal_after = outwards(point, after);
    const bool is_turn = i % size == 0 || i == size / 2;
    return {.point = point,
            .before = normal_before,
            .after = normal_after,
            .sine = cross(normal_before, normal_after),
            .cosine = glm::dot(normal_before, normal_after),
            .shorter = std::min(glm::distance(before, point),
                                glm::distance(point, after)),
            .bend = cap_ && is_turn ? *cap_ : bend_};
  }

  // Whether the strips of its edges overlap.
  bool is_inner(const Corner& corner) const {
    return corner.sine * amount_ < 0;
  }

  void add_corner(const Corner& corner, Contour& curve) const {
    const auto& [point, before, after, sine, cosine, shorter, bend] = corner;
    if (std::abs(sine * amount_) * kGridPerMm < 1 && cosine > 0) {
      add(point + before * amount_, curve);
    } else if (!is_inner(corner)) {
      add_join(corner, curve);
    } else if (-sine * amount_ <= shorter / 2 * (1 + cosine)) {
      // The moved edges cross before their middles.
      add_miter(corner, curve);
    } else {
      add(point + before * amount_, curve);
      add(point, curve);
      add(point + after * amount_, curve);
    }
  }

  void add_join(const Corner& corner, Contour& curve) const {
    const auto& [point, before, after, sine, cosine, shorter, bend] = corner;
    // Where the border turns back, too, on the side to which it moves.
    const double angle =
        std::copysign(std::atan2(std::abs(sine), cosine), amount_);
    if (bend == Bend::kRound) {
      add_arc(corner, angle, curve);
    } else if (bend == Bend::kMiter && 1 + cosine >= least_miter_) {
      add_miter(corner, curve);
    } else if (bend == Bend::kNone) {
      add(point + before * amount_, curve);
      add(point + after * amount_, curve);
    } else {
      const double share = std::tan(angle / 4);
      add(point + (before + left_of(before) * share) * amount_, curve);
      add(point + (after - left_of(after) * share) * amount_, curve);
    }
  }

  void add_miter(const Corner& corner, Contour& curve) const {
    const double share = amount_ / (1 + corner.cosine);
    add(corner.point + (corner.before + corner.after) * share, curve);
  }

  void add_arc(const Corner& corner, double angle, Contour& curve) const {
    const double share = std::abs(angle) * steps_per_radian_;
    const double count =
        steps_ == ArcSteps::kUp ? std::ceil(share) : std::round(share);
    add_rays(corner.point, corner.before, std::copysign(step_, angle),
             std::max(count, 1.0), curve);
    add(corner.point + corner.after * amount_, curve);
  }

  void add_rays(Vec2 point, Vec2 ray, double turn, double count,
                Contour& curve) const {
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    add(point + ray * amount_, curve);
    for (double i = 1; i < count; ++i) {
      ray = ray * c + left_of(ray) * s;
      add(point + ray * amount_, curve);
    }
  }

  static void add(Vec2 point, Contour& curve) {
    curve.push_back(round_to_grid(point));
  }

  double amount_;
  Bend bend_;
  double least_miter_;
  ArcSteps steps_;
  double sides_ = 0;  // of a circle
  double step_ = 0;   // [rad]
  double steps_per_radian_ = 0;
  std::optional<Bend> cap_;
};

// Drops what is rounding.
Region cleaned(Region region) {
  for (Contour& contour : region.contours) drop_straight(contour);
  std::erase_if(region.contours,
                [](const Contour& contour) { return contour.size() < 3; });
  drop_hairlines(region, kCleanDistance / kGridPerMm);
  return region;
}

Region unite_strips(std::span<const Region> strips) {
  if (strips.size() <= kMostStrips) return unite(strips);
  const std::size_t half = strips.size() / 2;
  const std::array halves = {unite_strips(strips.first(half)),
                             unite_strips(strips.subspan(half))};
  return unite(halves);
}

// The region with what its border sweeps, or without that.
//
// border  the region's; a walk along a path and back is that of nothing
Region moved(const Mover& mover, std::span<const Contour> border, bool outwards,
             const Region& region) {
  std::vector<Contour> curves;
  for (const Contour& contour : border) {
    Contour curve = mover.move(contour);
    if (!curve.empty()) curves.push_back(std::move(curve));
  }
  if (auto simple = from_few_crossings(curves, FillRule::kPositive)) {
    return cleaned(std::move(*simple));
  }
  std::vector<Region> strips;
  for (const Contour& contour : border) mover.add_strips(contour, strips);
  const std::array operands = {region, unite_strips(strips)};
  return cleaned(outwards ? unite(operands) : subtract(operands));
}

}  // namespace

Region offset(const Region& region, double amount, Join join,
              double arc_tolerance, ArcSteps steps) {
  const Mover mover(amount, join, kMiterLimit, arc_tolerance, steps);
  const double shortest =
      std::min(kTieDistance, kShortestEdge * std::abs(amount));
  return moved(mover, border_of(region, shortest), amount > 0, region);
}

Region stroke(std::span<const Vec2> path, double width, Join join, Cap cap,
              double arc_tolerance) {
  Contour walk;
  for (const Vec2 point : path) {
    const Vec2 rounded = round_to_grid(point);
    if (walk.empty() || rounded != walk.back()) walk.push_back(rounded);
  }
  const double amount = round_to_grid(width / 2);
  if (walk.empty() || amount <= 0) return {};
  Mover mover(amount, join, kStrokeMiterLimit, arc_tolerance,
              ArcSteps::kNearest);
  if (walk.size() == 1) return {{mover.around(walk[0])}};
  for (std::size_t i = walk.size() - 1; i-- > 1;) walk.push_back(walk[i]);
  mover.set_cap(cap);
  return moved(mover, {&walk, 1}, true, {});
}

}  // namespace lamina::plane
