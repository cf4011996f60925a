#include "serve/run/file_watcher.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "base/diagnostic.h"

namespace lamina::serve {
namespace {

namespace fs = std::filesystem;

// A tick of the clock of files, at most.
constexpr std::chrono::milliseconds kClockStep{10};

constexpr std::uint32_t kEvents = IN_CLOSE_WRITE | IN_MOVED_TO;

[[noreturn]] void fail() {
  throw FileError(fmt::format("Can't watch files: {}", std::strerror(errno)));
}

}  // namespace

fs::file_time_type FileWatcher::now() {
  return fs::file_time_type::clock::now() - kClockStep;
}

FileWatcher::FileWatcher()
    : inotify_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
  if (!inotify_) fail();
}

void FileWatcher::watch(const std::set<std::string>& files,
                        fs::file_time_type since) {
  names_.clear();
  for (const std::string& file : files) {
    watch_folder_of(file, file);
    std::error_code error;
    // A link is watched where it stands and where it leads.
    const fs::path target = fs::canonical(file, error);
    if (!error) watch_folder_of(target, file);
    const fs::file_time_type time = fs::last_write_time(file, error);
    if (!error && time > since && !files_.contains(file)) {
      changed_.insert(file);
    }
  }
  files_ = files;
}

std::set<std::string> FileWatcher::wait() {
  while (changed_.empty()) take_events(-1);
  while (take_events(kQuietMilliseconds)) {
  }
  return take_changes();
}

bool FileWatcher::look() {
  while (take_events(0)) {
  }
  return !changed_.empty();
}

std::set<std::string> FileWatcher::take_changes() {
  return std::exchange(changed_, {});
}

void FileWatcher::watch_folder_of(const fs::path& path,
                                  const std::string& file) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int id =
      ::inotify_add_watch(inotify_.descriptor(), folder.c_str(), kEvents);
  if (id >= 0) {
    names_[id][path.filename()] = file;
  } else if (errno != ENOENT && errno != EACCES) {
    fail();
  }
}

bool FileWatcher::take_events(int milliseconds) {
  pollfd ready = {inotify_.descriptor(), POLLIN, 0};
  if (::poll(&ready, 1, milliseconds) <= 0) return false;
  alignas(inotify_event) std::array<char, 1 << 14> buffer;
  const ssize_t size =
      ::read(inotify_.descriptor(), buffer.data(), buffer.size());
  bool is_ours = false;
  for (ssize_t i = 0; i < size;) {
    const auto& event =
        *reinterpret_cast<const inotify_event*>(buffer.data() + i);
    i += static_cast<ssize_t>(sizeof(inotify_event) + event.len);
    const auto folder = names_.find(event.wd);
    if (event.len == 0 || folder == names_.end()) continue;
    const auto name = folder->second.find(event.name);
    if (name == folder->second.end()) continue;
    changed_.insert(name->second);
    is_ours = true;
  }
  return is_ours;
}

}  // namespace lamina::serve
