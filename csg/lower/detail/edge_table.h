#pragma once
// The sides of a mesh's triangles, sorted by edge.
//
// A half-edge structure refuses what designs are full of: edges of four
// triangles, cones that meet in a point. A sorted list of sides takes anything.
// Counting sorts it by the smaller vertex, and the six or so sides that share
// one are sorted by themselves: no allocation for an edge, 8 bytes for a side.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// One side of one triangle. Its smaller vertex is known from where it stands.
struct Side {
  std::uint32_t high = 0;  // the greater vertex
  std::uint32_t code = 0;  // twice the triangle, plus 1 if rising

  std::uint32_t triangle() const { return code / 2; }
  bool is_rising() const { return code % 2 == 1; }  // runs from low to high
};

class EdgeTable {
 public:
  // No triangle may name a vertex twice.
  explicit EdgeTable(const Mesh& mesh);

  // Calls visit(low, sides) for each edge, in the order of its smaller vertex,
  // then of its greater; sides are in the order of their triangles.
  template <typename Visit>
  void for_each_edge(Visit visit) const {
    for (std::uint32_t low = 0; low + 1 < firsts_.size(); ++low) {
      for (std::uint32_t i = firsts_[low]; i < firsts_[low + 1];) {
        const std::uint32_t begin = i;
        while (i < firsts_[low + 1] && sides_[i].high == sides_[begin].high) {
          ++i;
        }
        visit(low, std::span(&sides_[begin], i - begin));
      }
    }
  }

  // Some edge has no partner, however the triangles are turned.
  bool is_open() const;

 private:
  std::vector<std::uint32_t> firsts_;  // into sides_, of each smaller vertex
  std::vector<Side> sides_;
};

}  // namespace lamina::csg
