#pragma once
// Which boxes hang together, where boxes that touch do.
//
// n boxes may touch in n² pairs, yet n - 1 of these say all. A line moves over
// the boxes in x, and a segment tree over y holds those on it. Of boxes that a
// new one has met at once only the one that ends last is kept to be met again:
// O(n log n). Source: Imai, Asano, "Finding the connected components and a
// maximum clique of an intersection graph of rectangles in the plane", 1983.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::slicer {

class TouchingBoxes {
 public:
  // For each box the first one that it hangs together with: itself, or one
  // before it. Valid until the next call.
  const std::vector<std::uint32_t>& find(std::span<const Box2> boxes);

  // Pairs that the last call looked at.
  std::size_t visits() const { return visits_; }

 private:
  struct Entry {
    std::uint32_t box;
    std::uint32_t next;
  };

  void add(std::uint32_t box, std::size_t node, std::size_t first,
           std::size_t last);
  void meet(std::uint32_t a, std::uint32_t b);
  std::uint32_t root_of(std::uint32_t box);

  std::span<const Box2> boxes_;
  std::vector<std::uint32_t> firsts_;  // union-find
  std::vector<std::uint32_t> order_;   // of the boxes, as they begin in x
  std::vector<double> levels_;         // y where one begins or ends
  // By node of the tree: a box that covers all its levels, and those that cover
  // some of them.
  std::vector<std::uint32_t> covers_;
  std::vector<std::uint32_t> heads_;
  std::vector<Entry> entries_;
  std::size_t visits_ = 0;
};

}  // namespace lamina::slicer
