#include <algorithm>
#include <cmath>
#include <vector>

#include "csg/degrees.h"
#include "csg/facets.h"
#include "csg/lower/detail/lowerer.h"
#include "csg/text/typesetter.h"
#include "plane/region/boolean.h"
#include "plane/region/minkowski.h"
#include "plane/region/offset.h"

namespace lamina::csg {
namespace {

using plane::Contour;

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

plane::Join join_of(const Offset& offset) {
  if (!offset.is_delta) return plane::Join::kRound;
  return offset.chamfer ? plane::Join::kBevel : plane::Join::kMiter;
}

}  // namespace

Shape Lowerer::lower_op(const Square& square, const Place&) {
  return {Dimension::kFlat, csg::square(square.size, square.center)};
}

Shape Lowerer::lower_op(const Circle& circle, const Place& at) {
  const int n = circle_fragments(circle.r, fineness(circle.facets, at.world));
  return {Dimension::kFlat, csg::circle(circle.r, n)};
}

Shape Lowerer::lower_op(const Polygon& polygon, const Place& at) {
  const PolygonParams& params = *polygon.params;
  if (!check_points(params.wrong_point, "vec2", at.node.range, diagnostics_)) {
    return {Dimension::kFlat};
  }
  auto contours = read_paths(params, at.node.range, diagnostics_);
  check_contours(contours, at.node.range, diagnostics_);
  return {Dimension::kFlat, plane::from_contours(contours)};
}

Shape Lowerer::lower_op(const Offset& op, const Place& at) {
  // Round corners add to what the outline has of the chordal error.
  constexpr double kShare = 0.5;
  const Shape shape = flatten_finely(at, op.is_delta ? 1 : 1 - kShare);
  if (shape.dimension == Dimension::kNone) return {};
  const double distance = std::abs(op.amount);
  Fineness corners = fineness(op.facets, at.world);
  corners.chordal_error *= kShare;
  const int n = circle_fragments(distance, corners);
  const double arc_tolerance = distance * (1 - cos_deg(180.0 / n));
  const auto steps =
      options_.language == Language::k2021 && !corners.is_by_error()
          ? plane::ArcSteps::kNearest
          : plane::ArcSteps::kUp;
  return {Dimension::kFlat, plane::offset(shape.region, op.amount, join_of(op),
                                          arc_tolerance, steps)};
}

Shape Lowerer::lower_op(const Fill&, const Place& at) {
  Shape shape = lower_children({at.node, at.world}, plane::BooleanOp::kUnion);
  shape.region = plane::fill(shape.region);
  if (shape.dimension != Dimension::kSolid) return shape;
  for (const Node* child : at.node.children) {
    if (child->is_background) continue;
    diagnostics_.warning(child->range, "fill() not yet implemented for 3D");
  }
  return shape;
}

Shape Lowerer::lower_op(const Text& text, const Place& at) {
  if (!options_.typesetter) fail_unsupported(at.node, "text");
  const TextParams& params = *text.params;
  const Fineness fine = fineness(params.facets, at.world);
  const text::Chords chords = {
      csg::curve_segment_count(params.size, params.facets, options_.language),
      fine.is_by_error() ? fine.chordal_error : 0};
  const auto contours =
      options_.typesetter->outline(params, chords, at.node.range, diagnostics_);
  return {Dimension::kFlat,
          plane::from_contours(contours, plane::FillRule::kNonZero)};
}

Shape Lowerer::flatten_children(const Place& at) {
  Operands operands =
      lower_operands(at, plane::BooleanOp::kUnion, Dimension::kFlat);
  operands.first_mixed = nullptr;
  report_strays(operands);
  if (operands.regions.empty()) {
    return {operands.count > 1 ? Dimension::kFlat : Dimension::kNone};
  }
  return {Dimension::kFlat, plane::unite(operands.regions)};
}

plane::Region transform_region(plane::Region region, const Mat4& m,
                               SourceRange range, Diagnostics& diagnostics) {
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
