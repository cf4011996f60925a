#include "csg/lower/detail/resize.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "csg/boundary/boundary_faces.h"

namespace lamina::csg {
namespace {

bool only_unites(const Scene& scene) {
  return scene.program.size() == 1 && scene.program[0].op == BooleanOp::kUnion;
}

// The box of the solid itself, however its leaves are combined.
Box3 box_of_result(const Scene& scene) {
  if (only_unites(scene)) return scene.box;
  Box3 box;
  const auto reaches_out = [&](const Box3& part) {
    return glm::any(glm::lessThan(part.low, box.low)) ||
           glm::any(glm::greaterThan(part.high, box.high));
  };
  visit_boundary_faces(scene, reaches_out, [&](const BoundaryFace& face) {
    const Box3 part = box_of(face);
    box.low = glm::min(box.low, part.low);
    box.high = glm::max(box.high, part.high);
  });
  return box;
}

// size  of what is resized
template <int kDimensions>
glm::vec<kDimensions, double> factor_for(
    const Resize& op, const glm::vec<kDimensions, double>& size,
    bool may_mirror) {
  int greatest = 0;
  for (int i = 1; i < kDimensions; ++i) {
    if (op.new_size[i] > op.new_size[greatest]) greatest = i;
  }
  const auto is_given = [&](int i) {
    return may_mirror ? op.new_size[i] != 0 : op.new_size[i] > 0;
  };
  glm::vec<kDimensions, double> factor(1.0);
  for (int i = 0; i < kDimensions; ++i) {
    const bool follows =
        op.auto_size[static_cast<std::size_t>(i)] && !is_given(i);
    const int axis = follows ? greatest : i;
    if (is_given(axis) && size[axis] > 0) {
      factor[i] = op.new_size[axis] / size[axis];
    }
  }
  return factor;
}

}  // namespace

Vec2 resize_factor(const Resize& op, const planar::Region& region) {
  Vec2 low(1e300);
  Vec2 high(-1e300);
  for (const planar::Contour& contour : region.contours) {
    for (const Vec2 point : contour) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  return factor_for<2>(op, high - low, false);
}

Vec3 resize_factor(const Resize& op, const Scene& scene, bool is_boolean) {
  const Box3 box = box_of_result(scene);
  if (box.is_empty()) return Vec3(1);
  return factor_for<3>(op, box.high - box.low, is_boolean);
}

}  // namespace lamina::csg
