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

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
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

// Asks whether any face within a box is needed. It is asked often, and may
// change its mind from true to false as faces are taken.
using IsWanted = std::function<bool(const Box3&)>;
using TakeFace = std::function<void(BoundaryFace)>;

// Visits the faces one by one, where not all of them are needed. Leaves come
// from the outermost to the innermost.
//
// take  is called with each face that is wanted, and some others
void visit_boundary_faces(const Scene& scene, const IsWanted& is_wanted,
                          const TakeFace& take);

// A face of a leaf of which boxes alone do not say what is boundary.
struct OpenFace {
  std::uint32_t instance = 0;
  std::uint32_t face = 0;  // of its leaf
  Vec3 normal;             // out of the leaf; unit length
  double area = 0;         // of the whole face [mm²]
  Box3 box;                // of the whole face
  // The instances that contain it, and those that decide over it. No other
  // comes near.
  std::vector<std::uint32_t> around;
  std::vector<std::uint32_t> others;
};

// Whether it leans by less than 1e-6 mm on 10 m. Such faces alone make no peak,
// pit, lowest or highest point.
bool is_upright(const OpenFace& face);

// A plane part of the boundary of which the contours do not matter.
struct BoundaryPart {
  Vec3 normal;      // unit length, out of the solid
  double area = 0;  // [mm²]
  Box3 box;
};

// So many scan lines cost less than a plane problem.
inline constexpr std::size_t kManyScanLines = 1000;

// What of a face is boundary: none, one or two parts, which look to one side
// and to the other.
struct MeasuredFace {
  std::vector<BoundaryPart> parts;
  // false: areas are estimates. Thin parts may be left out, and boxes too
  // small.
  bool is_exact = true;
  std::size_t edges = 0;  // that were looked at: the cost
};

// Finds the boundary where plane problems are dear and few of them matter: what
// boxes settle comes at once, and the caller says which plane problems to
// solve, in which order. The scene must outlive it.
class BoundaryFinder {
 public:
  explicit BoundaryFinder(const Scene& scene);
  ~BoundaryFinder();
  BoundaryFinder(const BoundaryFinder&) = delete;
  BoundaryFinder& operator=(const BoundaryFinder&) = delete;

  // Takes the faces of leaves that are boundary as a whole, and returns those
  // that are open, of all that are wanted.
  std::vector<OpenFace> take_settled(const IsWanted& is_wanted,
                                     const TakeFace& take);

  // Solves one plane problem, and takes what of the face is boundary.
  void solve(const OpenFace& face, const TakeFace& take);

  // Measures what of the face is boundary, by scan lines: several times as fast
  // as solve().
  //
  // most_lines  where it would take more, a few give an estimate
  MeasuredFace measure(const OpenFace& face, std::size_t most_lines);

 private:
  friend void visit_boundary_faces(const Scene& scene,
                                   const IsWanted& is_wanted,
                                   const TakeFace& take);

  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace lamina::csg
