#pragma once
// Tasks of oneTBB, pipelines of them, and what ThreadSanitizer must know of
// them.
//
// Debian's library is not instrumented: the tool sees none of its locks, and
// would take every object that one task hands to the next for a race. So the
// order that oneTBB promises is declared where the code relies on it, object by
// object. Other builds contain none of this.

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/thread_clock.h"

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

// Runs the stages with at most `places` items under way. Returns or throws when
// no task runs any more.
//
// most_threads  0: as many as there are items under way. (oneTBB 2021.8 hangs
//               with a limit where memory ends while threads start.)
void run_stages(std::size_t places, unsigned most_threads,
                const Stages& stages);

// run_stages() with the declarations for ThreadSanitizer.
inline void run_in_order(std::size_t places, unsigned most_threads,
                         const Stages& stages) {
  static char begin;
  static char end;
  char first = 0;  // for all that `start` uses
  char last = 0;   // for all that `finish` uses
  std::vector<char> items(places);
  const auto declare = [&](const auto& stage, char* shared) {
    return [&, shared](std::size_t place) {
      const TaskTurn turn(&begin, &end);
      const TaskTurn item_turn(&items[place]);
      if (shared == nullptr) return stage(place);
      const TaskTurn shared_turn(shared);
      return stage(place);
    };
  };
  const Stages declared = {declare(stages.start, &first),
                           declare(stages.work, nullptr),
                           declare(stages.finish, &last)};
  const Lent lent_begin(&begin);
  const Lent lent_end(&end);
  const Lent lent_first(&first);
  const Lent lent_last(&last);
  run_stages(places, most_threads, declared);
}

// A step of a road, and where the processor seconds are added up that all items
// take in it.
template <typename... Arguments>
struct Step {
  double& seconds;
  std::function<void(Arguments&...)> run;
};

// What items pass through on their way.
template <typename Item, typename Worker>
struct Road {
  // Begins the next item; returns false after the last one.
  std::function<bool(Item&)> start;
  // Makes what one thread keeps from item to item, in that thread.
  std::function<std::unique_ptr<Worker>()> make_worker;
  // Steps that several items take at the same time, each with a worker.
  std::vector<Step<Worker, Item>> work;
  // Steps that one item takes at a time, in the order of the items.
  std::vector<Step<Item>> finish;
};

// Sends all items along a road: waits for threads and for turns, reads clocks,
// and reports the order of work to ThreadSanitizer. One thread does without
// oneTBB, whose start takes as long as a small design. Items are reused, so
// that the steady state allocates nothing. Returns the workers.
//
// has_limit  whether no more than `threads` may work
template <typename Item, typename Worker>
std::vector<std::unique_ptr<Worker>> run_pipeline(
    const Road<Item, Worker>& road, unsigned threads, bool has_limit) {
  // For each thread one item in work and one that waits to be finished.
  struct Place {
    Item item;
    std::vector<double> seconds;
  };
  std::vector<Place> places(threads == 1 ? 1 : std::size_t{2} * threads);
  std::mutex mutex;
  std::map<std::thread::id, std::unique_ptr<Worker>> workers;
  const auto worker_here = [&]() -> Worker& {
    const std::lock_guard lock(mutex);
    std::unique_ptr<Worker>& worker = workers[std::this_thread::get_id()];
    if (!worker) worker = road.make_worker();
    return *worker;
  };
  const Stages stages = {
      [&](std::size_t i) { return road.start(places[i].item); },
      [&](std::size_t i) {
        Place& place = places[i];
        Worker& worker = worker_here();
        place.seconds.clear();
        for (const auto& step : road.work) {
          place.seconds.push_back(
              measure_seconds([&] { step.run(worker, place.item); }));
        }
      },
      [&](std::size_t i) {
        Place& place = places[i];
        for (std::size_t k = 0; k < road.work.size(); ++k) {
          road.work[k].seconds += place.seconds[k];
        }
        for (const auto& step : road.finish) {
          step.seconds += measure_seconds([&] { step.run(place.item); });
        }
      }};
  if (threads == 1) {
    while (stages.start(0)) {
      stages.work(0);
      stages.finish(0);
    }
  } else {
    run_in_order(places.size(), has_limit ? threads : 0, stages);
  }
  std::vector<std::unique_ptr<Worker>> all;
  for (auto& [thread, worker] : workers) all.push_back(std::move(worker));
  return all;
}

}  // namespace lamina
