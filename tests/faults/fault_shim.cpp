// Makes the k-th of some calls fail: preloaded into a program under test.
//
//   LAMINA_FAULT="write,pwrite 3 errno 28"     the third call finds no room
//   LAMINA_FAULT="malloc,calloc 17+ errno 12"  so does each from the 17th on
//   LAMINA_FAULT="linkat 1 kill 9"             dies where the call would be
//   LAMINA_FAULT="read 2 sh : > design.stl"    the world changes before it
//   LAMINA_FAULT_COUNT=FILE                    how many calls there were
//
// A name stands for its twin as well that takes places beyond 2 GiB: "open" for
// open64().
//
// Calls are counted from the program's first function on, over all threads.
// They are those of the program and its libraries; what the C library calls by
// itself is not seen. A close() that fails has closed all the same, as in
// Linux. A crash tells on standard error where it was.

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include <dirent.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

// What the C library calls them.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace {

enum class Action { kNone, kErrno, kKill, kShell };

struct Fault {
  const char* names = "";
  std::size_t names_length = 0;
  long first = 0;
  bool goes_on = false;
  Action action = Action::kNone;
  int number = 0;  // errno or signal
  const char* command = "";
};

Fault fault;
bool is_ready = false;
std::atomic<long> count{0};
thread_local bool is_inside = false;  // of the shim's own calls

bool is_named(const char* name) {
  std::size_t length = std::strlen(name);
  if (std::strcmp(name + length - 2, "64") == 0) length -= 2;
  const char* at = fault.names;
  const char* const end = fault.names + fault.names_length;
  while (at < end) {
    const void* comma =
        std::memchr(at, ',', static_cast<std::size_t>(end - at));
    const char* stop = comma ? static_cast<const char*>(comma) : end;
    if (static_cast<std::size_t>(stop - at) == length &&
        std::memcmp(at, name, length) == 0) {
      return true;
    }
    at = stop + 1;
  }
  return false;
}

void run_command() {
  ::unsetenv("LD_PRELOAD");
  const int ignored = std::system(fault.command);
  static_cast<void>(ignored);
}

// Whether this call must fail; errno says how.
bool must_fail(const char* name) {
  if (!is_ready || is_inside || !is_named(name)) return false;
  const long number = ++count;
  if (number != fault.first && !(fault.goes_on && number > fault.first)) {
    return false;
  }
  is_inside = true;
  if (fault.action == Action::kKill) ::kill(::getpid(), fault.number);
  if (fault.action == Action::kShell) run_command();
  is_inside = false;
  if (fault.action == Action::kErrno) errno = fault.number;
  return fault.action == Action::kErrno;
}

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

// Tells on standard error in which libraries the program crashes.
void tell_crash(int signal) {
  is_inside = true;
  std::array<void*, 12> frames{};
  const int depth = ::backtrace(frames.data(), static_cast<int>(frames.size()));
  ::backtrace_symbols_fd(frames.data(), depth, STDERR_FILENO);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

[[gnu::constructor]] void read_environment() {
  const char* text = std::getenv("LAMINA_FAULT");
  if (text == nullptr) return;
  void* frame = nullptr;
  ::backtrace(&frame, 1);  // takes memory the first time
  for (const int signal : {SIGSEGV, SIGABRT, SIGTRAP}) {
    ::signal(signal, tell_crash);
  }
  fault.names = text;
  fault.names_length = std::strcspn(text, " ");
  char* at = nullptr;
  fault.first = std::strtol(text + fault.names_length, &at, 10);
  fault.goes_on = *at == '+';
  at += std::strcspn(at, " ") + 1;
  if (std::strncmp(at, "errno ", 6) == 0) fault.action = Action::kErrno;
  if (std::strncmp(at, "kill ", 5) == 0) fault.action = Action::kKill;
  if (std::strncmp(at, "sh ", 3) == 0) fault.action = Action::kShell;
  at += std::strcspn(at, " ") + 1;
  fault.number = std::atoi(at);
  fault.command = at;
  is_ready = true;
}

[[gnu::destructor]] void write_count() {
  is_ready = false;
  const char* path = std::getenv("LAMINA_FAULT_COUNT");
  if (path == nullptr) return;
  if (std::FILE* file = std::fopen(path, "w")) {
    std::fprintf(file, "%ld\n", count.load());
    std::fclose(file);
  }
}

}  // namespace

// next_NAME(): the function that the C library has for this one. It is found
// before main(): later the loader's lock may be another thread's for good, as
// where memory ends while GLib is loaded.
#define LAMINA_NEXT(result, name, parameters)                  \
  static std::add_pointer_t<result parameters> next_##name() { \
    static auto* const call = next<result parameters>(#name);  \
    return call;                                               \
  }                                                            \
  [[maybe_unused]] static auto* const found_##name = next_##name();

