#pragma once
// Keeps a process within its time and memory.
//
// The work itself does not check: it may be deep inside a library, or in a loop
// that nobody thought of. The thread that waits for the work looks at the
// clock and at the memory in use, every 20 ms, and ends the process
// (cli/process/run_on_stack.h). A look costs 2 us, and a run that is over
// before the first one pays nothing.
//
// Between two looks a process could take much. So from the first look on the
// system has a limit, too: somewhat above that of the option, since what is
// asked for is never in use as a whole. Beyond it an allocation fails, which is
// reported like any lack of memory.

#include <chrono>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>

#include "cli/process/process_limits.h"

namespace lamina::cli {

class ProcessWatch {
 public:
  // Time counts from here.
  explicit ProcessWatch(const ProcessLimits& limits)
      : limits_(limits), timed_{{"", Clock::now()}} {}
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  // From now on each part of the work has the time by itself, and what is
  // between parts takes as long as it takes.
  void time_parts();

  // A part of the work, under way as long as this lives.
  class Part {
   public:
    // name  before messages: "orders.csv:17: "
    Part(ProcessWatch& watch, const std::string& name);
    ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    ProcessWatch& watch_;
    const void* timed_;
  };

  // Room for stacks that will be made: address space, which is no memory yet.
  void reserve(std::uint64_t bytes);

  // When to look next, at the latest, from now.
  std::chrono::nanoseconds pause();

  // What has been exceeded, as a line for the terminal; empty: nothing. Called
  // by one thread.
  //
  // files  memory that files take and the process does not [B]
  std::string look(std::uint64_t files);

 private:
  using Clock = std::chrono::steady_clock;

  struct Timed {
    std::string name;
    Clock::time_point begin;
  };

  // Under the lock:
  void begin_to_look(std::uint64_t resident);
  void limit_writable_memory() const;
  std::string names_under_way();

  const ProcessLimits limits_;

  std::mutex mutex_;  // for what follows
  std::list<Timed> timed_;
  std::uint64_t most_bytes_ = 0;      // 0: not looked at yet
  std::uint64_t writable_bytes_ = 0;  // of address space; 0: no limit
  std::uint64_t granted_bytes_ = 0;   // of that, by the system at the start
};

// What to say where an allocation failed: whose limit that was.
std::string out_of_memory_text();

}  // namespace lamina::cli
