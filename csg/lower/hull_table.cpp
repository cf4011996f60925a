#include "csg/lower/detail/hull_table.h"

#include <bit>
#include <utility>

#include "csg/boundary/convex_hull.h"

namespace lamina::csg {

const Mesh& HullTable::find_or_make(Scene scene) {
  const auto [place, is_new] = hulls_.try_emplace(key_of(scene));
  if (is_new) place->second = convex_hull(std::move(scene));
  return place->second;
}

HullTable::Key HullTable::key_of(const Scene& scene) {
  std::vector<std::uint32_t> ids;
  for (const Leaf& leaf : scene.leaves) ids.push_back(leaves_.add(leaf));
  Key key{scene.program.size()};
  for (const BooleanNode& node : scene.program) {
    key.push_back(static_cast<std::uint64_t>(node.op));
    key.push_back(node.parent);
    key.push_back(node.is_minuend ? 1 : 0);
  }
  for (const Instance& instance : scene.instances) {
    key.push_back(ids[instance.leaf]);
    key.push_back(instance.parent);
    key.push_back((instance.is_minuend ? 1 : 0) + (instance.is_flat ? 2 : 0));
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) {
        key.push_back(std::bit_cast<std::uint64_t>(
            instance.world_from_leaf[column][row]));
      }
    }
  }
  return key;
}

}  // namespace lamina::csg
