#include "csg/plane/offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <numbers>
#include <utility>
#include <vector>

#include <clipper.hpp>
#include <glm/geometric.hpp>

#include "base/memory_end.h"
#include "base/plane.h"
#include "csg/limits.h"
#include "csg/plane/boolean.h"

namespace lamina::planar {
namespace {

using std::numbers::pi;

constexpr double kGridPerMm = 1e8;

// Clipper, which strokes need, multiplies coordinates in 128 bits; it asks for
// no more than 2^62 grid units.
static_assert(csg::kGreatestCoordinate * kGridPerMm < 0x1p62);

// Two grid diagonals: closer to the line between its neighbours, or to one of
// them, a vertex is the clipper's rounding, not the design's, and so is a
// contour that is no wider.
constexpr double kCleanDistance = 1.415;

// OpenSCAD's limit for spikes at sharp corners of delta offsets [amounts].
constexpr double kMiterLimit = 1000000;

// Clipper's greatest tolerance of arcs whose steps go to the nearest number
// [amounts]: no arc has fewer than 4.35 sides of a circle.
constexpr double kGreatestTolerance = 0.25;

// Its limit for those of strokes [half widths].
constexpr double kStrokeMiterLimit = 2;

ClipperLib::cInt to_grid(double x) {
  if (csg::is_too_far(x)) csg::fail_too_far();
  return std::llround(x * kGridPerMm);
}

double round_to_grid(double x) {
  return static_cast<double>(to_grid(x)) / kGridPerMm;
}

ClipperLib::Path to_path(const Contour& contour) {
  ClipperLib::Path path;
  path.reserve(contour.size());
  for (const Vec2 point : contour) {
    path.push_back({to_grid(point.x), to_grid(point.y)});
  }
  return path;
}

// Clipper may join edges that end in one point to contours that cross there, or
// take a hole for an outline. Only its edges are believed.
Region to_region(ClipperLib::Paths paths) {
  ClipperLib::CleanPolygons(paths, kCleanDistance);
  std::vector<Contour> contours;
  for (const ClipperLib::Path& path : paths) {
    Contour& contour = contours.emplace_back();
    contour.reserve(path.size());
    for (const ClipperLib::IntPoint& point : path) {
      contour.emplace_back(static_cast<double>(point.X) / kGridPerMm,
                           static_cast<double>(point.Y) / kGridPerMm);
    }
  }
  return from_contours(contours);
}

// What Clipper calls each Join and each Cap.
constexpr std::array kJoinTypes = {ClipperLib::jtRound, ClipperLib::jtMiter,
                                   ClipperLib::jtSquare};
constexpr std::array kEndTypes = {
    ClipperLib::etOpenButt, ClipperLib::etOpenRound, ClipperLib::etOpenSquare};

ClipperLib::JoinType to_join_type(Join join) {
  return kJoinTypes[static_cast<std::size_t>(join)];
}

// Drops corners that the line between their neighbours all but passes.
void drop_straight(Contour& contour) {
  Contour kept;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 before = kept.empty() ? contour.back() : kept.back();
    const Vec2 along = contour[(i + 1) % contour.size()] - before;
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
// those that have yet to. Every new corner stands between two others, so that
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

// Moves contours, the inside on their left, to their right.
class Mover {
 public:
  Mover(double amount, Join join, double arc_tolerance, ArcSteps steps)
      : amount_(amount), join_(join), steps_(steps) {
    const double size = std::abs(amount);
    const double greatest =
        steps == ArcSteps::kNearest ? kGreatestTolerance * size : size;
    // In Clipper's order: corners of 90° take 7.5 steps of 12°, or almost.
    const double sides =
        pi / std::acos(1 - std::min(arc_tolerance, greatest) / size);
    step_ = 2 * pi / sides;
    steps_per_radian_ = sides / (2 * pi);
  }

  Contour move(const Contour& contour) const {
    // The strips of a convex region's edges would all overlap.
    if (amount_ < 0 && is_convex(contour)) return shrink(contour);
    if (amount_ > 0) {
      Contour hole(contour.rbegin(), contour.rend());
      if (is_convex(hole)) {
        hole = shrink(hole);
        return {hole.rbegin(), hole.rend()};
      }
    }
    Contour curve;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 before = contour[(i + contour.size() - 1) % contour.size()];
      const Vec2 after = contour[(i + 1) % contour.size()];
      const double shorter = std::min(glm::distance(before, contour[i]),
                                      glm::distance(contour[i], after));
      add_corner(contour[i], outwards(before, contour[i]),
                 outwards(contour[i], after), shorter, curve);
    }
    return curve;
  }

 private:
  static Vec2 outwards(Vec2 begin, Vec2 end) {
    return -left_of(glm::normalize(end - begin));
  }

  // A convex region keeps what its moved edges enclose.
  Contour shrink(const Contour& contour) const {
    Contour curve;
    for (const Vec2 point : eroded(contour, std::abs(amount_))) {
      add(point, curve);
    }
    return curve;
  }

  // before, after  normals of its edges
  // shorter        length of the shorter one [mm]
  void add_corner(Vec2 corner, Vec2 before, Vec2 after, double shorter,
                  Contour& curve) const {
    const double sine = cross(before, after);
    const double cosine = glm::dot(before, after);
    if (std::abs(sine * amount_) * kGridPerMm < 1 && cosine > 0) {
      add(corner + before * amount_, curve);
    } else if (sine * amount_ < 0 &&
               -sine * amount_ <= shorter / 2 * (1 + cosine)) {
      // The moved edges cross before their middles.
      add_miter(corner, before, after, curve);
    } else if (sine * amount_ < 0) {
      // The edges' strips overlap.
      add(corner + before * amount_, curve);
      add(corner, curve);
      add(corner + after * amount_, curve);
    } else if (join_ == Join::kRound) {
      add_arc(corner, before, after, std::atan2(sine, cosine), curve);
    } else if (join_ == Join::kMiter &&
               1 + cosine >= 2 / (kMiterLimit * kMiterLimit)) {
      add_miter(corner, before, after, curve);
    } else {
      const double share = std::tan(std::atan2(sine, cosine) / 4);
      add(corner + (before + left_of(before) * share) * amount_, curve);
      add(corner + (after - left_of(after) * share) * amount_, curve);
    }
  }

  void add_miter(Vec2 corner, Vec2 before, Vec2 after, Contour& curve) const {
    const double share = amount_ / (1 + glm::dot(before, after));
    add(corner + (before + after) * share, curve);
  }

  void add_arc(Vec2 corner, Vec2 before, Vec2 after, double angle,
               Contour& curve) const {
    const double share = std::abs(angle) * steps_per_radian_;
    const double count =
        steps_ == ArcSteps::kUp ? std::ceil(share) : std::round(share);
    const double turn = std::copysign(step_, angle);
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    Vec2 spoke = before;
    add(corner + spoke * amount_, curve);
    for (double i = 1; i < count; ++i) {
      spoke = spoke * c + left_of(spoke) * s;
      add(corner + spoke * amount_, curve);
    }
    add(corner + after * amount_, curve);
  }

  static void add(Vec2 point, Contour& curve) {
    curve.emplace_back(round_to_grid(point.x), round_to_grid(point.y));
  }

  double amount_;
  Join join_;
  ArcSteps steps_;
  double step_ = 0;  // [rad]
  double steps_per_radian_ = 0;
};

}  // namespace

Region offset(const Region& region, double amount, Join join,
              double arc_tolerance, ArcSteps steps) {
  const Mover mover(amount, join, arc_tolerance, steps);
  std::vector<Contour> curves;
  for (const Contour& contour : region.contours) {
    Contour curve = mover.move(contour);
    if (!curve.empty()) curves.push_back(std::move(curve));
  }
  Region result = from_contours(curves, FillRule::kPositive);
  for (Contour& contour : result.contours) drop_straight(contour);
  std::erase_if(result.contours,
                [](const Contour& contour) { return contour.size() < 3; });
  drop_hairlines(result, kCleanDistance / kGridPerMm);
  return result;
}

Region stroke(std::span<const Vec2> path, double width, Join join, Cap cap,
              double arc_tolerance) {
  ClipperLib::ClipperOffset offsetter(kStrokeMiterLimit,
                                      arc_tolerance * kGridPerMm);
  offsetter.AddPath(to_path(Contour(path.begin(), path.end())),
                    to_join_type(join),
                    kEndTypes[static_cast<std::size_t>(cap)]);
  ClipperLib::Paths result;
  watch_memory([&, distance = static_cast<double>(to_grid(width / 2))] {
    offsetter.Execute(result, distance);
  });
  return to_region(std::move(result));
}

}  // namespace lamina::planar
