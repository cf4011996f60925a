#include "csg/lower/detail/resize.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "csg/boundary/boundary_faces.h"

namespace lamina::csg {
namespace {

// new size / size where there is a new size, else 1.
double factor_of(double new_size, double size, bool may_mirror) {
  const bool is_given = may_mirror ? new_size != 0 : new_size > 0;
  return is_given && size > 0 ? new_size / size : 1;
}

bool only_unites(const Scene& scene) {
  return scene.program.size() == 1 && scene.program[0].op == BooleanOp::kUnion;
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
  const bool is_y = op.new_size.y != 0 && op.new_size.y > op.new_size.x;
  const int greatest = is_y ? 1 : 0;
  Vec2 factor;
  for (int i = 0; i < 2; ++i) {
    const bool follows =
        op.auto_size[static_cast<std::size_t>(i)] && !(op.new_size[i] > 0);
    const int axis = follows ? greatest : i;
    factor[i] = factor_of(op.new_size[axis], high[axis] - low[axis], false);
  }
  return factor;
}

Vec3 resize_factor(const Resize& op, const Scene& scene, bool is_boolean) {
  const Box3 box = box_of_result(scene);
  if (box.is_empty()) return Vec3(1);
  int greatest = 0;
  for (int i = 1; i < 3; ++i) {
    if (op.new_size[i] > op.new_size[greatest]) greatest = i;
  }
  Vec3 factor;
  for (int i = 0; i < 3; ++i) {
    const bool is_given = is_boolean ? op.new_size[i] != 0 : op.new_size[i] > 0;
    const bool follows = op.auto_size[static_cast<std::size_t>(i)] && !is_given;
    const int axis = follows ? greatest : i;
    factor[i] = factor_of(op.new_size[axis], box.high[axis] - box.low[axis],
                          is_boolean);
  }
  return factor;
}

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

}  // namespace lamina::csg
