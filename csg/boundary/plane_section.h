#pragma once
// Leaves cut by any plane, near a place of interest.
//
// As a rule, not as an exception, a plane goes through vertices and along faces
// of the leaves: boundary faces are found in the planes of faces. So the
// section is taken just above or just below the plane. A vertex within
// kTieDistance lies on the plane and counts to the other side; every edge is
// then crossed or not, and its crossing is one point for both its faces. So
// sections are closed by construction.

#include <cstdint>
#include <optional>
#include <vector>

#include "csg/boundary/box_tree.h"
#include "csg/boundary/leaf_faces.h"
#include "csg/plane/region.h"
#include "csg/scene.h"

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
  // The point of the plane with these coordinates.
  Vec3 lift(Vec2 p) const;
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

  LeafFaces faces;
  BoxTree tree;  // of the faces' boxes
};

// Whether the point is inside. It must not lie in the box of any face.
bool contains(const PlacedLeaf& leaf, Vec3 point);

struct Window {
  Vec2 low;
  Vec2 high;
};

// The box around the part of the plane that the window shows, and
// kTieDistance more.
Box3 box_of(const Plane& plane, const Window& window);

// The leaf's section, as far as the window shows it.
class WindowSection {
 public:
  WindowSection(const PlacedLeaf& leaf, const Plane& plane,
                const Window& window);

  // Faces whose boxes meet the plane where the window is.
  const std::vector<std::uint32_t>& faces() const { return faces_; }

  // Whether a vertex of them lies on the plane; if not, both sides are equal.
  bool is_touched() const { return is_touched_; }

  enum class Side { kBelow, kAbove };

  // Whether all of the window is inside, or nothing of it. No value where the
  // border of the section comes near, and all of it has to be looked at.
  std::optional<bool> uniform_value(Side side) const;

  // Contours that have, at each point of the window, the leaf's winding number.
  // Outside of the window they mean nothing.
  planar::Region contours(Side side) const;

 private:
  const PlacedLeaf& leaf_;
  const Plane& plane_;
  Window window_;
  std::vector<std::uint32_t> faces_;
  bool is_touched_ = false;
};

// The leaf's whole section.
planar::Region whole_section(const PlacedLeaf& leaf, const Plane& plane,
                             WindowSection::Side side);

}  // namespace lamina::csg
