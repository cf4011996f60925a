#include "csg/minkowski/shell.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/minkowski/convex.h"
#include "csg/minkowski/detail/surfaces.h"
#include "csg/minkowski/minkowski.h"

namespace lamina::csg {
namespace {

// Into which the edges of an octahedron are parted.
constexpr int kParts = 6;

// The corner of three planes that touch the unit ball at these points.
Vec3 corner_of(Vec3 a, Vec3 b, Vec3 c) {
  return glm::inverse(glm::transpose(glm::dmat3(a, b, c))) * Vec3(1);
}

double step(int i) { return std::sin(std::numbers::pi / 2 * i / kParts); }

// A polyhedron around the unit ball. Its facets touch the ball at the points of
// a grid on an octahedron, seen from the middle: so on all axes. Steps by sines
// make the facets about equally large.
std::vector<Vec3> ball_corners() {
  std::vector<Vec3> corners;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 sign((octant & 1) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1,
                    (octant & 4) != 0 ? -1 : 1);
    const auto touch = [&](int i, int j) {
      return glm::normalize(sign *
                            Vec3(step(i), step(j), step(kParts - i - j)));
    };
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; i + j < kParts; ++j) {
        corners.push_back(
            corner_of(touch(i, j), touch(i + 1, j), touch(i, j + 1)));
        if (i + j + 2 > kParts) continue;
        corners.push_back(
            corner_of(touch(i + 1, j + 1), touch(i + 1, j), touch(i, j + 1)));
      }
    }
  }
  return corners;
}

Convex make_ball(double radius) {
  std::vector<Vec3> corners = ball_corners();
  for (Vec3& corner : corners) corner *= radius;
  Convex ball = detail::hull_of(corners);
  find_edges(ball);
  return ball;
}

}  // namespace

Leaf make_shell(const Scene& solid, double radius) {
  const Convex ball = make_ball(radius);
  const auto surface = std::make_shared<const JoinedFaces>(
      detail::join(triangulate(boundary_faces(solid))));
  Operand shell;
  // Where the ball holds a whole component of the surface, the two do not meet.
  for (const Vec3& point : points_of_components(*surface, solid.box.center())) {
    shell.convex.push_back(move(ball, point));
  }
  shell.pairs.push_back(
      {surface, std::make_shared<const JoinedFaces>(ball), Vec3(0)});
  Leaf leaf = make_leaf(shell);
  leaf.box = bound_leaf(leaf, Affine(1.0));
  return leaf;
}

}  // namespace lamina::csg
