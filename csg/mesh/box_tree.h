#pragma once
// Boxes in a binary tree, to find those that meet something.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

// Boxes that touch meet.
inline bool do_meet(const Box3& a, const Box3& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
         b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

class BoxTree {
 public:
  // Nodes come depth first: the left child next to its parent, the right one
  // after the left one's subtree.
  struct Node {
    Box3 box;
    std::uint32_t first = 0;  // its items: items()[first, first + count)
    std::uint32_t count = 0;
    std::uint32_t size = 1;  // nodes of the subtree, this one included
  };

  // O(n log n); any number of boxes.
  explicit BoxTree(std::span<const Box3> boxes);

  // The root is 0; without boxes there are no nodes.
  const std::vector<Node>& nodes() const { return nodes_; }
  // Returns indices of boxes, those of a node together.
  std::span<const std::uint32_t> items(const Node& node) const {
    return std::span(items_).subspan(node.first, node.count);
  }

  // Calls visit(item) for each box that `test` holds for; `test` holds for any
  // box that encloses one that it holds for.
  template <typename Test, typename Visit>
  void visit(Test test, Visit visit) const {
    for (std::uint32_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (!test(node.box)) {
        i += node.size;
        continue;
      }
      if (node.size == 1) {
        for (const std::uint32_t item : items(node)) {
          if (test(boxes_[item])) visit(item);
        }
      }
      ++i;
    }
  }

 private:
  void build(std::uint32_t first, std::uint32_t count);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
  std::vector<Box3> boxes_;
};

}  // namespace lamina::csg
