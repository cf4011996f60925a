#include "cli/run_on_stack.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include "cli/large_stack.h"
#include "cli/progress.h"

namespace lamina::cli {
namespace {

constexpr int kInterruptedStatus = 130;

// Sent by the working thread to the waiting one: "done".
constexpr int kDoneSignal = SIGUSR1;

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

  const LargeStack stack;
  Run run{work, stack.size(), ::pthread_self()};
  pthread_t thread{};
  if (!stack.start(thread, &work_and_tell, &run)) {
    // Without a second thread the run is still right, if less deep.
    return work(LargeStack::kSmallestSize / 2);
  }
  int received = 0;
  ::sigwait(&signals, &received);
  if (received != kDoneSignal) {
    temporary_files.discard_all();
    end_progress();
    ::_exit(kInterruptedStatus);
  }
  ::pthread_join(thread, nullptr);
  return run.status;
}

}  // namespace lamina::cli
