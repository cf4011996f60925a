#pragma once
// The sides of a surface's faces, sorted by edge.
//
// A half-edge structure refuses what designs are full of: edges of four
// triangles, cones that meet in a point. A sorted list of sides takes anything.
// Counting sorts it by the smaller vertex, and the six or so sides that share
// one are sorted by themselves: no allocation for an edge, 8 bytes for a side.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// One side of one face. Its smaller vertex is known from where it stands.
struct Side {
  std::uint32_t high = 0;  // the greater vertex
  std::uint32_t code = 0;  // twice the face, plus 1 if rising

  std::uint32_t face() const { return code / 2; }
  bool is_rising() const { return code % 2 == 1; }  // runs from low to high
};

class EdgeTable {
 public:
  // for_each_side  calls its argument with (face, from, to) for every side, in
  //                the order of the faces; it is called twice
  template <typename ForEachSide>
  static EdgeTable make(std::size_t vertex_count, ForEachSide for_each_side) {
    EdgeTable table;
    std::vector<std::uint32_t>& firsts = table.firsts_;
    firsts.assign(vertex_count + 1, 0);
    // Count, so that each vertex knows where its sides end.
    for_each_side([&](std::uint32_t, std::uint32_t a, std::uint32_t b) {
      ++firsts[std::min(a, b)];
    });
    std::uint32_t end = 0;
    for (std::uint32_t& first : firsts) first = end += first;

    // Fill from the ends; this makes of each end the beginning.
    table.sides_.resize(end);
    for_each_side([&](std::uint32_t face, std::uint32_t a, std::uint32_t b) {
      table.sides_[--firsts[std::min(a, b)]] = {std::max(a, b),
                                                2 * face + (a < b ? 1 : 0)};
    });
    table.sort_by_edge();
    return table;
  }

  // No triangle may name a vertex twice.
  static EdgeTable of(const Mesh& mesh);

  // Calls visit(low, sides) for each edge, in the order of its smaller vertex,
  // then of its greater; sides are in the order of their faces.
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

  // Some edge has no partner, however the faces are turned.
  bool is_open() const;

 private:
  void sort_by_edge();

  std::vector<std::uint32_t> firsts_;  // into sides_, of each smaller vertex
  std::vector<Side> sides_;
};

}  // namespace lamina::csg
