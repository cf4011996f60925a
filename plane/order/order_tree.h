#pragma once
// A balanced tree that keeps the order of entries, as Bentley and Ottmann's
// status asks for: the place of a new one is found in O(log n) steps, in
// whatever order n others came.
//
// It is a relaxed AVL tree: removal does not balance, which costs nothing in
// height but that n counts those that left as well (Sen, Tarjan, "Deletion
// without rebalancing in balanced binary trees", SODA 2010). A node has a rank
// above those of its children, and for each new node one or two rotations at
// most keep it within 1.45 log2(n).
//
// Whoever has the tree knows each entry's neighbours, so it is given where an
// entry belongs and compares nothing by itself. Nodes are not entries: two
// entries change places by exchanging their nodes, and the tree keeps its
// shape.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamina::plane {

class OrderTree {
 public:
  // Empties the tree for entries of these numbers: 0 to count - 1.
  void begin(std::size_t count);

  bool holds(std::uint32_t entry) const { return nodes_of_[entry] != kNone; }

  // Puts an entry between two neighbours. `below` may be an entry that is not
  // in the tree: then `above` was the first, or there was none.
  void insert(std::uint32_t below, std::uint32_t above, std::uint32_t entry);
  // `above` is the neighbour of the entry, if it has one.
  void remove(std::uint32_t entry, std::uint32_t above);
  // Exchanges two entries.
  void swap(std::uint32_t a, std::uint32_t b);

  // A number by which entries of the tree can be sorted, until it changes.
  // Cost: O(log n).
  std::uint64_t place_of(std::uint32_t entry) const {
    // A binary fraction: the way from the root, and a last 1. No tree is 63
    // nodes high.
    constexpr int kFirstBit = 63;
    std::uint64_t place = std::uint64_t{1} << kFirstBit;
    for (std::uint32_t node = nodes_of_[entry]; nodes_[node].parent != kNone;
         node = nodes_[node].parent) {
      place = place >> 1 | std::uint64_t{side_of(node)} << kFirstBit;
    }
    return place;
  }

  // The last entry that is_below(entry) holds for, where it holds for all
  // before; `none` if for no entry. Asks O(log n) entries.
  template <typename IsBelow>
  std::uint32_t find_last(const IsBelow& is_below, std::uint32_t none) const {
    std::uint32_t last = none;
    for (std::uint32_t node = nodes_[kNone].children[1]; node != kNone;) {
      const bool goes_up = is_below(nodes_[node].entry);
      if (goes_up) last = nodes_[node].entry;
      node = nodes_[node].children[goes_up ? 1 : 0];
    }
    return last;
  }

 private:
  // Stands for no node; and above the root, which is its second child.
  static constexpr std::uint32_t kNone = 0;

  struct Node {
    std::uint32_t parent = kNone;
    std::array<std::uint32_t, 2> children{kNone, kNone};  // before, behind
    std::uint32_t entry = 0;
    int rank = 0;  // of kNone 0
  };

  void set_entry(std::uint32_t node, std::uint32_t entry) {
    nodes_[node].entry = entry;
    nodes_of_[entry] = node;
  }
  std::size_t side_of(std::uint32_t node) const {
    return nodes_[nodes_[node].parent].children[1] == node ? 1 : 0;
  }
  void set_child(std::uint32_t node, std::size_t side, std::uint32_t child) {
    nodes_[node].children[side] = child;
    if (child != kNone) nodes_[child].parent = node;
  }
  void lift(std::uint32_t node);
  void balance(std::uint32_t node);

  std::vector<Node> nodes_{1};
  std::vector<std::uint32_t> nodes_of_;  // of each entry, or kNone
  std::vector<std::uint32_t> free_;      // nodes
};

}  // namespace lamina::plane
