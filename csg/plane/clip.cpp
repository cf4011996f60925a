#include "csg/plane/clip.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <clipper.hpp>

#include "base/check.h"
#include "base/memory_end.h"
#include "csg/limits.h"
#include "csg/plane/link_edges.h"

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

// In grid units, as the corners of a path are whole numbers of them.
std::vector<Contour> to_contours(const ClipperLib::Paths& paths) {
  std::vector<Contour> contours;
  for (const ClipperLib::Path& path : paths) {
    Contour& contour = contours.emplace_back();
    contour.reserve(path.size());
    for (const ClipperLib::IntPoint& point : path) {
      contour.emplace_back(point.X, point.Y);
    }
  }
  return contours;
}

Region to_region(const ClipperLib::Paths& paths) {
  Region region;
  for (const Contour& loop : link_edges(to_contours(paths), kCleanDistance)) {
    ClipperLib::Path path;
    path.reserve(loop.size());
    for (const Vec2 point : loop)
      path.emplace_back(std::llround(point.x), std::llround(point.y));
    ClipperLib::CleanPolygon(path, kCleanDistance);
    if (path.size() < 3) continue;
    Contour& contour = region.contours.emplace_back();
    contour.reserve(path.size());
    for (const ClipperLib::IntPoint& point : path) {
      contour.push_back({static_cast<double>(point.X) / kGridPerMm,
                         static_cast<double>(point.Y) / kGridPerMm});
    }
  }
  return region;
}

ClipperLib::Paths clip(ClipperLib::ClipType type,
                       const ClipperLib::Paths& subject,
                       const ClipperLib::Paths& other,
                       ClipperLib::PolyFillType fill) {
  // Keep points on straight edges: there contours may touch.
  ClipperLib::Clipper clipper;
  clipper.PreserveCollinear(true);
  const bool has_subject =
      clipper.AddPaths(subject, ClipperLib::ptSubject, true);
  const bool has_other = clipper.AddPaths(other, ClipperLib::ptClip, true);
  ClipperLib::Paths result;
  if (!has_subject && !has_other) return result;
  bool is_clipped = false;
  watch_memory([&] { is_clipped = clipper.Execute(type, result, fill, fill); });
  // It fails where it finds no order of crossings in which only neighbours
  // cross.
  LAMINA_CHECK_EQ(is_clipped, true);
  return result;
}

ClipperLib::Paths gather(std::span<const Region> regions) {
  ClipperLib::Paths all;
  for (const Region& region : regions) {
    for (const Contour& contour : region.contours) {
      all.push_back(to_path(contour));
    }
  }
  return all;
}

ClipperLib::JoinType to_join_type(Join join) {
  switch (join) {
    case Join::kRound:
      return ClipperLib::jtRound;
    case Join::kMiter:
      return ClipperLib::jtMiter;
    case Join::kBevel:
      return ClipperLib::jtSquare;
  }
  return ClipperLib::jtRound;
}

ClipperLib::EndType to_end_type(Cap cap) {
  switch (cap) {
    case Cap::kButt:
      return ClipperLib::etOpenButt;
    case Cap::kRound:
      return ClipperLib::etOpenRound;
    case Cap::kSquare:
      return ClipperLib::etOpenSquare;
  }
  return ClipperLib::etOpenSquare;
}

}  // namespace

Region unite(std::span<const Region> regions) {
  if (regions.size() == 1) return regions[0];
  return to_region(
      clip(ClipperLib::ctUnion, gather(regions), {}, ClipperLib::pftNonZero));
}

Region subtract(std::span<const Region> regions) {
  if (regions.size() <= 1) return unite(regions);
  return to_region(clip(ClipperLib::ctDifference, gather(regions.first(1)),
                        gather(regions.subspan(1)), ClipperLib::pftNonZero));
}

Region intersect(std::span<const Region> regions) {
  if (regions.size() <= 1) return unite(regions);
  ClipperLib::Paths common = gather(regions.first(1));
  for (std::size_t i = 1; i < regions.size(); ++i) {
    common = clip(ClipperLib::ctIntersection, common,
                  gather(regions.subspan(i, 1)), ClipperLib::pftNonZero);
  }
  return to_region(common);
}

Region from_contours(std::span<const Contour> contours, FillRule rule) {
  return to_region(clip(ClipperLib::ctUnion, to_paths(contours), {},
                        rule == FillRule::kEvenOdd ? ClipperLib::pftEvenOdd
                                                   : ClipperLib::pftNonZero));
}

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
  return to_region(result);
}

Region stroke(std::span<const Vec2> path, double width, Join join, Cap cap,
              double arc_tolerance) {
  ClipperLib::ClipperOffset offsetter(kStrokeMiterLimit,
                                      arc_tolerance * kGridPerMm);
  offsetter.AddPath(to_path(Contour(path.begin(), path.end())),
                    to_join_type(join), to_end_type(cap));
  ClipperLib::Paths result;
  watch_memory([&, distance = static_cast<double>(to_grid(width / 2))] {
    offsetter.Execute(result, distance);
  });
  return to_region(result);
}

}  // namespace lamina::planar
