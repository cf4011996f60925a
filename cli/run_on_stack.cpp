#include "cli/run_on_stack.h"

#include <array>

#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include "cli/progress.h"

namespace lamina::cli {
namespace {

// A tree of the parser's limit, 250,000 levels, at 4 KiB each, twice over.
constexpr std::size_t kLargestStack = std::size_t{2} << 30;
constexpr std::size_t kSmallestStack = std::size_t{8} << 20;

// Below the stack: touching it ends the run instead of spoiling memory.
constexpr std::size_t kGuardSize = std::size_t{1} << 16;

constexpr int kInterruptedStatus = 130;

// Sent by the working thread to the waiting one: "done".
constexpr int kDoneSignal = SIGUSR1;

// Address space for a stack; taken as it is touched. Halves its wish where the
// system limits address space.
class ReservedStack {
 public:
  ReservedStack() {
    for (size_ = kLargestStack; size_ >= kSmallestStack; size_ /= 2) {
      begin_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK,
                      -1, 0);
      if (begin_ == MAP_FAILED) continue;
      ::mprotect(begin_, kGuardSize, PROT_NONE);
      return;
    }
  }
  ~ReservedStack() {
    if (is_there()) ::munmap(begin_, size_);
  }
  ReservedStack(const ReservedStack&) = delete;
  ReservedStack& operator=(const ReservedStack&) = delete;

  bool is_there() const { return begin_ != MAP_FAILED; }
  void* begin() const { return begin_; }
  std::size_t size() const { return size_; }
  std::size_t usable_size() const { return size_ - kGuardSize; }

 private:
  void* begin_ = MAP_FAILED;
  std::size_t size_ = 0;
};

struct Run {
  const std::function<int(std::size_t)>& work;
  std::size_t stack_bytes;
  pthread_t waiting_thread;
  int status = 0;
};

void* work_and_tell(void* argument) {
  Run& run = *static_cast<Run*>(argument);
  run.status = run.work(run.stack_bytes);
  ::pthread_kill(run.waiting_thread, kDoneSignal);
  return nullptr;
}

// The signals that end a run, save those that the caller wants ignored
// (nohup).
sigset_t ending_signals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) ::sigaddset(&signals, signal);
  }
  return signals;
}

}  // namespace

int run_on_stack(slicer::TemporaryFiles& temporary_files,
                 const std::function<int(std::size_t)>& work) {
  // A reader that closes its pipe early, and a file larger than the user may
  // write, are failed writes, not a death.
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  // All threads inherit the mask: signals reach sigwait() alone.
  sigset_t signals = ending_signals();
  ::sigaddset(&signals, kDoneSignal);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  const ReservedStack stack;
  Run run{work, stack.usable_size(), ::pthread_self()};
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  pthread_t thread{};
  if (!stack.is_there() ||
      ::pthread_attr_setstack(&attributes, stack.begin(), stack.size()) != 0 ||
      ::pthread_create(&thread, &attributes, &work_and_tell, &run) != 0) {
    // Without a second thread the run is still right, if less deep.
    return work(kSmallestStack / 2);
  }
  int received = 0;
  ::sigwait(&signals, &received);
  if (received != kDoneSignal) {
    temporary_files.discard_all();
    end_progress();
    ::_exit(kInterruptedStatus);
  }
  ::pthread_join(thread, nullptr);
  ::pthread_attr_destroy(&attributes);
  return run.status;
}

}  // namespace lamina::cli
