#pragma once
// A leaf as nothing but triangles, in the order that is best to cut.
//
// What a slicer of meshes starts from. Triangles that share an edge stand
// beside each other where that can be had, so that the sectioner finds most
// neighbours without a search.

#include <array>
#include <cstdint>
#include <vector>

#include "csg/scene.h"

namespace lamina::rival {

using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise outside

struct TriangleMesh {
  std::vector<Vec3> vertices;  // in leaf coordinates
  std::vector<Triangle> triangles;
};

// Closed, with the vertices of the leaf's formula.
TriangleMesh make_triangles(const csg::Leaf& leaf);

}  // namespace lamina::rival
