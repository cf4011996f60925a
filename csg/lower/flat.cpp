#include "csg/lower/detail/flat.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "csg/degrees.h"
#include "csg/lower/detail/points.h"
#include "csg/plane/clip.h"
#include "csg/plane/facets.h"
#include "csg/plane/minkowski.h"

namespace lamina::csg {
namespace {

using planar::Contour;
using planar::Region;

std::vector<Contour> read_paths(const PolygonParams& polygon, SourceRange range,
                                Diagnostics& diagnostics) {
  const auto points = polygon.points;
  if (!polygon.paths || polygon.paths->empty()) {
    return {Contour(points.begin(), points.end())};
  }
  std::vector<Contour> contours;
  for (std::size_t path = 0; path < polygon.paths->size(); ++path) {
    contours.emplace_back();
    const auto& indices = (*polygon.paths)[path];
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] < points.size()) {
        contours.back().push_back(points[indices[i]]);
      } else {
        warn_of_index(indices[i], "paths", path, i, range, diagnostics);
      }
    }
  }
  return contours;
}

// Drops contours from the first one on that holds no numbers, as OpenSCAD does.
void check_contours(std::vector<Contour>& contours, SourceRange range,
                    Diagnostics& diagnostics) {
  const auto is_wrong = [](const Contour& contour) {
    return std::any_of(contour.begin(), contour.end(), [](Vec2 point) {
      return std::isnan(point.x) || std::isnan(point.y);
    });
  };
  const auto wrong = std::find_if(contours.begin(), contours.end(), is_wrong);
  if (wrong == contours.end()) return;
  diagnostics.warning(range, "Range check failed for polygon. skipping");
  contours.erase(wrong, contours.end());
}

planar::Join join_of(const Offset& offset) {
  if (!offset.is_delta) return planar::Join::kRound;
  return offset.chamfer ? planar::Join::kBevel : planar::Join::kMiter;
}

}  // namespace

Region make_polygon(const PolygonParams& polygon, SourceRange range,
                    Diagnostics& diagnostics) {
  if (!check_points(polygon.wrong_point, "vec2", range, diagnostics)) return {};
  auto contours = read_paths(polygon, range, diagnostics);
  check_contours(contours, range, diagnostics);
  return planar::from_contours(contours);
}

Region make_text(const TextParams& params, const Fineness& fineness,
                 text::Typesetter& typesetter, SourceRange range,
                 Diagnostics& diagnostics) {
  const text::Chords chords = {
      planar::curve_segment_count(params.size, params.facets),
      fineness.is_by_error() ? fineness.chordal_error : 0};
  const auto contours = typesetter.outline(params, chords, range, diagnostics);
  return planar::from_contours(contours, planar::FillRule::kNonZero);
}

Region fill_shapes(std::span<const std::vector<Contour>> shapes) {
  std::vector<Region> regions;
  for (const std::vector<Contour>& contours : shapes) {
    regions.push_back(planar::from_contours(contours));
  }
  return regions.empty() ? Region() : planar::unite(regions);
}

Region combine_regions(BooleanOp op, std::span<const Region> regions) {
  switch (op) {
    case BooleanOp::kDifference:
      return planar::subtract(regions);
    case BooleanOp::kIntersection:
      return planar::intersect(regions);
    case BooleanOp::kUnion:
      break;
  }
  return planar::unite(regions);
}

Region add_regions(std::span<const Region> regions) {
  Region sum = regions[0];
  bool has_sum = regions.size() == 1;
  for (const Region& region : regions.subspan(1)) {
    if (region.is_empty()) continue;
    sum = planar::add(sum, region);
    has_sum = true;
  }
  return has_sum ? sum : Region{};
}

Region offset_region(const Offset& offset, const Fineness& fineness,
                     const Region& region) {
  const double distance = std::abs(offset.amount);
  const int n = circle_fragments(distance, fineness);
  const double arc_tolerance = distance * (1 - cos_deg(180.0 / n));
  return planar::offset(region, offset.amount, join_of(offset), arc_tolerance);
}

Region transform_region(Region region, const Mat4& m, SourceRange range,
                        Diagnostics& diagnostics) {
  const double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  if (det == 0) {
    diagnostics.warning(range, "Scaling a 2D object with 0 - removing object");
    return {};
  }
  for (Contour& contour : region.contours) {
    for (Vec2& point : contour) {
      point = {m[0][0] * point.x + m[1][0] * point.y + m[3][0],
               m[0][1] * point.x + m[1][1] * point.y + m[3][1]};
    }
    if (det < 0) std::reverse(contour.begin(), contour.end());
  }
  return region;
}

}  // namespace lamina::csg
