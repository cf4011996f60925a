#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/planar/convex_hull.h"
#include "csg/solid/detail/lowerer.h"
#include "csg/solid/detail/scene_hull.h"

namespace lamina::csg {
namespace {

std::size_t count_operands(const Node& node) {
  return static_cast<std::size_t>(
      std::count_if(node.children.begin(), node.children.end(),
                    [](const Node* child) { return !child->is_background; }));
}

Shape lower_later(const Node& node, std::string_view module) {
  if (count_operands(node) > 0) fail_unsupported(node, module);
  return {};
}

planar::Region hull_of(const std::vector<planar::Region>& regions) {
  std::vector<Vec2> points;
  for (const planar::Region& region : regions) {
    for (const planar::Contour& contour : region.contours) {
      points.insert(points.end(), contour.begin(), contour.end());
    }
  }
  return planar::convex_hull(std::move(points));
}

}  // namespace

Lowerer::Apart Lowerer::lower_apart(const Node& node, const Affine& world) {
  LowerOptions options = options_;
  options.chordal_error = fineness({}, world).chordal_error;
  Lowerer inner(node.children.size(), options, diagnostics_);
  Operands operands =
      inner.lower_operands(node, Affine(1.0), true, Dimension::kNone);
  report_strays(operands);
  return {operands.dimension, std::move(operands.regions), inner.take_scene()};
}

Shape Lowerer::lower_op(const Hull&, const Node& node, const Affine& world) {
  Apart apart = lower_apart(node, world);
  if (apart.dimension == Dimension::kFlat) {
    return {Dimension::kFlat, hull_of(apart.regions)};
  }
  if (apart.scene.instances.empty()) return {};
  Leaf leaf;
  leaf.meshes.push_back(convex_hull(std::move(apart.scene)));
  place_leaf(std::move(leaf), node, world);
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const Resize&, const Node& node, const Affine&) {
  return lower_later(node, "resize");
}

Shape Lowerer::lower_op(const Projection&, const Node& node, const Affine&) {
  return lower_later(node, "projection");
}

}  // namespace lamina::csg
