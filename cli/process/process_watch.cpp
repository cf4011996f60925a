#include "cli/process/process_watch.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <sys/resource.h>

#include "base/child_process.h"
#include "cli/process/machine_memory.h"

namespace lamina::cli {
namespace {

constexpr std::chrono::milliseconds kPause{20};

// What may be asked for beyond what is in use: stacks and arenas of threads,
// room at the end of arrays.
std::uint64_t with_room(std::uint64_t bytes) {
  return bytes + bytes / 4 + (std::uint64_t{512} << 20);
}

std::string error_line(const std::string& prefix, const std::string& words) {
  return fmt::format("{}error: {}\n", prefix, words);
}

}  // namespace

void ProcessWatch::time_parts() {
  const std::lock_guard lock(mutex_);
  timed_.clear();
}

ProcessWatch::Part::Part(ProcessWatch& watch, const std::string& name)
    : watch_(watch) {
  const std::lock_guard lock(watch_.mutex_);
  timed_ = &watch_.timed_.emplace_back(Timed{name, Clock::now()});
}

ProcessWatch::Part::~Part() {
  const std::lock_guard lock(watch_.mutex_);
  watch_.timed_.remove_if([&](const Timed& t) { return &t == timed_; });
}

void ProcessWatch::reserve(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  // Before these are made: the first look takes what is there into account.
  if (most_bytes_ == 0) begin_to_look(resident_memory());
  if (writable_bytes_ != 0) writable_bytes_ += bytes;
  limit_writable_memory();
}

std::chrono::nanoseconds ProcessWatch::pause() {
  const std::lock_guard lock(mutex_);
  std::chrono::nanoseconds pause = kPause;
  for (const Timed& timed : timed_) {
    const std::chrono::duration<double> left =
        timed.begin + std::chrono::duration<double>(limits_.seconds) -
        Clock::now();
    if (left < pause) {
      pause = std::chrono::duration_cast<std::chrono::nanoseconds>(left);
    }
  }
  return std::max<std::chrono::nanoseconds>(pause,
                                            std::chrono::milliseconds(1));
}

std::string ProcessWatch::look(std::uint64_t besides) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  for (const Timed& timed : timed_) {
    if (now - timed.begin < std::chrono::duration<double>(limits_.seconds)) {
      continue;
    }
    return error_line(
        timed.name,
        fmt::format("out of time: this takes more than {:g} s; --max-time "
                    "gives it more",
                    limits_.seconds));
  }
  const std::uint64_t resident = resident_memory();
  if (most_bytes_ == 0) begin_to_look(resident);
  if (resident + besides <= most_bytes_) return {};
  return error_line(
      names_under_way(),
      fmt::format("out of memory: {} are in use, more than the limit of {}; "
                  "--max-memory gives it more",
                  memory_size_text(resident + besides),
                  memory_size_text(most_bytes_)));
}

void ProcessWatch::begin_to_look(std::uint64_t resident) {
  constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();
  most_bytes_ = limits_.memory.bytes;
  if (most_bytes_ == 0) {
    const std::uint64_t machine = machine_memory();
    if (machine == 0) {
      most_bytes_ = kUnknown;
      return;
    }
    most_bytes_ = static_cast<std::uint64_t>(
        std::max(1.0, limits_.memory.share * static_cast<double>(machine)));
  }
  const std::uint64_t writable = writable_memory();
  rlimit limit{};
  if (writable == 0 || ::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  granted_bytes_ = limit.rlim_cur;
  // What has been asked for and is not in use, such as a stack, stays out.
  const std::uint64_t unused = writable - std::min(writable, resident);
  writable_bytes_ = unused + with_room(most_bytes_);
  limit_writable_memory();
}

// Has the system refuse what goes far beyond the limit at once.
void ProcessWatch::limit_writable_memory() const {
  rlimit limit{};
  if (writable_bytes_ == 0 || ::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(granted_bytes_, writable_bytes_);
  ::setrlimit(RLIMIT_DATA, &limit);
}

std::string ProcessWatch::names_under_way() {
  std::string names;
  for (const Timed& timed : timed_) {
    std::string_view name = timed.name;
    name.remove_suffix(std::min<std::size_t>(name.size(), 2));  // ": "
    if (!names.empty()) names += ", ";
    names += name;
  }
  return names.empty() ? names : names + ": ";
}

std::string out_of_memory_text() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    return fmt::format(
        "out of memory: the system grants {} of addresses (ulimit -v)",
        memory_size_text(limit.rlim_cur));
  }
  if (::getrlimit(RLIMIT_DATA, &limit) == 0 &&
      limit.rlim_cur != RLIM_INFINITY) {
    return limit.rlim_cur == limit.rlim_max
               ? fmt::format("out of memory: the system grants {} (ulimit -d)",
                             memory_size_text(limit.rlim_cur))
               : "out of memory: more was asked for at once than the limit of "
                 "--max-memory leaves";
  }
  return "out of memory";
}

std::string memory_size_text(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  constexpr double kStep = 1024;
  if (size < kStep) return fmt::format("{} bytes", bytes);
  if (size < kStep * kStep) return fmt::format("{:.4g} KiB", size / kStep);
  if (size < 10 * kStep * kStep * kStep) {
    return fmt::format("{:.0f} MiB", size / kStep / kStep);
  }
  return fmt::format("{:.1f} GiB", size / kStep / kStep / kStep);
}

}  // namespace lamina::cli
