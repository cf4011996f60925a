#include "csg/plane/offset.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <clipper.hpp>

#include "base/memory_end.h"
#include "csg/limits.h"
#include "csg/plane/boolean.h"

namespace lamina::planar {
namespace {

constexpr double kGridPerMm = 1e8;

// Clipper multiplies coordinates in 128 bits; it asks for no more than 2^62
// grid units.
static_assert(csg::kGreatestCoordinate * kGridPerMm < 0x1p62);

// Two grid diagonals: closer to the line between its neighbours, or to one of
// them, a vertex is the clipper's rounding, not the design's.
constexpr double kCleanDistance = 1.415;

// OpenSCAD's limit for spikes at sharp corners of delta offsets [amounts].
constexpr double kMiterLimit = 1000000;

// Its limit for those of strokes [half widths].
constexpr double kStrokeMiterLimit = 2;

ClipperLib::cInt to_grid(double x) {
  if (csg::is_too_far(x)) csg::fail_too_far();
  return std::llround(x * kGridPerMm);
}

ClipperLib::Path to_path(const Contour& contour) {
  ClipperLib::Path path;
  path.reserve(contour.size());
  for (const Vec2 point : contour) {
    path.push_back({to_grid(point.x), to_grid(point.y)});
  }
  return path;
}

ClipperLib::Paths to_paths(std::span<const Contour> contours) {
  ClipperLib::Paths paths;
  for (const Contour& contour : contours) paths.push_back(to_path(contour));
  return paths;
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

}  // namespace

Region offset(const Region& region, double amount, Join join,
              double arc_tolerance) {
  ClipperLib::ClipperOffset offsetter(kMiterLimit, arc_tolerance * kGridPerMm);
  offsetter.AddPaths(to_paths(region.contours), to_join_type(join),
                     ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  try {
    watch_memory([&, distance = static_cast<double>(to_grid(amount))] {
      offsetter.Execute(result, distance);
    });
  } catch (const ClipperLib::clipperException&) {
    // A sharp corner's spike went too far.
    csg::fail_too_far();
  }
  return to_region(std::move(result));
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
