#pragma once
// The surface of a leaf as polygons in the world.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// Each face is plane and has triangles of its own, on the same vertices. All
// triangles together are a closed mesh, counter-clockwise from outside.
struct LeafFaces {
  using Triangle = std::array<std::uint32_t, 3>;

  // One past the last of each; a face begins where the one before ends.
  struct Ends {
    std::uint32_t triangles = 0;
    std::uint32_t loops = 0;
  };

  std::vector<Vec3> vertices;
  std::vector<Ends> faces;
  std::vector<Triangle> triangles;
  // Outer loops counter-clockwise from outside, holes clockwise.
  std::vector<std::uint32_t> loop_ends;  // in corners
  std::vector<std::uint32_t> corners;    // indices of vertices

  Ends begin_of(std::size_t face) const {
    return face == 0 ? Ends{} : faces[face - 1];
  }
  std::span<const Triangle> triangles_of(std::size_t face) const;
  // The loops of a face, as points.
  std::vector<std::vector<Vec3>> contours_of(std::size_t face) const;
  Box3 box_of(std::size_t face) const;
  // As long as the face's area [mm²], out of the leaf.
  Vec3 area_vector_of(std::size_t face) const;
  // Unit length, out of the leaf; 0 where the face has no area.
  Vec3 normal_of(std::size_t face) const;
};

// Sides of lofts are quads and triangles, caps whole polygons with their
// holes; a mesh gives convex polygons.
LeafFaces faces_of(const Leaf& leaf, const Affine& world_from_leaf);

}  // namespace lamina::csg
