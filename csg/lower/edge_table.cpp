#include "csg/lower/detail/edge_table.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace lamina::csg {
namespace {

// Calls visit(triangle, from, to) for each side of each triangle.
template <typename Visit>
void for_each_side(const Mesh& mesh, Visit visit) {
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    visit(i, t[0], t[1]);
    visit(i, t[1], t[2]);
    visit(i, t[2], t[0]);
  }
}

}  // namespace

EdgeTable::EdgeTable(const Mesh& mesh)
    : firsts_(mesh.vertices.size() + 1), sides_(3 * mesh.triangles.size()) {
  // Count, so that each vertex knows where its sides end.
  for_each_side(mesh, [&](std::uint32_t, std::uint32_t a, std::uint32_t b) {
    ++firsts_[std::min(a, b)];
  });
  std::uint32_t end = 0;
  for (std::uint32_t& first : firsts_) first = end += first;

  // Fill from the ends; this makes of each end the beginning.
  for_each_side(mesh, [&](std::uint32_t i, std::uint32_t a, std::uint32_t b) {
    sides_[--firsts_[std::min(a, b)]] = {std::max(a, b),
                                         2 * i + (a < b ? 1 : 0)};
  });
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
