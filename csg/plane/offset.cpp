#include "csg/plane/offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
// them, a vertex is the clipper's rounding, not the design's.
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

// A line with an inside on its left.
struct Side {
  Vec2 at;
  Vec2 along;  // of length 1

  bool has_inside(Vec2 point) const { return cross(along, point - at) > 0; }
  Vec2 meet(const Side& other) const {
    const double t =
        cross(other.at - at, other.along) / cross(along, other.along);
    return at + along * t;
  }
};

bool are_in_line(const Side& a, const Side& b) {
  return std::abs(cross(a.along, b.along)) * kGridPerMm < 1 &&
         glm::dot(a.along, b.along) > 0;
}

// What lies inside of all sides, which turn once around to the left; nothing if
// there is no such region.
Contour enclosed(std::span<const Side> sides) {
  std::vector<Side> ring;  // those that bound it, so far
  std::size_t first = 0;
  for (const Side& side : sides) {
    while (ring.size() - first >= 2 &&
           !side.has_inside(ring.back().meet(*(ring.end() - 2)))) {
      ring.pop_back();
    }
    while (ring.size() - first >= 2 &&
           !side.has_inside(ring[first].meet(ring[first + 1]))) {
      ++first;
    }
    if (ring.size() > first && cross(ring.back().along, side.along) <= 0) {
      return {};
    }
    ring.push_back(side);
  }
  while (ring.size() - first >= 3 &&
         !ring[first].has_inside(ring.back().meet(*(ring.end() - 2)))) {
    ring.pop_back();
  }
  if (ring.size() - first < 3) return {};
  Contour contour;
  for (std::size_t i = first; i < ring.size(); ++i) {
    contour.push_back(
        ring[i].meet(i + 1 < ring.size() ? ring[i + 1] : ring[first]));
  }
  return contour;
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
    std::vector<Side> sides;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 along =
          glm::normalize(contour[(i + 1) % contour.size()] - contour[i]);
      const Side side{contour[i] + left_of(along) * std::abs(amount_), along};
      if (sides.empty() || !are_in_line(sides.back(), side)) {
        sides.push_back(side);
      }
    }
    while (sides.size() > 1 && are_in_line(sides.back(), sides.front())) {
      sides.pop_back();
    }
    Contour curve;
    for (const Vec2 point : enclosed(sides)) add(point, curve);
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
