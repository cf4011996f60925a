#pragma once
// The boundary of a Boolean, face by face.
//
// Hulls, Minkowski sums, resize() and projection() need the explicit boundary
// of a subtree. No mesh of the whole is built: each face of each leaf is
// classified alone. Most faces lie wholly inside or wholly outside of each
// other leaf, and boxes show that for many at once. What is left is a plane
// problem: the leaves that meet the face are cut by its plane, the Boolean is
// evaluated in that plane just inside and just outside of the face, and the
// part of the face that separates the two is boundary.
// Source: set membership classification, Tilove 1980.

#include <functional>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// A plane polygon in space, with holes.
struct BoundaryFace {
  Vec3 normal;  // unit length, out of the solid
  // First points are not repeated. Seen from outside, outer contours run
  // counter-clockwise and holes clockwise; there may be several outer ones.
  std::vector<std::vector<Vec3>> contours;
};

Box3 box_of(const BoundaryFace& face);

// Returns faces that together cover the boundary once, up to kTieDistance; they
// are not joined: neighbours may have vertices on each other's edges, and an
// edge's two sides may differ by what regions take for one edge (3e-8 mm). A
// face that the Boolean does not touch keeps the leaf's vertices, bit by bit.
// Coplanar neighbours are not merged. Cost: about n log n of the faces, plus
// the plane problems.
std::vector<BoundaryFace> boundary_faces(const Scene& scene);

// Visits the faces one by one, where not all of them are needed. Leaves come
// from the outermost to the innermost.
//
// is_wanted  false where no face within the box is; asked often, and may change
//            its mind from true to false as faces are taken
// take       is called with each face that is wanted, and some others
void visit_boundary_faces(const Scene& scene,
                          const std::function<bool(const Box3&)>& is_wanted,
                          const std::function<void(BoundaryFace)>& take);

}  // namespace lamina::csg
