#include "cli/commands/watch.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "base/file/open_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "cli/process/exit_status.h"
#include "cli/report/run_report.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

// The steps of one save are at most so far apart.
constexpr int kQuietMilliseconds = 100;

constexpr std::uint32_t kEvents = IN_CLOSE_WRITE | IN_MOVED_TO;

[[noreturn]] void fail() {
  throw FileError(fmt::format("Can't watch files: {}", std::strerror(errno)));
}

// Waits until a file changes.
//
// Editors write a file in place, or write another one and rename it over the
// first, or delete it and write it anew. All of this shows in the file's
// folder. So folders are watched for files that were closed after writing or
// moved in. One save can be several of these events; a change is reported when
// no more of them have come for a moment.
class FileWatcher {
 public:
  // Throws FileError where the system cannot watch.
  FileWatcher() : inotify_(::inotify_init1(IN_CLOEXEC)) {
    if (!inotify_) fail();
  }

  // Watches `files` from now on, and no others. They need not exist yet, but
  // their folders must. A file that is new among them and was written after
  // `since` counts as changed.
  void watch(const std::set<std::string>& files, fs::file_time_type since) {
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

  // Waits for a change. Returns the changed files, by the names given.
  std::set<std::string> wait() {
    while (changed_.empty()) take_events(-1);
    while (take_events(kQuietMilliseconds)) {
    }
    return std::exchange(changed_, {});
  }

 private:
  void watch_folder_of(const fs::path& path, const std::string& file) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const int id =
        ::inotify_add_watch(inotify_.descriptor(), folder.c_str(), kEvents);
    if (id >= 0) {
      names_[id][path.filename()] = file;
    } else if (errno != ENOENT && errno != EACCES) {
      fail();
    }
  }

  // Takes the next events, for which it waits at most so long (negative:
  // endlessly). Returns whether one was of a watched file.
  bool take_events(int milliseconds) {
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

  OpenFile inotify_;
  std::set<std::string> files_;
  std::set<std::string> changed_;
  // From a folder's watch and a name in it to the file by the name given.
  std::map<int, std::map<std::string, std::string>> names_;
};

// The times of files come from a clock that ticks this seldom, at most.
constexpr std::chrono::milliseconds kClockStep{10};

// The files that are known before the compilation.
std::set<std::string> given_files(const compiler::Request& request) {
  std::set<std::string> files = {request.design.path};
  if (!request.design.parameter_file.empty())
    files.insert(request.design.parameter_file);
  for (const std::string& profile :
       {request.output.printer, request.output.material,
        request.output.metal}) {
    if (fs::is_regular_file(profile)) files.insert(profile);
  }
  return files;
}

std::string change_line(const std::set<std::string>& files) {
  std::set<std::string> names;
  for (const std::string& file : files) {
    names.insert(on_one_line(shown_path(file)));
  }
  return fmt::format("{:%H:%M:%S} {} changed",
                     fmt::localtime(std::time(nullptr)),
                     fmt::join(names, ", "));
}

// Adds the files on which the output was found to depend. Returns whether the
// compilation ended well.
bool compile_once(const compiler::Request& request, const Closing& closing,
                  bool is_quiet, const Context& context,
                  std::set<std::string>& files) {
  const ProcessWatch::Part timed(context.watch, "");
  const double earlier_seconds = process_seconds();
  context.file_access().run_files()->begin_again(context.file_access());
  Session session(request, is_quiet, context);
  const int status = session.run(
      [&] { return compile_and_report(session, closing, earlier_seconds); });
  const compiler::Compilation& compilation = session.compilation;
  files.insert(compilation.loader.files().begin(),
               compilation.loader.files().end());
  files.insert(compilation.tree.files.begin(), compilation.tree.files.end());
  return status == kDone;
}

}  // namespace

void compile_and_watch(const compiler::Request& request, const Closing& closing,
                       bool is_quiet, const Context& context) {
  context.watch.time_parts();
  FileWatcher watcher;
  Terminal terminal(is_quiet);
  std::set<std::string> watched = given_files(request);
  watcher.watch(watched, fs::file_time_type::max());
  while (true) {
    const auto begin = fs::file_time_type::clock::now() - kClockStep;
    std::set<std::string> files = given_files(request);
    const bool is_done =
        compile_once(request, closing, is_quiet, context, files);
    // A design that failed half way does not know all that it depends on.
    if (!is_done) files.insert(watched.begin(), watched.end());
    watched = files;
    watcher.watch(watched, begin);
    terminal.say(fmt::format("watching {}; Ctrl-C ends",
                             counted(watched.size(), "file")));
    terminal.say(change_line(watcher.wait()));
  }
}

}  // namespace lamina::cli
