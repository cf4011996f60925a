#pragma once
// Runs the passes on a stack large enough for any design, and ends the run
// cleanly when it is interrupted or takes too much.
//
// The passes run on a thread of their own (LargeStack). The
// first thread meanwhile waits for signals and looks at the limits
// (cli/process/process_watch.h); being an ordinary thread and not a signal
// handler, it may take locks and remove temporary files. It also ends the
// process after an exception that nobody can catch, such as a failed allocation
// in a library that cannot pass it on.

#include <cstddef>
#include <functional>

#include <pthread.h>

#include "base/file/output_file.h"
#include "cli/process/interrupt.h"
#include "cli/process/process_watch.h"

namespace lamina::cli {

// Designs nest: a sum of 100,000 terms is a tree as deep, and parser, printer
// and evaluator walk trees by recursion. A reserved stack costs no memory
// until it is used, so the passes get one of gigabytes, on a thread of their
// own.
//
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

// Runs `work` with the stack's size in bytes and returns its result, an exit
// status. On SIGINT, SIGTERM or SIGHUP it discards the temporary files and
// ends the process with status 130, unless `interrupt` takes the SIGINT; where
// a limit is exceeded, with a message and status 1. A message that nobody takes
// within a second is dropped.
int run_on_stack(TemporaryFiles& temporary_files, ProcessWatch& watch,
                 Interrupt& interrupt,
                 const std::function<int(std::size_t stack_bytes)>& work);

}  // namespace lamina::cli
