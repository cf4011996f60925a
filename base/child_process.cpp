#include "base/child_process.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <new>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/check.h"
#include "base/diagnostic.h"

namespace lamina {

namespace {

// What the children take, for whoever watches over the process's memory.
struct Children {
  std::mutex mutex;
  std::vector<const std::atomic<std::uint64_t>*> bytes;
};
Children& children() {
  static Children all;
  return all;
}

// What the children took that have ended [s].
std::atomic<double> ended_seconds = 0;
thread_local double ended_seconds_of_thread = 0;

// The status of a child whose memory ended.
constexpr int kOutOfMemoryStatus = 112;

// From pipe() until the child's end of it is closed here. A child that another
// thread makes meanwhile would hold it open.
std::mutex pipe_mutex;

std::uint64_t peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// The child writes here what it takes, and keeps what it took at first.
std::atomic<std::uint64_t>* child_bytes = nullptr;
std::uint64_t first_bytes = 0;

// Writes it every 20 ms, as often as the parent looks. The kernel keeps the
// number, so this works where /proc may not be read.
void write_memory_now_and_then() {
  constexpr suseconds_t kPause = 20000;
  first_bytes = peak_memory();
  struct sigaction action {};
  action.sa_flags = SA_RESTART;
  action.sa_handler = [](int) { *child_bytes = peak_memory() - first_bytes; };
  ::sigaction(SIGALRM, &action, nullptr);
  sigset_t alarm;
  ::sigemptyset(&alarm);
  ::sigaddset(&alarm, SIGALRM);
  ::pthread_sigmask(SIG_UNBLOCK, &alarm, nullptr);
  const itimerval time{{0, kPause}, {0, kPause}};
  ::setitimer(ITIMER_REAL, &time, nullptr);
}

// Nothing that this process set up for itself is to run in the child.
void drop_handlers() {
  for (int signal = 1; signal < NSIG; ++signal) {
    if (signal != SIGPIPE) ::signal(signal, SIG_DFL);
  }
  std::set_terminate([] { ::_exit(1); });
  std::set_new_handler([] { ::_exit(kOutOfMemoryStatus); });
}

void drop_streams() {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (nothing < 0) {
      ::close(stream);
    } else {
      ::dup2(nothing, stream);
    }
  }
}

// Lowers what the process may take, or leaves what is less.
void limit(__rlimit_resource_t resource, rlim_t value) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_cur = std::min(now.rlim_cur, value);
  ::setrlimit(resource, &now);
}

unsigned processor_seconds(unsigned most) {
  rlimit now{};
  if (::getrlimit(RLIMIT_CPU, &now) != 0) return most;
  return static_cast<unsigned>(std::min<rlim_t>(now.rlim_cur, most));
}

double seconds_of(const rusage& usage) {
  constexpr double kMicrosecond = 1e-6;
  timeval time{};
  timeradd(&usage.ru_utime, &usage.ru_stime, &time);
  return static_cast<double>(time.tv_sec) +
         kMicrosecond * static_cast<double>(time.tv_usec);
}

// Whether so much processor time was taken, as exactly as the system keeps to
// its limit: of one second it has been seen to leave 0.12.
bool has_taken(const rusage& usage, unsigned most_seconds) {
  constexpr double kExactness = 0.2;
  return seconds_of(usage) >= most_seconds - kExactness;
}

[[noreturn]] void run_child(
    pid_t parent, int pipe, unsigned most_seconds,
    const std::function<void(const ChildOutput&)>& work) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  drop_handlers();
  drop_streams();
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, most_seconds);
  write_memory_now_and_then();
  work(ChildOutput(pipe));
  // Nothing of the parent's is to be cleaned up here.
  ::_exit(0);
}

[[noreturn]] void fail_without_process(int error) {
  if (error == ENOMEM) throw std::bad_alloc();
  throw Error(
      fmt::format("the system grants no further process, or no pipe to it "
                  "(ulimit -u, -n): {}",
                  std::strerror(error)));
}

