#pragma once
// Stacks large enough for any design.
//
// Designs nest: a sum of 100,000 terms is a tree as deep, and parser, printer
// and evaluator walk trees by recursion. A reserved stack costs no memory
// until it is used, so the passes get one of gigabytes, on a thread of their
// own.

#include <cstddef>
#include <functional>

#include <pthread.h>

namespace lamina::cli {

// The address space of a thread's stack; memory is taken as it is touched. The
// stack is smaller where the system limits address space.
class LargeStack {
 public:
  LargeStack();
  ~LargeStack();  // after its thread's end
  LargeStack(const LargeStack&) = delete;
  LargeStack& operator=(const LargeStack&) = delete;

  // What the thread may use.
  std::size_t size() const { return size_ - kGuardSize; }

  // Starts a thread on it that runs `work`, which must not throw, and for which
  // join() must wait. Returns false where that fails.
  bool start(std::function<void()> work);
  void join() { ::pthread_join(thread_, nullptr); }

  // As large as the stack that every program has.
  static constexpr std::size_t kSmallestSize = std::size_t{8} << 20;
  // Twice what a tree at the parser's limit takes: 250,000 levels of 4 KiB.
  static constexpr std::size_t kLargestSize = std::size_t{2} << 30;

 private:
  // Below the stack: touching it ends the run instead of spoiling memory.
  static constexpr std::size_t kGuardSize = std::size_t{1} << 16;

  void* begin_;
  std::size_t size_;
  pthread_t thread_{};
  std::function<void()> work_;
};

}  // namespace lamina::cli
