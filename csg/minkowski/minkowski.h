#pragma once
// Minkowski sums of solids, as unions of convex parts, moved bodies and sums of
// surfaces.
//
// For solids A and B with boundaries S and T,
//
//     A ⊕ B = (A + b) ∪ (B + a) ∪ (S ⊕ T)
//
// with one point b on each component of T and one point a on each of S: where a
// translate of −B meets A, the boundaries meet, or one of the two lies inside
// the other. A + b is A's part of the scene moved, with its Boolean program; of
// A only the faces are needed, and S ⊕ T is made from these
// (surface_sum.h). With fewer points a small A that fits into a hollow B would
// leave a cavity. Where B is convex, any of its points may be b; where it is
// flat, it is its own surface.
//
// Sums distribute over unions, so operands are unions of parts: what is convex
// stays whole, and two convex parts are added by their normals (convex.h).
// Leaves whose form shows convex parts (convex_leaf.h) are added to a convex
// solid part by part where that costs less.

#include <memory>
#include <vector>

#include "csg/minkowski/convex.h"
#include "csg/minkowski/joined_faces.h"
#include "csg/scene.h"

namespace lamina::csg {

// A solid that is not convex: a scene moved.
struct Body {
  std::shared_ptr<const Scene> scene;
  // Convex solids whose union it is, where its form shows them; or none.
  std::shared_ptr<const std::vector<Convex>> parts;
  // Faces that cover the boundary; they may lie inside as well.
  std::shared_ptr<const JoinedFaces> surface;
  Vec3 shift = Vec3(0);
};

// All sums of a point of one surface and a point of the other, moved.
struct SurfacePair {
  std::shared_ptr<const JoinedFaces> a;
  std::shared_ptr<const JoinedFaces> b;
  Vec3 shift = Vec3(0);
};

// The union of its parts.
struct Operand {
  std::vector<Convex> convex;
  std::vector<Body> bodies;
  // Only of sums. Before one is added to something itself, a leaf and a body
  // have to be made of them.
  std::vector<SurfacePair> pairs;

  bool is_empty() const { return convex.empty() && bodies.empty(); }
};

// The solid of a scene.
Operand make_operand(const Scene& scene);

// In the order in which they are added at the least cost: convex ones first,
// then those of few faces.
void sort_for_sum(std::vector<Operand>& operands);

// Operands without pairs.
Operand add_operands(Operand a, Operand b);

// The convex parts and the pairs as one leaf: their surfaces together,
// overlapping. Flat parts have no volume and are left out.
Leaf make_leaf(const Operand& sum);

}  // namespace lamina::csg
