#include "csg/mesh/drop_triangles.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace lamina::csg {

std::size_t drop_degenerate(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [](const auto& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

std::size_t drop_repeated(Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> turned = mesh.triangles;
  for (auto& t : turned) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::vector<std::uint32_t> order(turned.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(turned[a], a) < std::tie(turned[b], b);
  });
  std::vector<bool> is_repeated(turned.size());
  for (std::size_t i = 1; i < order.size(); ++i) {
    is_repeated[order[i]] = turned[order[i]] == turned[order[i - 1]];
  }
  return std::erase_if(mesh.triangles, [&, i = 0u](const auto&) mutable {
    return is_repeated[i++];
  });
}

}  // namespace lamina::csg
