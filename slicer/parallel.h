#pragma once
// Tasks of oneTBB, and what ThreadSanitizer must be told of them.
//
// Debian's library is not instrumented: the tool sees neither its queues nor
// its locks, and would take every object that one task hands to the next for a
// race. So the order that oneTBB promises is said where it is relied on, object
// by object; where it is not said, a race is a race. In other builds nothing
// remains of it.

#include <cstddef>
#include <functional>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace lamina::slicer {

inline void hand_over([[maybe_unused]] void* object) {
#if defined(__SANITIZE_THREAD__)
  __tsan_release(object);
#endif
}

inline void take_over([[maybe_unused]] void* object) {
#if defined(__SANITIZE_THREAD__)
  __tsan_acquire(object);
#endif
}

// An object that tasks have in turns, while this lives. The thread that makes
// it has the object before and after.
class Lent {
 public:
  explicit Lent(void* object) : object_(object) { hand_over(object_); }
  ~Lent() { take_over(object_); }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

 private:
  void* object_;
};

// A task's turn with an object.
class Turn {
 public:
  explicit Turn(void* object) : Turn(object, object) {}
  // Goes on where `from` was handed over; hands over `to`. Tasks that hand over
  // another object than they take are in no order.
  Turn(void* from, void* to) : to_(to) { take_over(from); }
  ~Turn() { hand_over(to_); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  void* to_;
};

// Calls body(0) … body(count - 1), several at a time, in any order; ends when
// all have.
void for_each_index(std::size_t count,
                    const std::function<void(std::size_t)>& body);

}  // namespace lamina::slicer