// One function that fails with `failed` and else does what the next one does.
#define LAMINA_CALL(result, name, failed, parameters, arguments, ...) \
  LAMINA_NEXT(result, name, parameters)                               \
  extern "C" result name parameters __VA_ARGS__ {                     \
    if (must_fail(#name)) return failed;                              \
    return next_##name() arguments;                                   \
  }

LAMINA_CALL(ssize_t, write, -1, (int f, const void* b, size_t n), (f, b, n))
LAMINA_CALL(ssize_t, pwrite, -1, (int f, const void* b, size_t n, off_t o),
            (f, b, n, o))
LAMINA_CALL(ssize_t, pwrite64, -1, (int f, const void* b, size_t n, off_t o),
            (f, b, n, o))
LAMINA_CALL(ssize_t, read, -1, (int f, void* b, size_t n), (f, b, n))
LAMINA_CALL(ssize_t, pread, -1, (int f, void* b, size_t n, off_t o),
            (f, b, n, o))
LAMINA_CALL(ssize_t, pread64, -1, (int f, void* b, size_t n, off_t o),
            (f, b, n, o))
LAMINA_CALL(off_t, lseek, -1, (int f, off_t o, int w), (f, o, w), noexcept)
LAMINA_CALL(off_t, lseek64, -1, (int f, off_t o, int w), (f, o, w), noexcept)
LAMINA_CALL(int, flock, -1, (int f, int o), (f, o), noexcept)
LAMINA_CALL(int, mkdir, -1, (const char* p, mode_t m), (p, m), noexcept)
LAMINA_CALL(int, mkostemp, -1, (char* p, int m), (p, m))
LAMINA_CALL(int, rename, -1, (const char* a, const char* b), (a, b), noexcept)
LAMINA_CALL(int, renameat2, -1,
            (int x, const char* a, int y, const char* b, unsigned int m),
            (x, a, y, b, m), noexcept)
LAMINA_CALL(int, linkat, -1,
            (int x, const char* a, int y, const char* b, int m),
            (x, a, y, b, m), noexcept)
LAMINA_CALL(int, stat, -1, (const char* p, struct stat* s), (p, s), noexcept)
LAMINA_CALL(int, fstat, -1, (int f, struct stat* s), (f, s), noexcept)
LAMINA_CALL(char*, realpath, nullptr, (const char* p, char* r), (p, r),
            noexcept)
LAMINA_CALL(DIR*, opendir, nullptr, (const char* p), (p))
LAMINA_CALL(FILE*, fopen, nullptr, (const char* p, const char* m), (p, m))
LAMINA_CALL(FILE*, fopen64, nullptr, (const char* p, const char* m), (p, m))
LAMINA_CALL(int, memfd_create, -1, (const char* p, unsigned m), (p, m),
            noexcept)
LAMINA_CALL(void*, mmap, MAP_FAILED,
            (void* p, size_t n, int r, int m, int f, off_t o),
            (p, n, r, m, f, o), noexcept)
LAMINA_CALL(void*, mmap64, MAP_FAILED,
            (void* p, size_t n, int r, int m, int f, off_t o),
            (p, n, r, m, f, o), noexcept)
LAMINA_CALL(void*, dlopen, nullptr, (const char* p, int m), (p, m), noexcept)
LAMINA_CALL(pid_t, fork, -1, (), (), noexcept)
LAMINA_CALL(int, execvp, -1, (const char* p, char* const* a), (p, a), noexcept)
LAMINA_CALL(int, pthread_create, EAGAIN,
            (pthread_t * t, const pthread_attr_t* a, void* (*f)(void*),
             void* x),
            (t, a, f, x), noexcept)

LAMINA_NEXT(int, close, (int))

extern "C" int close(int file) {
  const bool fails = must_fail("close");
  const int error = errno;
  const int result = next_close()(file);
  if (!fails) return result;
  errno = error;
  return -1;
}

LAMINA_NEXT(void*, mremap, (void*, size_t, size_t, int, ...))

extern "C" void* mremap(void* p, size_t n, size_t m, int flags, ...) noexcept {
  if (must_fail("mremap")) return MAP_FAILED;
  return next_mremap()(p, n, m, flags);
}

// Calls whose last argument is there only at times.
#define LAMINA_OPEN(name, parameters, ...)                        \
  LAMINA_NEXT(int, name, parameters)                              \
  extern "C" int name parameters {                                \
    if (must_fail(#name)) return -1;                              \
    va_list list;                                                 \
    va_start(list, flags);                                        \
    const mode_t mode =                                           \
        flags & (O_CREAT | O_TMPFILE) ? va_arg(list, mode_t) : 0; \
    va_end(list);                                                 \
    return next_##name()(__VA_ARGS__, flags, mode);               \
  }

LAMINA_OPEN(open, (const char* path, int flags, ...), path)
LAMINA_OPEN(open64, (const char* path, int flags, ...), path)
LAMINA_OPEN(openat, (int at, const char* path, int flags, ...), at, path)
LAMINA_OPEN(openat64, (int at, const char* path, int flags, ...), at, path)

#define LAMINA_FCNTL(name)                          \
  LAMINA_NEXT(int, name, (int, int, ...))           \
  extern "C" int name(int file, int command, ...) { \
    if (must_fail(#name)) return -1;                \
    va_list list;                                   \
    va_start(list, command);                        \
    void* const argument = va_arg(list, void*);     \
    va_end(list);                                   \
    return next_##name()(file, command, argument);  \
  }

LAMINA_FCNTL(fcntl)
LAMINA_FCNTL(fcntl64)

// --- Memory: all one kind of call --------------------------------------------

extern "C" void* malloc(std::size_t size) noexcept {
  return must_fail("malloc") ? nullptr : __libc_malloc(size);
}
extern "C" void* calloc(std::size_t n, std::size_t size) noexcept {
  return must_fail("malloc") ? nullptr : __libc_calloc(n, size);
}
extern "C" void* realloc(void* block, std::size_t size) noexcept {
  return must_fail("malloc") ? nullptr : __libc_realloc(block, size);
}
extern "C" void* memalign(std::size_t unit, std::size_t size) noexcept {
  return must_fail("malloc") ? nullptr : __libc_memalign(unit, size);
}
extern "C" void* aligned_alloc(std::size_t unit, std::size_t size) noexcept {
  return must_fail("malloc") ? nullptr : __libc_memalign(unit, size);
}
extern "C" int posix_memalign(void** block, std::size_t unit,
                              std::size_t size) noexcept {
  if (must_fail("malloc")) return ENOMEM;
  *block = __libc_memalign(unit, size);
  return *block == nullptr ? ENOMEM : 0;
}
