#pragma once
// Meshes as files have them.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// One body. Nothing is repaired yet and equal vertices need not be one, but
// every index names a vertex. Faces are counter-clockwise from outside, if the
// file keeps to that.
struct RawMesh {
  Mesh mesh;
  std::vector<std::vector<std::uint32_t>> polygons;  // faces of 4 corners up
  // No two vertices are equal, and each is a corner of a triangle.
  bool is_joined = false;
  // Whether the mesh only stands in for the slices that a 3MF has of its part.
  bool is_stand_in = false;

  // Appends a face; one of less than three corners is left out.
  void add_face(std::span<const std::uint32_t> corners) {
    if (corners.size() == 3) {
      mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (corners.size() > 3) {
      polygons.emplace_back(corners.begin(), corners.end());
    }
  }
};

}  // namespace lamina::csg
