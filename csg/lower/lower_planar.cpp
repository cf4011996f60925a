#include "csg/lower/detail/flat.h"
#include "csg/lower/detail/lowerer.h"
#include "csg/plane/minkowski.h"

namespace lamina::csg {

Shape Lowerer::lower_op(const Square& square, const Node&, const Affine&) {
  return {Dimension::kFlat, planar::square(square.size, square.center)};
}

Shape Lowerer::lower_op(const Circle& circle, const Node&,
                        const Affine& world) {
  const int n = circle_fragments(circle.r, fineness(circle.facets, world));
  return {Dimension::kFlat, planar::circle(circle.r, n)};
}

Shape Lowerer::lower_op(const Polygon& polygon, const Node& node,
                        const Affine&) {
  return {Dimension::kFlat,
          make_polygon(*polygon.params, node.range, diagnostics_)};
}

Shape Lowerer::lower_op(const Offset& op, const Node& node,
                        const Affine& world) {
  const Shape shape = flatten_children(node, world);
  if (shape.dimension == Dimension::kNone) return {};
  return {Dimension::kFlat,
          offset_region(op, fineness(op.facets, world), shape.region)};
}

Shape Lowerer::lower_op(const Fill&, const Node& node, const Affine& world) {
  Shape shape = lower_children(node, world, BooleanOp::kUnion);
  shape.region = planar::fill(shape.region);
  if (shape.dimension != Dimension::kSolid) return shape;
  for (const Node* child : node.children) {
    if (child->is_background) continue;
    diagnostics_.warning(child->range, "fill() not yet implemented for 3D");
  }
  return shape;
}

Shape Lowerer::lower_op(const Text& text, const Node& node,
                        const Affine& world) {
  if (!options_.typesetter) fail_unsupported(node, "text");
  const TextParams& params = *text.params;
  return {Dimension::kFlat,
          make_text(params, fineness(params.facets, world),
                    *options_.typesetter, node.range, diagnostics_)};
}

Shape Lowerer::flatten_children(const Node& node, const Affine& world) {
  Operands operands = lower_operands(node, world, true, Dimension::kFlat);
  operands.first_mixed = nullptr;
  report_strays(operands);
  if (operands.regions.empty()) {
    return {operands.count > 1 ? Dimension::kFlat : Dimension::kNone};
  }
  return {Dimension::kFlat,
          combine_regions(BooleanOp::kUnion, operands.regions)};
}

}  // namespace lamina::csg
