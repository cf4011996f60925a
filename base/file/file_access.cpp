#include "base/file/file_access.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <system_error>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/fs.h>
#include <linux/magic.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "base/file/detail/confined_walk.h"
#include "base/file/detail/planted_link.h"

namespace lamina {

namespace fs = std::filesystem;

namespace {

using State = Destination::State;

PermittedFolder open_folder(const std::string& path) {
  std::error_code error;
  PermittedFolder folder;
  folder.file =
      OpenFile(::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  int fault = folder.file ? 0 : errno;
  const fs::path without_links = fs::canonical(path, error);
  if (fault == 0) fault = error.value();
  check_machine(path, fault);
  if (fault != 0) {
    throw AccessError(
        fmt::format("Can't use folder '{}': {}", path, std::strerror(fault)));
  }
  folder.given_parts = parts_of(fs::absolute(path, error));
  folder.parts = parts_of(without_links);
  return folder;
}

[[noreturn]] void refuse(std::string_view written, std::string_view fault,
                         SourceRange range) {
  throw AccessError(fmt::format("'{}' {}", written, fault), range);
}

constexpr std::string_view kOutside = "is outside of --root";

// The path of an entry of an open folder.
std::string path_in(const OpenFile& folder, const std::string& name) {
  return fmt::format("/proc/self/fd/{}/{}", folder.descriptor(), name);
}

// Reads all bytes of a file that may have failed to open (errno says why).
std::optional<std::string> read_open(const OpenFile& file,
                                     const std::string& path) {
  auto bytes = file ? file.read_all() : std::nullopt;
  if (!bytes) check_machine(path, errno);
  return bytes;
}

// Files that the kernel makes up as it is asked: they show processes and the
// machine.
bool is_of_kernel(const OpenFile& file) {
  struct statfs system {};
  return ::fstatfs(file.descriptor(), &system) != 0 ||
         system.f_type == PROC_SUPER_MAGIC || system.f_type == SYSFS_MAGIC;
}

bool is_a_symlink(const fs::path& path) {
  std::error_code error;
  return fs::is_symlink(fs::symlink_status(path, error));
}

// The path without links and dots, and in words behind what is not there. Links
// that lead to what is not there are followed, too.
fs::path without_links(const std::string& path) {
  std::error_code error;
  // Where not even the first part is there, only what is absolute becomes so.
  fs::path found = fs::weakly_canonical(fs::absolute(path, error), error);
  for (int links = 0; links < kMostLinks; ++links) {
    fs::path begun;
    auto part = found.begin();
    while (part != found.end() && !is_a_symlink(begun / *part))
      begun /= *part++;
    if (part == found.end()) break;
    fs::path target = begun / fs::read_symlink(begun / *part, error);
    while (++part != found.end()) target /= *part;
    found = fs::weakly_canonical(target, error);
  }
  return found;
}

// The path that a rename must take: that of the file itself, behind symbolic
// links.
std::string follow_links(const std::string& path) {
  const std::unique_ptr<char, void (*)(void*)> resolved(
      ::realpath(path.c_str(), nullptr), ::free);
  if (!resolved && errno == ENOMEM) throw std::bad_alloc();
  if (resolved) return resolved.get();
  return is_a_symlink(path) ? without_links(path).string() : path;
}

bool begins_with(const std::vector<std::string>& parts,
                 const std::vector<std::string>& beginning) {
  return parts.size() >= beginning.size() &&
         std::equal(beginning.begin(), beginning.end(), parts.begin());
}

}  // namespace

FileAccess FileAccess::within(const Limits& limits) {
  FileAccess access;
  access.refuses_data_ = limits.refuses_data;
  if (limits.root.empty()) return access;
  if (::access("/proc/self/fd", F_OK) != 0) {
    throw AccessError("--root needs /proc, which is not there");
  }
  Folders folders;
  folders.push_back(open_folder(limits.root));
  for (const std::string& folder : limits.readable) {
    folders.push_back(open_folder(folder));
  }
  access.folders_ = std::make_shared<const Folders>(std::move(folders));
  return access;
}

FileAccess FileAccess::none() {
  FileAccess access;
  access.folders_ = std::make_shared<const Folders>();
  return access;
}

void check_machine(const std::string& path, int error) {
  switch (error) {
    case ESTALE:
      throw FileError(fmt::format(
          "Can't read file '{}': it changed while it was read.", path));
    case ENOMEM:
      throw std::bad_alloc();
    case EIO:
    case ENOSPC:
    case EMFILE:
    case ENFILE:
      throw FileError(
          fmt::format("Can't read file '{}': {}.", path, std::strerror(error)));
    default:
      return;
  }
}

std::vector<int> FileAccess::folder_descriptors() const {
  std::vector<int> descriptors;
  if (!is_confined()) return descriptors;
  for (const PermittedFolder& folder : *folders_) {
    descriptors.push_back(folder.file.descriptor());
  }
  return descriptors;
}

Destination FileAccess::find(const std::string& path) const {
  Destination found = walk(*folders_, path);
  check_machine(path, found.error);
  return found;
}

Destination FileAccess::find_in_root(const std::string& path) const {
  const std::span all(*folders_);
  return walk(all.first(std::min<std::size_t>(all.size(), 1)), path);
}

// --- Judging ----------------------------------------------------------------

bool FileAccess::allows(const std::string& path) const {
  return !is_confined() || find(path).state != State::kOutside;
}

void FileAccess::require(const std::string& path, std::string_view written,
                         SourceRange range, FileUse use) const {
  if (use == FileUse::kData && refuses_data_) {
    refuse(written, "is not read: --no-import", range);
  }
  if (!allows(path)) refuse(written, kOutside, range);
}

void FileAccess::require(const std::string& path) const {
  require(path, path, {}, FileUse::kCode);
}

// --- Looking ----------------------------------------------------------------

std::optional<struct stat> FileAccess::look_at(const std::string& path) const {
  if (is_confined()) {
    const Destination found = find(path);
    if (found.state != State::kThere) return std::nullopt;
    return found.status;
  }
  struct stat status {};
  if (::stat(kernel_path(path), &status) == 0) return status;
  check_machine(path, errno);
  return std::nullopt;
}

bool FileAccess::is_there(const std::string& path) const {
  return look_at(path).has_value();
}

bool FileAccess::is_file(const std::string& path) const {
  const auto status = look_at(path);
  return status && !S_ISDIR(status->st_mode);
}

bool FileAccess::is_regular_file(const std::string& path) const {
  const auto status = look_at(path);
  return status && S_ISREG(status->st_mode);
}

bool FileAccess::is_link(const std::string& path) const {
  if (*kernel_path(path) == '\0') return false;
  if (!is_confined()) return is_a_symlink(path);
  const std::size_t slash = path.rfind('/');
  const Destination folder =
      find(slash == std::string::npos ? "." : path.substr(0, slash + 1));
  struct stat status {};
  return folder.state == State::kThere &&
         ::fstatat(folder.file.descriptor(), path.c_str() + slash + 1, &status,
                   AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISLNK(status.st_mode);
}

std::string FileAccess::canonical(const std::string& path) const {
  if (is_confined()) {
    Destination found = find(path);
    return found.state == State::kThere ? std::move(found.path) : "";
  }
  std::error_code error;
  const fs::path result = fs::canonical(kernel_path(path), error);
  check_machine(path, error.value());
  return error ? "" : result.string();
}

std::string FileAccess::weakly_canonical(const std::string& path) const {
  if (!is_confined()) return without_links(kernel_path(path)).string();
  const Destination found = find(path);
  if (found.state != State::kOutside) return found.path;
  std::error_code error;
  return fs::absolute(path, error).lexically_normal().string();
}

std::optional<std::vector<std::string>> FileAccess::list(
    const std::string& folder) const {
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
  OpenFile file;
  if (is_confined()) {
    const Destination found = find(folder);
    errno = found.error;
    if (found.state != State::kThere) return std::nullopt;
    file = OpenFile(::openat(found.file.descriptor(), ".", kFlags));
  } else {
    file = OpenFile(::open(kernel_path(folder), kFlags));
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(
      file ? ::fdopendir(file.descriptor()) : nullptr, ::closedir);
  if (!entries) {
    check_machine(folder, errno);
    return std::nullopt;
  }
  file.release();  // closedir() closes it
  std::vector<std::string> names;
  errno = 0;
  while (const dirent* entry = ::readdir(entries.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }
  check_machine(folder, errno);
  if (errno != 0) return std::nullopt;
  return names;
}

bool FileAccess::folds_case(const std::string& folder) const {
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
  constexpr auto kExfat = 0x2011BAB0;
  OpenFile file;
  if (!is_confined()) {
    file = OpenFile(::open(kernel_path(folder), kFlags));
  } else if (const Destination found = find(folder);
             found.state == State::kThere) {
    file = OpenFile(::openat(found.file.descriptor(), ".", kFlags));
  }
  if (!file) return false;
  struct statfs system {};
  const bool is_fat =
      ::fstatfs(file.descriptor(), &system) == 0 &&
      (system.f_type == MSDOS_SUPER_MAGIC || system.f_type == kExfat);
  int flags = 0;
  return is_fat || (::ioctl(file.descriptor(), FS_IOC_GETFLAGS, &flags) == 0 &&
                    (flags & FS_CASEFOLD_FL) != 0);
}

std::vector<std::string> FileAccess::readable_parts(
    const std::string& folder) const {
  if (allows(folder)) return {folder};
  const std::vector<std::string> parts = parts_of(folder);
  std::vector<std::string> readable;
  for (const PermittedFolder& permitted : *folders_) {
    if (begins_with(permitted.parts, parts) ||
        begins_with(permitted.given_parts, parts)) {
      readable.push_back(join_parts(permitted.parts));
    }
  }
  return readable;
}

// --- Opening ----------------------------------------------------------------

OpenFile FileAccess::open(const std::string& path) const {
  // A FIFO must not make the run wait for a writer.
  constexpr int kFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;
  OpenFile file;
  if (!is_confined()) {
    file = OpenFile(::open(kernel_path(path), kFlags));
  } else if (const Destination found = find(path);
             found.state == State::kThere && found.folder) {
    file = OpenFile(::openat(found.folder.descriptor(), found.name.c_str(),
                             kFlags | O_NOFOLLOW));
  } else {
    errno = found.error;
  }
  struct stat status {};
  if (!file || ::fstat(file.descriptor(), &status) != 0) {
    check_machine(path, errno);
    return {};
  }
  const bool is_refused = is_confined() && is_of_kernel(file);
  if (S_ISREG(status.st_mode) && !is_refused) {
    if (run_) run_->note_input(path, status, *this);
    return file;
  }
  errno = 0;
  return {};
}

std::optional<std::string> FileAccess::read(const std::string& path) const {
  if (is_confined()) return read_regular(path);
  const OpenFile file(::open(kernel_path(path), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file && ::fstat(file.descriptor(), &status) == 0) {
    // Devices may never end.
    if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) {
      errno = 0;
      return std::nullopt;
    }
    if (run_ && S_ISREG(status.st_mode)) run_->note_input(path, status, *this);
  }
  return read_open(file, path);
}

std::optional<std::string> FileAccess::read_regular(
    const std::string& path) const {
  return read_open(open(path), path);
}

void FileAccess::note_input(const std::string& path) const {
  if (!run_) return;
  const auto status = look_at(path);
  if (status && S_ISREG(status->st_mode)) {
    run_->note_input(path, *status, *this);
  }
}

// --- Writing ----------------------------------------------------------------

OutputPlace FileAccess::find_output(const std::string& path) const {
  if (is_confined()) return find_confined_output(path);
  if (*kernel_path(path) == '\0') return {"", {}, ENOENT, {}};
  if (find_planted_link(path)) return {"", {}, EACCES, {}};
  return {follow_links(path), {}, 0, look_at(path)};
}

OutputPlace FileAccess::find_confined_output(const std::string& path) const {
  Destination found = find_in_root(path);
  if (found.state == State::kOutside) refuse(path, kOutside, {});
  OutputPlace place;
  if (found.state == State::kThere) {
    const bool is_plain =
        S_ISREG(found.status.st_mode) || S_ISDIR(found.status.st_mode);
    if (!is_plain)
      refuse(path, "is no regular file, which --root asks for", {});
    place.there = found.status;
    if (!found.folder) place.error = EISDIR;  // the root itself
  } else if (!found.has_folder) {
    place.error = found.error;
  }
  if (place.error == 0) place.path = path_in(found.folder, found.name);
  place.folder = std::move(found.folder);
  return place;
}

void FileAccess::make_folders(const std::string& path) const {
  if (!is_confined()) {
    if (find_planted_link(path)) return;
    std::error_code ignored;
    fs::create_directories(without_links(kernel_path(path)), ignored);
    return;
  }
  // Each turn makes one missing folder; a path has no more than these.
  for (int i = 0; i < PATH_MAX; ++i) {
    const Destination found = find_in_root(path);
    const bool can_be_made =
        found.state == State::kMissing && found.error == ENOENT && found.folder;
    if (!can_be_made) return;
    const bool is_there =
        ::mkdirat(found.folder.descriptor(), found.name.c_str(), 0777) == 0 ||
        errno == EEXIST;  // another thread has just made it
    if (!is_there) return;
  }
}

std::string FileAccess::scratch_folder() const {
  if (is_confined()) {
    return fmt::format("/proc/self/fd/{}", folders_->front().file.descriptor());
  }
  const char* folder = std::getenv("TMPDIR");
  return folder == nullptr || *folder == '\0' ? "/tmp" : folder;
}

std::string words_of_open_fault(int error) {
  return error == 0 ? "not a regular file" : std::strerror(error);
}

}  // namespace lamina
