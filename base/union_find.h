#pragma once
// Numbers that turn out to belong together: a forest, each tree a set, with the
// least of its numbers at the root.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lamina {

class UnionFind {
 public:
  // Each of the numbers below `size` by itself.
  explicit UnionFind(std::size_t size = 0) : parents_(size) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  // Adds the next number, by itself, and returns it.
  std::uint32_t add() {
    parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
    return parents_.back();
  }

  // The least number of the set.
  std::uint32_t find(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  // Makes one set of two, and returns its least number.
  std::uint32_t unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    const std::uint32_t least = std::min(a, b);
    parents_[std::max(a, b)] = least;
    return least;
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace lamina
