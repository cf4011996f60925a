#pragma once
// Scenes written by hand, for tests of the stages below the evaluator.

#include <cstdint>
#include <vector>

#include "csg/scene.h"

namespace lamina::testing {

// --- Leaves -----------------------------------------------------------------
// Vertices on a circle of radius 1, the first one at angle 0.
std::vector<Vec2> regular_polygon(int count);
csg::Leaf cube_leaf(const Vec3& size);  // one corner at the origin
csg::Leaf cylinder_leaf(double r1, double r2, double height, int facets);
csg::Leaf sphere_leaf(double radius, int facets);  // rings as OpenSCAD's
csg::Leaf torus_leaf(double radius, double tube_radius, int around, int facets);
csg::Leaf extrusion_leaf(std::vector<Vec2> outline, double height);
// The same surface as triangles.
csg::Leaf as_mesh(const csg::Leaf& leaf);

// --- Placement --------------------------------------------------------------
Affine translated(const Vec3& by);
Affine rotated(double angle_deg, const Vec3& axis);
Affine scaled(const Vec3& by);
Affine operator*(const Affine& a, const Affine& b);  // b first

// --- Programs ---------------------------------------------------------------
// Builds a program from outside in:
//   SceneBuilder b(kDifference); b.add(cube); b.begin(kUnion); … b.end();
class SceneBuilder {
 public:
  explicit SceneBuilder(plane::BooleanOp root = plane::BooleanOp::kUnion);

  void begin(plane::BooleanOp op);
  void end();
  void add(csg::Leaf leaf, const Affine& world_from_leaf = Affine(1.0));
  void add_instance(std::uint32_t leaf, const Affine& world_from_leaf);

  // The scene with boxes computed; the builder is spent.
  csg::Scene finish();

 private:
  csg::Scene scene_;
  std::vector<std::uint32_t> open_;  // operators, outermost first
};

}  // namespace lamina::testing
