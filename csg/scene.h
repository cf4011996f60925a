#pragma once
// The scene: what the sampler sees. Closed leaves, instances of them placed in
// the world, and a flat Boolean program over the instances.
//
// Transforms are pushed down to the instances, unions of unions are one
// union, empty parts are gone. Primitives stay parametric: a Loft gives its
// vertices by formula, so a sphere of a million facets costs two small tables.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/source.h"
#include "base/vec.h"
#include "csg/tree.h"
#include "plane/program/boolean_program.h"

namespace lamina::csg {

// A closed polygon (u, v) repeated along a profile of (scale, height) pairs:
//   vertex(i, j) = (scale_i · u_j, scale_i · v_j, height_i)
// i < profile.size() rings, j < outline->size() points a ring. Sides are
// quads between neighbouring rings, planar because the edges of two rings run
// parallel. Cylinder, cone, sphere, cube, straight or scaled linear_extrude,
// and every full rotate_extrude are Lofts.
//
// Orientation: the outline runs counter-clockwise and the profile has the
// solid on its left in the (scale, height) plane: a bottom ring stands before
// the top ring, a torus' profile runs counter-clockwise. The side quad
// (i,j) (i,j+1) (i+1,j+1) (i+1,j) is then counter-clockwise from outside.
// The outline is a simple polygon, convex or not; where it is not convex the
// section of a cap can be several segments.
struct Loft {
  std::shared_ptr<const std::vector<Vec2>> outline;  // shared tables per $fn
  std::vector<Vec2> profile;  // x: scale ≥ 0, y: height
  // true: the last ring is joined to the first (a torus), no caps.
  // false: the first and the last ring are closed by one polygon each; a ring
  // of scale 0 is an apex. Only first and last ring of an open profile, and no
  // ring of a closed one, may have scale 0.
  bool is_closed_profile = false;
  bool is_cavity = false;  // see Leaf
};

// A flat indexed triangle mesh, closed: every directed edge is matched by as
// many of the opposite direction. Orientation: counter-clockwise from outside.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool operator==(const Mesh&) const = default;
};

// A closed solid in its own coordinates. Its surface is all its lofts and
// meshes together. Every loft bounds a solid of its own; a point is inside
// the leaf where the sum of winding numbers is not 0: +1 inside a loft, -1
// inside a loft that is a cavity (a hole of an extruded region). A cavity is
// stored with the same orientation as any loft. Its caps lie in the caps of
// the loft around it: there two crossings coincide and cancel.
struct Leaf {
  std::vector<Loft> lofts;
  std::vector<Mesh> meshes;
  Box3 box;  // of all vertices, in leaf coordinates
  // false: surface known to be embedded, so that each crossing toggles
  // inside/outside; true: may overlap itself, winding must be counted.
  bool may_overlap_itself = false;
  // true: known to be convex but for rounding, as hulls are and sums of what is
  // convex; false says nothing.
  bool is_convex = false;
};

// Of an instance that no color() of the design is above.
inline constexpr std::int32_t kNoColor = -1;

// A leaf put into the world. Where the linear part of world_from_leaf has a
// negative determinant (mirror) the map turns surfaces inside out: who needs
// orientation negates windings there.
struct Instance {
  std::uint32_t leaf = 0;    // index into Scene::leaves
  std::uint32_t parent = 0;  // index into Scene::program
  bool is_minuend = false;   // first operand of a difference
  // No volume, but seen by hulls, sums and shadows. Only in scenes lowered for
  // these, as a child of a root that is a union.
  bool is_flat = false;
  bool is_visible = false;  // seen when the part is worn, as of the node
  Affine world_from_leaf{1.0};
  Box3 box;           // in the world, of the transformed vertices
  SourceRange range;  // of the module call that made the leaf
  const CallSite* caller = nullptr;
  float support_tip = kNoSupportTip;  // as of the node, times the scale
  std::int32_t color = kNoColor;      // of the outermost color(): 0xRRGGBB
};

struct Scene {
  std::vector<Leaf> leaves;
  std::vector<Instance> instances;
  std::vector<plane::BooleanNode> program;  // never empty: a union of nothing
  // Boolean-aware bounds of the result: union = all, difference = that of the
  // first operand, intersection = the overlap. Of vertices, not of boxes of
  // boxes, as long as no intersection is involved. Empty for an empty scene.
  Box3 box;
};

// Scene::box, from the boxes of the instances.
Box3 bounds_of(const Scene& scene);

// The scene's program and, of its instances, what the program asks. The boxes
// are those of the instances, as seen from above.
plane::BooleanProgram program_of(const Scene& scene);

}  // namespace lamina::csg
