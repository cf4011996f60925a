#pragma once
// Minkowski sums of solids, as unions of convex parts and moved bodies.
//
// No solid is taken apart into convex pieces beyond those that its leaves show
// (convex_leaf.h). For A with boundary faces F and a compact connected B with
// any point b of B,
//
//     A ⊕ B = (A + b) ∪ ⋃ (F ⊕ B),
//
// since a translate of −B that meets A either lies inside A or meets its
// boundary. A + b is A's part of the scene moved, with its Boolean program; of
// A only the faces are needed, in any number and order. Where B is convex F ⊕
// B is convex too: one merge of normals (convex.h).
//
// Where B is not convex either, the same holds for F ⊕ B with the roles
// exchanged: it is (B + f) ∪ ⋃ (F ⊕ G) over the faces G of B. One f suffices
// for each connected component of A's boundary, and one b for each of B's,
// which also serves a B of several components. Without the former, a small A
// that fits into a hollow B would leave a cavity; without the latter, a small B
// in A.
//
// Sums distribute over unions, so operands are unions of parts: what is convex
// stays whole, and only what is not is treated by its faces.

#include <memory>
#include <vector>

#include "csg/minkowski/convex.h"
#include "csg/scene.h"

namespace lamina::csg {

// A solid that is not convex: a scene moved.
struct Body {
  std::shared_ptr<const Scene> scene;
  // Convex polygons that cover the boundary; they may lie inside as well.
  std::shared_ptr<const std::vector<Convex>> faces;
  Vec3 shift = Vec3(0);
};

// The union of its parts.
struct Operand {
  std::vector<Convex> convex;
  std::vector<Body> bodies;

  bool is_empty() const { return convex.empty() && bodies.empty(); }
};

// The solid of a scene.
Operand make_operand(const Scene& scene);

// The sum of all of them, convex ones first. At least one.
Operand add_operands(std::vector<Operand> operands);

// The convex parts as one leaf: their surfaces together, overlapping. Flat
// parts have no volume and are left out.
Leaf make_leaf(std::span<const Convex> parts);

}  // namespace lamina::csg
