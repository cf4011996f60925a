#pragma once
// Tasks of oneTBB, and what ThreadSanitizer must know of them.
//
// Debian's library is not instrumented: the tool sees none of its locks, and
// would take every object that one task hands to the next for a race. So the
// order that oneTBB promises is declared where the code relies on it, object by
// object. Other builds contain none of this.

#include <cstddef>
#include <functional>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace lamina {

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

// Lends an object to tasks, which have it in turns, as long as this lives. The
// thread that makes this has the object before and after.
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
class TaskTurn {
 public:
  explicit TaskTurn(void* object) : TaskTurn(object, object) {}
  // Begins after `from` was handed over, and hands over `to` at its end. Tasks
  // that hand over another object than they take are in no order.
  TaskTurn(void* from, void* to) : to_(to) { take_over(from); }
  ~TaskTurn() { hand_over(to_); }
  TaskTurn(const TaskTurn&) = delete;
  TaskTurn& operator=(const TaskTurn&) = delete;

 private:
  void* to_;
};

// for_each_index() without the declarations for ThreadSanitizer.
void run_tasks(std::size_t count, const std::function<void(std::size_t)>& task);

// Calls body(0) … body(count - 1), several at a time, in any order, and returns
// when all calls have.
inline void for_each_index(std::size_t count,
                           const std::function<void(std::size_t)>& body) {
  // They are static, so that a task can find them before it takes over
  // anything.
  static char begin;
  static char end;
  const std::function<void(std::size_t)> task = [&body](std::size_t i) {
    const TaskTurn turn(&begin, &end);
    body(i);
  };
  const Lent lent_begin(&begin);
  const Lent lent_end(&end);
  run_tasks(count, task);
}

// The stages of a pipeline. `start` and `finish` take one item at a time, in
// order; `work` takes several at a time. An item is known by its place among
// those under way. `start` returns false where no item is left.
struct Stages {
  std::function<bool(std::size_t)> start;
  std::function<void(std::size_t)> work;
  std::function<void(std::size_t)> finish;
};

// run_pipeline() without the declarations for ThreadSanitizer.
void run_stages(std::size_t places, const Stages& stages);

// Runs the stages with at most `places` items under way. Returns or throws when
// no task runs any more.
inline void run_pipeline(std::size_t places, const Stages& stages) {
  static char begin;
  static char end;
  const auto tell = [](const auto& stage) {
    return [&stage](std::size_t place) {
      const TaskTurn turn(&begin, &end);
      return stage(place);
    };
  };
  const Stages told = {tell(stages.start), tell(stages.work),
                       tell(stages.finish)};
  const Lent lent_begin(&begin);
  const Lent lent_end(&end);
  run_stages(places, told);
}

}  // namespace lamina
