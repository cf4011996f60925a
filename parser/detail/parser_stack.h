#pragma once
// Bison's stack, once it has outgrown the small one that Bison begins with.
//
// Owned from outside the parser, so that it is freed where an exception (a
// warning under hard warnings) ends the parser.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "parser/detail/syntax_errors.h"

namespace lamina::detail {

class ParserStack {
 public:
  // Raises `size`, in items; false if it is the greatest already.
  static bool grow(std::ptrdiff_t& size) {
    constexpr std::ptrdiff_t kMost = kDeepestTree;
    if (size >= kMost) return false;
    size = std::min(4 * size, kMost);
    return true;
  }

  // Moves a part of the stack (0: states, 1: values, 2: ranges), of which
  // `bytes` are in use, to memory for `size` items.
  template <int kPart, typename Item>
  void move(Item*& items, std::ptrdiff_t bytes, std::ptrdiff_t size) {
    static_assert(std::is_trivially_copyable_v<Item>);
    std::vector<std::byte> memory(static_cast<std::size_t>(size) *
                                  sizeof(Item));
    std::memcpy(memory.data(), items, static_cast<std::size_t>(bytes));
    parts_[kPart].swap(memory);
    items = reinterpret_cast<Item*>(parts_[kPart].data());
  }

 private:
  std::array<std::vector<std::byte>, 3> parts_;
};

}  // namespace lamina::detail
