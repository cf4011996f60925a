#pragma once
// Stacks large enough for any design.
//
// Designs nest: a sum of 100,000 terms is a tree as deep, and parser, printer
// and evaluator walk trees by recursion. A reserved stack costs no memory
// until it is used, so the passes get one of gigabytes, on a thread of their
// own.

#include <cstddef>

#include <pthread.h>

namespace lamina::cli {

// Address space for the stack of a thread; taken as it is touched. Halves its
// wish where the system limits address space.
class LargeStack {
 public:
  LargeStack();
  ~LargeStack();  // after its thread's end
  LargeStack(const LargeStack&) = delete;
  LargeStack& operator=(const LargeStack&) = delete;

  // What the thread may use.
  std::size_t size() const { return size_ - kGuardSize; }

  // Starts a thread on it, which pthread_join() must wait for. False if that
  // cannot be.
  bool start(pthread_t& thread, void* (*work)(void*), void* argument) const;

  // Of the stack that every thread has.
  static constexpr std::size_t kSmallestSize = std::size_t{8} << 20;
  // A tree of the parser's limit, 250,000 levels, at 4 KiB each, twice over.
  static constexpr std::size_t kLargestSize = std::size_t{2} << 30;

 private:
  // Below the stack: touching it ends the run instead of spoiling memory.
  static constexpr std::size_t kGuardSize = std::size_t{1} << 16;

  void* begin_;
  std::size_t size_;
};

}  // namespace lamina::cli
