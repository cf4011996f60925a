#include "csg/mesh/edge_table.h"

#include <tuple>

namespace lamina::csg {

EdgeTable EdgeTable::of(const Mesh& mesh) {
  return make(mesh.vertices.size(), [&mesh](auto visit) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& t = mesh.triangles[i];
      visit(i, t[0], t[1]);
      visit(i, t[1], t[2]);
      visit(i, t[2], t[0]);
    }
  });
}

void EdgeTable::sort_by_edge() {
  for (std::size_t low = 0; low + 1 < firsts_.size(); ++low) {
    std::sort(sides_.begin() + firsts_[low], sides_.begin() + firsts_[low + 1],
              [](const Side& a, const Side& b) {
                return std::tie(a.high, a.code) < std::tie(b.high, b.code);
              });
  }
}

bool EdgeTable::is_open() const {
  bool is_any_odd = false;
  for_each_edge([&](std::uint32_t, std::span<const Side> sides) {
    is_any_odd = is_any_odd || sides.size() % 2 == 1;
  });
  return is_any_odd;
}

}  // namespace lamina::csg
