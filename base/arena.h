#pragma once
// Memory of one tree (syntax tree, resolved code, CSG tree), freed at once.
//
// Nodes are trivially destructible, so freeing costs a few blocks and no walk.
// Unlike std::pmr::monotonic_buffer_resource the arena can go back to a mark:
// the parser makes the elements of `[1, 2, 3]` first and then replaces them by
// three doubles, which shrinks a large .csg's tree to a third.

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lamina {

class Arena {
 public:
  // A state to go back to.
  struct Mark {
    std::size_t block;
    std::size_t used;
  };

  // Uninitialised memory; alignment at most that of std::max_align_t.
  void* allocate(std::size_t bytes, std::size_t alignment);

  template <typename T>
  T* make(T value) {
    static_assert(std::is_trivially_destructible_v<T>);
    return new (allocate(sizeof(T), alignof(T))) T(std::move(value));
  }

  template <typename T>
  std::span<const T> copy(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (values.empty()) return {};
    // T may be a pointer.  NOLINTNEXTLINE(bugprone-sizeof-expression)
    const std::size_t bytes = values.size() * sizeof(T);
    T* target = static_cast<T*>(allocate(bytes, alignof(T)));
    std::uninitialized_copy(values.begin(), values.end(), target);
    return {target, values.size()};
  }

  std::string_view copy(std::string_view text) {
    const auto kept = copy(std::span<const char>(text));
    return {kept.data(), kept.size()};
  }

  Mark mark() const { return {block_, used_}; }

  // Forgets all that was allocated after `mark`.
  void release(Mark mark);

 private:
  struct Block {
    std::unique_ptr<std::byte[]> memory;
    std::size_t size;
  };

  void open_block(std::size_t bytes);

  std::vector<Block> blocks_;
  std::size_t block_ = 0;  // index of the block in use
  std::size_t used_ = 0;   // bytes used in it
};

}  // namespace lamina
