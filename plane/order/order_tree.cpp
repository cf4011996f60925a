#include "plane/order/order_tree.h"

namespace lamina::plane {

void OrderTree::begin(std::size_t count) {
  nodes_.assign(1, {});
  nodes_of_.assign(count, kNone);
  free_.clear();
}

void OrderTree::insert(std::uint32_t below, std::uint32_t above,
                       std::uint32_t entry) {
  auto node = static_cast<std::uint32_t>(nodes_.size());
  if (free_.empty()) {
    nodes_.emplace_back();
  } else {
    node = free_.back();
    free_.pop_back();
    nodes_[node] = {};
  }
  nodes_[node].rank = 1;
  set_entry(node, entry);
  // One of the two neighbours has no child on this side.
  const std::uint32_t parent = nodes_of_[below];
  if (nodes_[parent].children[1] == kNone) {
    set_child(parent, 1, node);
  } else {
    set_child(nodes_of_[above], 0, node);
  }
  balance(node);
}

void OrderTree::remove(std::uint32_t entry, std::uint32_t above) {
  std::uint32_t node = nodes_of_[entry];
  if (nodes_[node].children[0] != kNone && nodes_[node].children[1] != kNone) {
    // The next entry, whose node has one child at most, comes here.
    const std::uint32_t emptied = nodes_of_[above];
    set_entry(node, above);
    node = emptied;
  }
  nodes_of_[entry] = kNone;
  const auto [before, behind] = nodes_[node].children;
  set_child(nodes_[node].parent, side_of(node),
            before != kNone ? before : behind);
  free_.push_back(node);
}

void OrderTree::swap(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t node = nodes_of_[a];
  set_entry(nodes_of_[b], a);
  set_entry(node, b);
}

// Rotates a node into its parent's place.
void OrderTree::lift(std::uint32_t node) {
  const std::uint32_t parent = nodes_[node].parent;
  const std::size_t side = side_of(node);
  set_child(nodes_[parent].parent, side_of(parent), node);
  set_child(parent, side, nodes_[node].children[1 - side]);
  set_child(node, 1 - side, parent);
}

// Puts right a node whose rank may be that of its parent.
void OrderTree::balance(std::uint32_t node) {
  const auto rank = [this](std::uint32_t n) -> int& { return nodes_[n].rank; };
  for (;;) {
    const std::uint32_t parent = nodes_[node].parent;
    if (rank(parent) != rank(node)) return;
    const std::size_t side = side_of(node);
    const std::uint32_t sibling = nodes_[parent].children[1 - side];
    if (rank(sibling) + 1 == rank(parent)) {
      ++rank(parent);
      node = parent;
      continue;
    }
    const std::uint32_t inner = nodes_[node].children[1 - side];
    --rank(parent);
    if (rank(inner) + 1 == rank(node)) {
      --rank(node);
      ++rank(inner);
      lift(inner);
      lift(inner);
    } else {
      lift(node);
    }
    return;
  }
}

}  // namespace lamina::plane
