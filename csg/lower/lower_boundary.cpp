#include <utility>
#include <vector>

#include "csg/boundary/projection.h"
#include "csg/boundary/scene_hull.h"
#include "csg/lower/detail/lowerer.h"
#include "csg/lower/detail/resize.h"
#include "csg/plane/clip.h"
#include "csg/plane/convex_hull.h"

namespace lamina::csg {
namespace {

planar::Region hull_of(const std::vector<planar::Region>& regions) {
  std::vector<Vec2> points;
  for (const planar::Region& region : regions) {
    for (const planar::Contour& contour : region.contours) {
      points.insert(points.end(), contour.begin(), contour.end());
    }
  }
  return planar::convex_hull(std::move(points));
}

Mat4 scaling(Vec3 factor) {
  Mat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i][i] = factor[i];
  return m;
}

}  // namespace

Lowerer Lowerer::make_inner(const Node& node, const Affine& world) {
  LowerOptions options = options_;
  options.chordal_error = fineness({}, world).chordal_error;
  return {node.children.size(), options, diagnostics_};
}

Lowerer::Apart Lowerer::lower_apart(const Node& node, const Affine& world,
                                    bool takes_corners) {
  Lowerer inner = make_inner(node, world);
  inner.takes_corners_ = takes_corners;
  Operands operands =
      inner.lower_operands(node, Affine(1.0), true, Dimension::kNone);
  report_strays(operands);
  return {operands.dimension, std::move(operands.regions), inner.take_scene(),
          is_boolean(BooleanOp::kUnion, operands)};
}

Shape Lowerer::lower_op(const Hull&, const Node& node, const Affine& world) {
  Apart apart = lower_apart(node, world, true);
  if (apart.dimension == Dimension::kFlat) {
    return {Dimension::kFlat, hull_of(apart.regions)};
  }
  if (apart.scene.instances.empty()) return {};
  Leaf leaf;
  leaf.meshes.push_back(convex_hull(std::move(apart.scene)));
  place_leaf(std::move(leaf), node, world);
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const Resize& op, const Node& node,
                        const Affine& world) {
  Apart apart = lower_apart(node, world);
  if (apart.dimension == Dimension::kFlat) {
    if (apart.regions.empty()) return {Dimension::kFlat};
    planar::Region region = planar::unite(apart.regions);
    const Vec3 factor(resize_factor(op, region), 1);
    return {Dimension::kFlat,
            transform_region(std::move(region), scaling(factor), node.range,
                             diagnostics_)};
  }
  if (apart.scene.instances.empty()) return {apart.dimension};
  const Vec3 factor = resize_factor(op, apart.scene, apart.is_boolean);
  place_scene(apart.scene, world * scaling(factor));
  return {Dimension::kSolid, {}, apart.is_boolean};
}

Shape Lowerer::lower_op(const Projection& op, const Node& node,
                        const Affine& world) {
  Lowerer inner = make_inner(node, world);
  Operands operands =
      inner.lower_operands(node, Affine(1.0), true, Dimension::kSolid);
  operands.first_mixed = nullptr;
  if (op.cut) report_strays(operands);
  const Scene scene = inner.take_scene();
  if (scene.instances.empty()) return {};
  planar::Region region = op.cut ? cut_at_zero(scene) : project(scene);
  if (!region.is_empty()) return {Dimension::kFlat, std::move(region)};
  if (op.cut && misses_zero(scene)) {
    diagnostics_.warning({}, "Projection() failed.");
  }
  return {};
}

}  // namespace lamina::csg
