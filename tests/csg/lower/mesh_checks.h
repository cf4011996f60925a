#pragma once
// What must hold for every mesh that stands for a leaf.

#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "csg/scene.h"

namespace lamina::csg {

// Every directed edge is matched by as many of the opposite direction.
inline bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      if (a == b) return false;
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) return false;
  }
  return true;
}

}  // namespace lamina::csg
