#include "cli/process/run_on_stack.h"

#include <chrono>
#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include "base/child_process.h"
#include "cli/process/exit_status.h"
#include "cli/process/progress.h"
#include "cli/process/streams.h"

namespace lamina::cli {
namespace {

// Sent to the waiting thread: "done", by the working one, and "an exception
// cannot be passed on", by any.
constexpr int kDoneSignal = SIGUSR1;
constexpr int kLostSignal = SIGUSR2;

// What was thrown; sent with kLostSignal.
enum Lost { kLostMemory, kLostError };

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

// The status that exit_soon() ends the process with.
volatile std::sig_atomic_t status_of_exit = kFault;

// Ends the process in a second, whatever its threads wait for: words may be for
// a pipe that nobody reads, or for a terminal stopped by Ctrl-S.
void exit_soon(int status) {
  status_of_exit = status;
  struct sigaction action {};
  action.sa_handler = [](int) { ::_exit(status_of_exit); };
  ::sigaction(SIGALRM, &action, nullptr);
  sigset_t alarm;
  ::sigemptyset(&alarm);
  ::sigaddset(&alarm, SIGALRM);
  ::pthread_sigmask(SIG_UNBLOCK, &alarm, nullptr);
  itimerval time{};
  time.it_value.tv_sec = 1;
  ::setitimer(ITIMER_REAL, &time, nullptr);
}

// Stands for abort(): has the waiting thread end the process.
[[noreturn]] void tell_lost_exception() {
  sigval what{};
  // So, too, where memory is lacking for the exception itself: there is none.
  what.sival_int = kLostMemory;
  try {
    // cppcheck-suppress rethrowNoCurrentException ; asked just before
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
  } catch (...) {
    what.sival_int = kLostError;
  }
  // To the process: all threads but the waiting one block it.
  ::sigqueue(::getpid(), kLostSignal, what);
  // The waiting thread needs no second, unless it waits for a lock of this one.
  ::sleep(2);
  exit_soon(kFault);
  print_error("error: out of memory\n");
  ::_exit(kFault);
}

// Ends the process while its other threads still run. Nothing here may throw,
// not even for lack of memory.
[[noreturn]] void end_process(TemporaryFiles& temporary_files, int status,
                              std::string_view message) noexcept {
  static const pthread_t ending_thread = ::pthread_self();
  std::set_terminate([] {
    // Others leave it the time to say why.
    if (::pthread_equal(::pthread_self(), ending_thread) == 0) ::sleep(2);
    ::_exit(kFault);
  });
  // First what counts: the words may find nobody to take them.
  try {
    temporary_files.discard_all();
  } catch (const std::bad_alloc&) {
    // To remove folders takes memory. The next run removes them.
  }
  exit_soon(status);
  end_progress();
  print_error(message);
  ::_exit(status);
}

std::string lost_text(int what) {
  return fmt::format("error: {}\n",
                     what == kLostMemory
                         ? out_of_memory_text()
                         : "internal error, please report: an exception that "
                           "nothing catches");
}

// Waits for one of the signals, at most so long. The number of the signal is 0
// where none came.
siginfo_t wait_for(const sigset_t& signals, std::chrono::nanoseconds time) {
  timespec pause{};
  pause.tv_nsec = time.count();
  siginfo_t received{};
  if (::sigtimedwait(&signals, &received, &pause) < 0) received.si_signo = 0;
  return received;
}

// Returns when the work is done.
void watch_over(const sigset_t& signals, TemporaryFiles& temporary_files,
                ProcessWatch& watch, Interrupt& interrupt) {
  while (true) {
    const siginfo_t received = wait_for(signals, watch.pause());
    switch (received.si_signo) {
      case kDoneSignal:
        return;
      case kLostSignal:
        end_process(temporary_files, kFault,
                    lost_text(received.si_value.sival_int));
      case 0:
        break;
      default:
        if (interrupt.take(received.si_signo != SIGINT)) break;
        end_process(temporary_files, kInterrupted, "");
    }
    const std::string exceeded =
        watch.look(temporary_files.bytes_in_memory() + memory_of_children());
    if (!exceeded.empty()) end_process(temporary_files, kFault, exceeded);
  }
}

}  // namespace

int run_on_stack(TemporaryFiles& temporary_files, ProcessWatch& watch,
                 Interrupt& interrupt,
                 const std::function<int(std::size_t)>& work) {
  // A reader that closes its pipe early, and a file larger than the user may
  // write, are failed writes, not a death.
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(tell_lost_exception);
  // All threads inherit the mask: signals reach the waiting thread alone.
  sigset_t signals = ending_signals();
  ::sigaddset(&signals, kDoneSignal);
  ::sigaddset(&signals, kLostSignal);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  LargeStack stack;
  int status = kFault;
  const pthread_t waiting_thread = ::pthread_self();
  const bool is_started = stack.start([&] {
    status = work(stack.size());
    ::pthread_kill(waiting_thread, kDoneSignal);
  });
  if (!is_started) {
    end_process(temporary_files, kFault,
                "error: the system grants no second thread, or no stack for "
                "it (ulimit -u, -d, -v)\n");
  }
  try {
    watch_over(signals, temporary_files, watch, interrupt);
  } catch (const std::bad_alloc&) {
    end_process(temporary_files, kFault, "error: out of memory\n");
  }
  stack.join();
  return status;
}

LargeStack::LargeStack() {
  for (size_ = kLargestSize; size_ >= kSmallestSize; size_ /= 2) {
    begin_ =
        ::mmap(nullptr, size_, PROT_READ | PROT_WRITE,
               MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
    if (begin_ == MAP_FAILED) continue;
    ::mprotect(begin_, kGuardSize, PROT_NONE);
    return;
  }
}

LargeStack::~LargeStack() {
  if (begin_ != MAP_FAILED) ::munmap(begin_, size_);
}

bool LargeStack::start(std::function<void()> work) {
  if (begin_ == MAP_FAILED) return false;
  work_ = std::move(work);
  const auto run = [](void* function) -> void* {
    (*static_cast<std::function<void()>*>(function))();
    return nullptr;
  };
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  const bool is_started =
      ::pthread_attr_setstack(&attributes, begin_, size_) == 0 &&
      ::pthread_create(&thread_, &attributes, run, &work_) == 0;
  ::pthread_attr_destroy(&attributes);
  return is_started;
}

}  // namespace lamina::cli
