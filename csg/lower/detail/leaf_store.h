#pragma once
// The leaves of a scene, each kept once.
//
// A design repeats few shapes very often, so primitives are kept in unit size
// by their number of facets (the size goes into the instance's matrix), and
// any other leaf is compared with those there. Throws LimitExceeded.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "csg/scene.h"
#include "plane/region/region.h"

namespace lamina::csg {

using SharedOutline = std::shared_ptr<const std::vector<Vec2>>;

class LeafStore {
 public:
  // [0, 1]³, or [-1/2, 1/2]³ if centred.
  std::uint32_t unit_cube(bool center);
  // Radius 1.
  std::uint32_t unit_sphere(int fragments);
  // Height 1 from 0, or from -1/2 if centred; bottom and top radius.
  std::uint32_t unit_height_cone(double r1, double r2, bool center,
                                 int fragments);
  // Adds any other leaf and computes its box, unless an equal one is there.
  std::uint32_t add(Leaf leaf);

  // (cos, sin) of a circle in n fragments.
  SharedOutline circle(int n);

  const Leaf& operator[](std::uint32_t leaf) const { return leaves_[leaf]; }

  // Hands all leaves over.
  std::vector<Leaf> take() { return std::move(leaves_); }

 private:
  enum class Shape : std::uint8_t { kCube, kSphere, kCone };
  using Key = std::tuple<Shape, bool, int, double, double>;

  template <typename Make>
  std::uint32_t find_or_add(const Key& key, Make make);

  std::vector<Leaf> leaves_;
  std::map<Key, std::uint32_t> primitives_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> others_;
  std::unordered_map<int, SharedOutline> circles_;
};

// The hulls of a design, each made once.
//
// A module with a hull in it is called hundreds of times: moved as a whole, its
// operands are the same to the last bit in the hull's own coordinates. Hulls
// that are only nearly the same are made anew, so that a table changes no
// digit.
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
