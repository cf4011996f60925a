#pragma once
// Faces of any number of corners.

#include <cstdint>
#include <span>

#include "csg/import/raw_mesh.h"

namespace lamina::csg {

// corners  indices of vertices of `raw`; faces of less than three are none
inline void add_face(std::span<const std::uint32_t> corners, RawMesh& raw) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    raw.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  } else {
    raw.polygons.emplace_back(corners.begin(), corners.end());
  }
}

}  // namespace lamina::csg