// The given field of /proc/self/statm, which counts pages. Takes no memory.
std::uint64_t bytes_in_field(int field) {
  char text[256];
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t size = ::read(file, text, sizeof text - 1);
  ::close(file);
  text[std::max<ssize_t>(size, 0)] = '\0';
  char* next = text;
  std::uint64_t pages = 0;
  for (int i = 0; i <= field; ++i) pages = std::strtoull(next, &next, 10);
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

// A page that both processes see: what the child takes.
class ChildProcess::SharedPage {
 public:
  SharedPage() {
    void* const page = ::mmap(nullptr, sizeof *bytes_, PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) throw std::bad_alloc();
    bytes_ = new (page) std::atomic<std::uint64_t>(0);
    const std::lock_guard lock(children().mutex);
    children().bytes.push_back(bytes_);
  }
  ~SharedPage() {
    const std::lock_guard lock(children().mutex);
    std::erase(children().bytes, bytes_);
    ::munmap(bytes_, sizeof *bytes_);
  }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;

  std::atomic<std::uint64_t>* bytes() { return bytes_; }

 private:
  std::atomic<std::uint64_t>* bytes_ = nullptr;
};

void ChildOutput::write(const void* bytes, std::size_t size) const {
  const char* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = ::write(pipe_, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

ChildProcess::ChildProcess(const std::function<void(const ChildOutput&)>& work,
                           unsigned most_seconds)
    : page_(std::make_unique<SharedPage>()),
      most_seconds_(processor_seconds(most_seconds)) {
  const pid_t parent = ::getpid();
  std::unique_lock pipe_lock(pipe_mutex);
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) fail_without_process(errno);
  // Locked by this thread, and so unlocked in the copy, which may have children
  // of its own.
  std::unique_lock children_lock(children().mutex);
  process_ = ::fork();
  children_lock.unlock();
  if (process_ == 0) {
    pipe_lock.unlock();
    child_bytes = page_->bytes();
    run_child(parent, ends[1], most_seconds_, work);
  }
  const int error = errno;
  ::close(ends[1]);
  if (process_ < 0) {
    ::close(ends[0]);
    fail_without_process(error);
  }
  pipe_ = ends[0];
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    wait();
  }
  ::close(pipe_);
}

bool ChildProcess::read(void* bytes, std::size_t size) const {
  char* next = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t count = ::read(pipe_, next, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    next += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

ChildFault ChildProcess::wait() {
  // -1 would stand for any child.
  LAMINA_CHECK_EQ(process_ > 0, true);
  int status = 0;
  rusage usage{};
  pid_t ended = -1;
  do {
    ended = ::wait4(process_, &status, 0, &usage);
  } while (ended < 0 && errno == EINTR);
  process_ = -1;
  // Where the caller's program takes the statuses of all children, it is not
  // known.
  if (ended < 0) return ChildFault::kNone;
  ended_seconds += seconds_of(usage);
  ended_seconds_of_thread += seconds_of(usage);
  if (WIFSIGNALED(status)) {
    switch (WTERMSIG(status)) {
      case SIGXCPU:
        return ChildFault::kOutOfTime;
      case SIGKILL:  // by whomever, or by a hard limit of time
        return has_taken(usage, most_seconds_) ? ChildFault::kOutOfTime
                                               : ChildFault::kKilled;
      default:
        return ChildFault::kCrashed;
    }
  }
  switch (WEXITSTATUS(status)) {
    case 0:
      return ChildFault::kNone;
    case kOutOfMemoryStatus:
      return ChildFault::kOutOfMemory;
    default:
      return ChildFault::kCrashed;
  }
}

std::uint64_t memory_of_children() {
  const std::lock_guard lock(children().mutex);
  std::uint64_t sum = 0;
  for (const std::atomic<std::uint64_t>* bytes : children().bytes) {
    sum += *bytes;
  }
  return sum;
}

double seconds_of_children() { return ended_seconds; }

double thread_seconds_of_children() { return ended_seconds_of_thread; }

std::uint64_t resident_memory() { return bytes_in_field(1); }

std::uint64_t writable_memory() { return bytes_in_field(5); }

}  // namespace lamina
