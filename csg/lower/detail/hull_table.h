#pragma once
// The hulls of a design, each made once.
//
// A module with a hull in it is called hundreds of times: moved as a whole, its
// operands are the same to the last bit in the hull's own coordinates. Hulls
// that are only nearly the same are made anew, so that a table changes no
// digit.

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "csg/lower/detail/leaf_store.h"
#include "csg/scene.h"

namespace lamina::csg {

class HullTable {
 public:
  // The convex hull of the scene; it stays where it is.
  const Mesh& find_or_make(Scene scene);

  // How many were made.
  std::size_t size() const { return hulls_.size(); }

 private:
  // All that a hull depends on, number by number.
  using Key = std::vector<std::uint64_t>;

  Key key_of(const Scene& scene);

  LeafStore leaves_;  // of all scenes; keys name them by number
  std::map<Key, Mesh> hulls_;
};

}  // namespace lamina::csg
