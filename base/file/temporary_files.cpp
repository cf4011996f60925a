#include "base/file/temporary_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file/detail/planted_link.h"
#include "base/file/open_file.h"
#include "base/file/run_files.h"

namespace lamina {
namespace {

using Lock = std::lock_guard<std::timed_mutex>;

// --- Hidden names -----------------------------------------------------------

// Names have 255 bytes.
constexpr std::size_t kLongestShown = 200;
constexpr std::string_view kMark = ".lamina-";

std::string folder_that_holds(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string hidden_sibling(const std::string& path, int attempt) {
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  return fmt::format("{}.{}{}{}", path.substr(0, name),
                     path.substr(name, kLongestShown), kMark, attempt);
}

// A file, or a folder with the files that it holds. (No output has folders in
// it.)
void remove_all(const std::string& path) {
  if (::unlink(path.c_str()) == 0) return;
  std::error_code error;
  std::filesystem::directory_iterator entry(path, error);
  for (; !error && entry != std::filesystem::directory_iterator();
       entry.increment(error)) {
    ::unlink(entry->path().c_str());
  }
  ::rmdir(path.c_str());
}

// Whether this is, or is a folder that holds, what no ended run has left:
// something that this run reads, or folders.
bool holds_others(const std::string& path, const struct stat& status,
                  RunFiles* run) {
  if (run != nullptr && run->is_input(status)) return true;
  if (!S_ISDIR(status.st_mode)) return false;
  std::error_code error;
  std::filesystem::directory_iterator entry(path, error);
  for (; !error && entry != std::filesystem::directory_iterator();
       entry.increment(error)) {
    struct stat inside {};
    if (::lstat(entry->path().c_str(), &inside) != 0) continue;
    if (S_ISDIR(inside.st_mode)) return true;
    if (run != nullptr && run->is_input(inside)) return true;
  }
  return false;
}

void close_quietly(int& file) {
  const int error = errno;
  if (file >= 0) ::close(file);
  file = -1;
  errno = error;
}

// Removes a folder, and then closes it: a name that is not locked may be
// another run's by now. Works where no more files can be opened.
void remove_folder(int& folder, const std::string& path) {
  DIR* const entries = ::fdopendir(folder);
  if (entries != nullptr) {
    while (const dirent* entry = ::readdir(entries)) {
      ::unlinkat(folder, static_cast<const char*>(entry->d_name), 0);
    }
  }
  remove_all(path);
  if (entries != nullptr) {
    ::closedir(entries);
    folder = -1;
  }
  close_quietly(folder);
}

// Whether the lock is ours now, or files cannot be locked here.
bool lock(int file) {
  return ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

bool is_same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// Whether the open file is the one of that name. Once it is locked, only we may
// remove it.
bool stands_at(const std::string& path, const struct stat& open) {
  struct stat named = {};
  return ::lstat(path.c_str(), &named) == 0 && is_same_file(open, named);
}

// Removes what an ended run left under this name; false if it left nothing.
bool remove_abandoned(const std::string& path, RunFiles* run) {
  int file =
      ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  struct stat status = {};
  const bool is_abandoned =
      ::fstat(file, &status) == 0 && status.st_uid == ::geteuid() &&
      (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) &&
      !holds_others(path, status, run) &&
      ::flock(file, LOCK_EX | LOCK_NB) == 0 && stands_at(path, status);
  if (is_abandoned) remove_all(path);
  close_quietly(file);
  return is_abandoned && ::lstat(path.c_str(), &status) != 0;
}

// Locks what was just made under this name. Returns it, or −1 (errno): EEXIST
// where another run was faster, to which it looked abandoned.
int keep(int file, const std::string& path) {
  struct stat open = {};
  struct stat named = {};
  int error = EEXIST;
  if (lock(file)) {
    if (::fstat(file, &open) != 0 || ::lstat(path.c_str(), &named) != 0) {
      if (errno != ENOENT) error = errno;
    } else if (is_same_file(open, named)) {
      return file;
    }
  }
  if (error != EEXIST) std::remove(path.c_str());
  ::close(file);
  errno = error;
  return -1;
}

// Makes something under a hidden name beside `target`, locked.
//
// name   the name it got
// names  gets it too, before it stands for anything: nothing can fail between
// run    the files of the run, which stay; or null
// make   makes it and returns it open, or −1 (errno)
template <typename Make>
int make_hidden(const std::string& target, std::string& name,
                std::vector<std::string>& names, RunFiles* run,
                const Make& make) {
  for (int attempt = 0;;) {
    name = hidden_sibling(target, attempt);
    names.push_back(name);
    const int made = make(name.c_str());
    const int file = made < 0 ? made : keep(made, name);
    if (file >= 0) return file;
    if (errno != EEXIST) {
      names.pop_back();
      name.clear();
      return -1;
    }
    if (!remove_abandoned(name, run)) ++attempt;
    names.pop_back();
  }
}

template <mode_t kMode>
int make_file(const char* path) {
  return ::open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
}

int make_named_folder(const char* path) {
  if (::mkdir(path, 0777) != 0) return -1;
  const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0 && errno == ENOENT) {
    errno = EEXIST;  // another run was faster, to which it looked abandoned
  } else if (folder < 0) {
    const int error = errno;
    ::rmdir(path);
    errno = error;
  }
  return folder;
}

// --- Files without a name ---------------------------------------------------

int open_nameless_in(const std::string& folder) {
  return ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
}

bool link_file(int file, const std::string& path) {
  std::array<char, 32> itself{};
  std::snprintf(itself.data(), itself.size(), "/proc/self/fd/%d", file);
  return ::linkat(AT_FDCWD, itself.data(), AT_FDCWD, path.c_str(),
                  AT_SYMLINK_FOLLOW) == 0;
}

// Gives a new file or folder owner, group and permissions of the one that it
// replaces, as far as the system allows, but not of what a stranger left there.
// Where the group cannot be kept, the new one gets the permissions of all
// others: it must not see what it did not before.
void take_after(int file, const OutputPlace& target) {
  if (!target.there || is_planted_at(target.path, *target.there)) return;
  const struct stat& replaced = *target.there;
  constexpr auto kSame = static_cast<uid_t>(-1);
  const bool has_group =
      ::fchown(file, replaced.st_uid, replaced.st_gid) == 0 ||
      ::fchown(file, kSame, replaced.st_gid) == 0;
  mode_t mode = replaced.st_mode & 0777;
  if (!has_group) mode = (mode & 0707) | (mode & 0007) << 3;
  ::fchmod(file, mode);
}

// Network file systems report at the end of the writing that the disk is full.
// Returns 0 or the error number.
int end_writing(int file) {
  const int copy = ::fcntl(file, F_DUPFD_CLOEXEC, 0);
  return copy >= 0 && ::close(copy) == 0 ? 0 : errno;
}

}  // namespace

bool is_hidden_name(std::string_view path) {
  while (!path.empty()) {
    const std::string_view name = path.substr(0, path.find('/'));
    path.remove_prefix(std::min(name.size() + 1, path.size()));
    const std::size_t mark = name.rfind(kMark);
    if (!name.starts_with('.') || mark == std::string_view::npos) continue;
    const std::string_view number = name.substr(mark + kMark.size());
    if (!number.empty() &&
        number.find_first_not_of("0123456789") == std::string_view::npos) {
      return true;
    }
  }
  return false;
}

int TemporaryFiles::open_nameless() {
  const std::string folder = access_.scratch_folder();
  int file = open_nameless_in(folder);
  if (file >= 0) return file;
  // It has a hidden name for a moment.
  std::string name;
  const Lock lock(mutex_);
  file = make_hidden(folder + "/output", name, paths_, access_.run_files(),
                     make_file<0600>);
  if (file >= 0) {
    ::unlink(name.c_str());
    forget(name);
    return file;
  }
  // Without such a folder, use memory.
  file = ::memfd_create("lamina", MFD_CLOEXEC);
  if (file >= 0) in_memory_.push_back(file);
  return file;
}

std::uint64_t TemporaryFiles::bytes_in_memory() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return bytes_in_memory_;
  bytes_in_memory_ = 0;
  for (const int file : in_memory_) {
    constexpr std::uint64_t kBlock = 512;  // of st_blocks, everywhere
    struct stat status = {};
    if (::fstat(file, &status) == 0) {
      bytes_in_memory_ += kBlock * static_cast<std::uint64_t>(status.st_blocks);
    }
  }
  return bytes_in_memory_;
}

void TemporaryFiles::discard_all() {
  // The lock is never given back: no output can be committed any more.
  if (!mutex_.try_lock_for(std::chrono::seconds(1))) return;
  for (const std::string& path : paths_) remove_all(path);
}

void TemporaryFiles::forget(const std::string& path) {
  std::erase(paths_, path);
}

// --- Files ------------------------------------------------------------------

TemporaryFiles::File TemporaryFiles::open_file(const std::string& target) {
  const Lock lock(mutex_);
  remove_abandoned(hidden_sibling(target, 0), access_.run_files());
  File file;
  file.file = open_nameless_in(folder_that_holds(target));
  if (file.file >= 0) return file;
  file.file = make_hidden(target, file.name, paths_, access_.run_files(),
                          make_file<0666>);
  return file;
}

// Gives a file that has no name a hidden one.
bool TemporaryFiles::give_name(File& file, const std::string& target) {
  lock(file.file);
  for (int attempt = 0;;) {
    file.name = hidden_sibling(target, attempt);
    paths_.push_back(file.name);
    if (link_file(file.file, file.name)) return true;
    const int error = errno;
    paths_.pop_back();
    if (error != EEXIST) break;
    if (!remove_abandoned(file.name, access_.run_files())) ++attempt;
  }
  file.name.clear();
  // Some systems do not allow that: a copy has a name from the start.
  File copy;
  copy.file = make_hidden(target, copy.name, paths_, access_.run_files(),
                          make_file<0666>);
  if (copy.file < 0) return false;
  std::swap(file, copy);
  int error = copy_bytes(copy.file, file.file);
  if (error == 0) error = end_writing(file.file);
  ::close(copy.file);
  errno = error;
  return error == 0;
}

bool TemporaryFiles::put_at(File& file, const std::string& target) {
  if (file.name.empty()) {
    // A name that is free is taken in one step.
    if (link_file(file.file, target)) return true;
    if (!give_name(file, target)) return false;
  }
  if (::rename(file.name.c_str(), target.c_str()) != 0) return false;
  forget(file.name);
  file.name.clear();
  return true;
}

bool TemporaryFiles::commit_file(File& file, const OutputPlace& target,
                                 const std::string& path) {
  const Lock lock(mutex_);
  RunFiles* const run = access_.run_files();
  std::vector<std::uint64_t> before;
  if (run != nullptr) {
    before = run->require_unread(path, target.there, access_);
  }
  take_after(file.file, target);
  errno = end_writing(file.file);
  if (errno != 0 || !put_at(file, target.path)) return false;
  struct stat now {};
  if (run != nullptr && ::fstat(file.file, &now) == 0) {
    run->note_written(before, path, now, access_);
  }
  return true;
}

void TemporaryFiles::discard_file(File& file) {
  const Lock lock(mutex_);
  if (!file.name.empty()) {
    // While it is locked: a free name may be another run's by now.
    ::unlink(file.name.c_str());
    forget(file.name);
    file.name.clear();
  }
  std::erase(in_memory_, file.file);
  close_quietly(file.file);
}

// --- Folders ----------------------------------------------------------------

TemporaryFiles::Folder TemporaryFiles::make_folder(const std::string& path) {
  const Lock lock(mutex_);
  Folder folder;
  folder.place = access_.find_output(path);
  errno = folder.place.error;
  if (errno != 0) return folder;
  folder.lock = make_hidden(folder.place.path, folder.path, paths_,
                            access_.run_files(), make_named_folder);
  return folder;
}

int TemporaryFiles::open_file_in(const Folder& folder,
                                 const std::string& name) {
  // Under the lock: a file that came while discard_all() empties the folder
  // would keep it.
  const Lock lock(mutex_);
  return ::openat(folder.lock, name.c_str(),
                  O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

bool TemporaryFiles::commit_folder(Folder& folder, const std::string& path) {
  const Lock lock(mutex_);
  const OutputPlace target = access_.find_output(path);
  errno = target.error;
  if (errno != 0) return false;
  RunFiles* const run = access_.run_files();
  std::vector<std::uint64_t> before;
  if (run != nullptr) before = run->require_unread(path, target.there, access_);
  take_after(folder.lock, target);
  // A name that is free, or an empty folder, is taken by a rename. Else the
  // two change places at once, where the file system can do that.
  if (::rename(folder.path.c_str(), target.path.c_str()) != 0) {
    if (errno != ENOTEMPTY && errno != EEXIST) return false;
    if (::renameat2(AT_FDCWD, folder.path.c_str(), AT_FDCWD,
                    target.path.c_str(), RENAME_EXCHANGE) != 0) {
      return false;
    }
    remove_all(folder.path);
  }
  forget(folder.path);
  folder.path.clear();
  struct stat now {};
  if (run != nullptr && ::fstat(folder.lock, &now) == 0) {
    run->note_written(before, path, now, access_);
  }
  close_quietly(folder.lock);
  return true;
}

void TemporaryFiles::discard_folder(Folder& folder) {
  if (folder.path.empty()) return;
  const Lock lock(mutex_);
  remove_folder(folder.lock, folder.path);
  forget(folder.path);
  folder.path.clear();
}

}  // namespace lamina
