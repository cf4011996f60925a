#pragma once
// Leaves cut by any plane, near a place of interest.
//
// As a rule, not as an exception, a plane goes through vertices and along faces
// of the leaves: boundary faces are found in the planes of faces. So the
// section is taken just above or just below the plane. A vertex within
// kTieDistance lies on the plane and counts to the other side; every edge is
// then crossed or not, and its crossing is one point for both its faces. So
// sections are closed by construction.

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "csg/boundary/leaf_faces.h"
#include "csg/mesh/box_tree.h"
#include "csg/scene.h"
#include "plane/region/region.h"

namespace lamina::csg {

// A plane, with coordinates that are two of space's: the axis nearest to the
// normal is left out. Seen against the normal they are right-handed.
class Plane {
 public:
  // normal  of unit length
  Plane(Vec3 point, Vec3 normal);

  Vec3 normal() const { return normal_; }
  double height(Vec3 p) const;
  Vec2 flatten(Vec3 p) const { return {p[u_], p[v_]}; }
  // Returns the point of the plane with these coordinates.
  Vec3 lift(Vec2 p) const;
  // The area of a part of the plane for one in its coordinates.
  double area_factor() const { return 1 / std::abs(normal_[dropped_]); }
  // Whether the box reaches the plane, or comes near: a vertex that counts as
  // on the plane is in no box that does not.
  bool meets(const Box3& box) const;

 private:
  Vec3 point_;
  Vec3 normal_;
  int u_ = 0;
  int v_ = 1;
  int dropped_ = 2;
};

// A leaf in the world, with its faces to be found by place.
struct PlacedLeaf {
  PlacedLeaf(const Leaf& leaf, const Affine& world_from_leaf);

  // Calls visit(triangle) for the triangles of a face whose boxes `test` holds
  // for, and for some others; `test` as of BoxTree.
  template <typename Test, typename Visit>
  void visit_triangles(std::uint32_t face, const Test& test,
                       const Visit& visit) const;
  // Does the same for all faces.
  template <typename Test, typename Visit>
  void visit_triangles(const Test& test, const Visit& visit) const {
    tree.visit(test,
               [&](std::uint32_t face) { visit_triangles(face, test, visit); });
  }

  LeafFaces faces;
  BoxTree tree;  // of the faces' boxes
  // The cap of a text has thousands of triangles, of which a window shows a
  // few: of the triangles of such faces, by face.
  std::unordered_map<std::uint32_t, BoxTree> triangle_trees;
};

template <typename Test, typename Visit>
void PlacedLeaf::visit_triangles(std::uint32_t face, const Test& test,
                                 const Visit& visit) const {
  const std::span<const LeafFaces::Triangle> all = faces.triangles_of(face);
  const auto found = triangle_trees.find(face);
  if (found == triangle_trees.end()) {
    for (const LeafFaces::Triangle& triangle : all) visit(triangle);
  } else {
    found->second.visit(test, [&](std::uint32_t i) { visit(all[i]); });
  }
}

// Whether the point is inside. It must not lie in the box of any face.
bool contains(const PlacedLeaf& leaf, Vec3 point);

// Returns the box around the part of the plane that the window shows, and
// kTieDistance more.
Box3 box_of(const Plane& plane, const Box2& window);

// A triangle that the plane may cut.
struct CutTriangle {
  LeafFaces::Triangle corners;
  // Heights of the corners above the plane; 0 where one lies on it.
  std::array<double, 3> heights;
};

// The leaf's section, as far as the window shows it.
class WindowSection {
 public:
  WindowSection(const PlacedLeaf& leaf, const Plane& plane, const Box2& window);

  // Faces whose boxes meet the plane where the window is.
  const std::vector<std::uint32_t>& faces() const { return faces_; }

  // Whether a vertex of what the window may show lies on the plane; if not,
  // both sides are equal.
  bool is_touched() const { return is_touched_; }

  enum class Side { kBelow, kAbove };

  // Whether all of the window is inside, or nothing of it. No value where the
  // border of the section comes near, and all of it has to be looked at.
  std::optional<bool> uniform_value(Side side) const;

  // An edge of the section, the inside on its left.
  struct Edge {
    Vec2 begin;
    Vec2 end;
  };
  // Edges that come near the window.
  std::vector<Edge> edges(Side side) const;
  // The leaf's winding number at the lowest corner of the window.
  int corner_winding(Side side) const;

  // Contours that have, at each point of the window, the leaf's winding
  // number. Outside of the window they mean nothing.
  plane::Region contours(Side side) const;

 private:
  const PlacedLeaf& leaf_;
  const Plane& plane_;
  Box2 window_;
  std::vector<std::uint32_t> faces_;
  std::vector<CutTriangle> triangles_;  // of these faces, near the window
  bool is_touched_ = false;
};

// Returns the leaf's whole section.
plane::Region whole_section(const PlacedLeaf& leaf, const Plane& plane,
                            WindowSection::Side side);

}  // namespace lamina::csg
