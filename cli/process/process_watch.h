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
#include <limits>
#include <list>
#include <mutex>
#include <string>

namespace lamina::cli {

// Bytes, or a share of the machine's memory.
struct MemoryLimit {
  std::uint64_t bytes = 0;  // 0: the share counts
  double share = 0.8;
};

struct ProcessLimits {
  MemoryLimit memory;
  // Wall time of the run, or of each piece where there are several.
  double seconds = std::numeric_limits<double>::infinity();
};

class ProcessWatch {
 public:
  // Time counts from here.
  explicit ProcessWatch(const ProcessLimits& limits)
      : limits_(limits), timed_{{"", Clock::now()}} {}
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  const ProcessLimits& limits() const { return limits_; }

  // From now on each part of the work has the whole time for itself, and what
  // stands between parts is not timed.
  void time_parts();

  // A part of the work; it is under way as long as this object lives.
  class Part {
   public:
    // name  stands before messages: "orders.csv:17: "
    Part(ProcessWatch& watch, const std::string& name);
    ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    ProcessWatch& watch_;
    const void* timed_;
  };

  // Makes room for stacks to come: address space, which is not memory yet.
  void reserve(std::uint64_t bytes);

  // How long from now the next look can wait at most.
  std::chrono::nanoseconds pause();

  // Says as a line for the terminal which limit is exceeded; empty if none is.
  // Called by one thread.
  //
  // besides  bytes of memory that are not the process's own but its files' and
  //          its children's
  std::string look(std::uint64_t besides);

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

// The message where an allocation failed: it names the limit that was met.
std::string out_of_memory_text();

// "500 MiB": in the largest unit of which it is not a small part.
std::string memory_size_text(std::uint64_t bytes);

}  // namespace lamina::cli
