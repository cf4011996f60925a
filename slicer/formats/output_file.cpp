#include "slicer/formats/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "parser/diagnostic.h"

namespace lamina::slicer {
namespace {

// Writes all bytes at the file's position, or, with an offset ≥ 0, there.
// Returns 0 or the error number.
int write_all(int file, std::string_view bytes, off_t offset) {
  while (!bytes.empty()) {
    const ssize_t count =
        offset < 0 ? ::write(file, bytes.data(), bytes.size())
                   : ::pwrite(file, bytes.data(), bytes.size(), offset);
    if (count < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
    if (offset >= 0) offset += count;
  }
  return 0;
}

// An unnamed file for an output that cannot be renamed into place.
int open_unnamed() {
  const char* folder = std::getenv("TMPDIR");
  if (folder == nullptr || *folder == '\0') folder = "/tmp";
  std::string path = std::string(folder) + "/lamina-XXXXXX";
  const int file = ::mkostemp(path.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(path.c_str());
  return file;
}

// Where a rename must go: through symbolic links, to the file itself.
std::string follow_links(const std::string& path) {
  char* resolved = ::realpath(path.c_str(), nullptr);
  if (resolved == nullptr) return path;  // not there yet
  std::string result = resolved;
  ::free(resolved);
  return result;
}

std::string hidden_sibling(const std::string& path, int attempt) {
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  return fmt::format("{}.{}.{}-{}.tmp", path.substr(0, name), path.substr(name),
                     ::getpid(), attempt);
}

// A file, or a folder with all that it holds.
void remove_all(const std::string& path) {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

}  // namespace

void TemporaryFiles::discard_all() {
  // The lock is never given back: no output can be committed any more.
  mutex_.lock();
  for (const std::string& path : paths_) remove_all(path);
}

std::string TemporaryFiles::make_folder(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const std::string target = follow_links(path);
  for (int attempt = 0;; ++attempt) {
    std::string folder = hidden_sibling(target, attempt);
    if (::mkdir(folder.c_str(), 0777) == 0) {
      paths_.push_back(folder);
      return folder;
    }
    if (errno != EEXIST) return {};
  }
}

std::FILE* TemporaryFiles::open_file_in(const std::string& folder,
                                        const std::string& name) {
  // Under the lock: a file that came while discard_all() empties the folder
  // would keep it.
  const std::lock_guard lock(mutex_);
  return std::fopen((folder + "/" + name).c_str(), "wbx");
}

bool TemporaryFiles::commit_folder(const std::string& folder,
                                   const std::string& path) {
  const std::lock_guard lock(mutex_);
  const std::string target = follow_links(path);
  // A name that is free, or an empty folder, is taken by a rename. Else the
  // two change places at once, where the file system can do that.
  if (::rename(folder.c_str(), target.c_str()) != 0) {
    if (errno != ENOTEMPTY && errno != EEXIST) return false;
    if (::renameat2(AT_FDCWD, folder.c_str(), AT_FDCWD, target.c_str(),
                    RENAME_EXCHANGE) != 0) {
      return false;
    }
    remove_all(folder);
  }
  std::erase(paths_, folder);
  return true;
}

void TemporaryFiles::discard(const std::string& folder) {
  const std::lock_guard lock(mutex_);
  remove_all(folder);
  std::erase(paths_, folder);
}

OutputFile::OutputFile(std::string path, TemporaryFiles& temporary_files)
    : path_(std::move(path)),
      temporary_files_(temporary_files),
      buffer_(std::make_unique_for_overwrite<char[]>(kBufferSize)) {
  struct stat status {};
  const bool exists = path_ != "-" && ::stat(path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (path_ == "-" || (exists && !S_ISREG(status.st_mode))) {
    file_ = open_unnamed();
    if (file_ < 0) fail(errno);
    return;
  }
  target_path_ = follow_links(path_);
  if (exists && ::access(target_path_.c_str(), W_OK) != 0) fail(errno);
  const std::lock_guard lock(temporary_files_.mutex_);
  for (int attempt = 0; file_ < 0; ++attempt) {
    temporary_path_ = hidden_sibling(target_path_, attempt);
    file_ = ::open(temporary_path_.c_str(),
                   O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0 && errno != EEXIST) fail(errno);
  }
  temporary_files_.paths_.push_back(temporary_path_);
}

OutputFile::~OutputFile() {
  if (file_ < 0) return;
  close_file();
  if (temporary_path_.empty()) return;
  const std::lock_guard lock(temporary_files_.mutex_);
  ::unlink(temporary_path_.c_str());
  std::erase(temporary_files_.paths_, temporary_path_);
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t count = std::min(bytes.size(), kLargestPiece);
    std::memcpy(reserve(count), bytes.data(), count);
    advance(count);
    bytes.remove_prefix(count);
  }
}

void OutputFile::flush() {
  const int error = write_all(file_, {buffer_.get(), used_}, -1);
  if (error != 0) fail(error);
  flushed_ += used_;
  used_ = 0;
}

void OutputFile::patch(std::uint64_t offset, std::string_view bytes) {
  flush();
  const int error = write_all(file_, bytes, static_cast<off_t>(offset));
  if (error != 0) fail(error);
}

void OutputFile::insert(std::uint64_t offset, std::string_view bytes) {
  flush();
  // Move what stands behind piece by piece, the last one first.
  for (std::uint64_t end = flushed_; end > offset;) {
    const auto size = std::min<std::uint64_t>(end - offset, kBufferSize);
    end -= size;
    patch(end + bytes.size(), read(end, size));
  }
  patch(offset, bytes);
  flushed_ += bytes.size();
  if (::lseek(file_, 0, SEEK_END) < 0) fail(errno);
}

std::string OutputFile::read(std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::pread(file_, bytes.data() + done, size - done,
                                  static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count < 0 ? errno : EIO);
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

void OutputFile::commit() {
  flush();
  if (temporary_path_.empty()) {
    const int target = path_ == "-"
                           ? STDOUT_FILENO
                           : ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (target < 0) fail(errno);
    copy_to(target);
    if (target != STDOUT_FILENO && ::close(target) != 0) fail(errno);
    close_file();
    return;
  }
  const std::lock_guard lock(temporary_files_.mutex_);
  if (::rename(temporary_path_.c_str(), target_path_.c_str()) != 0) {
    fail(errno);
  }
  std::erase(temporary_files_.paths_, temporary_path_);
  temporary_path_.clear();
  close_file();
}

void OutputFile::copy_to(int target) {
  std::uint64_t offset = 0;
  while (offset < flushed_) {
    const ssize_t count =
        ::pread(file_, buffer_.get(), kBufferSize, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count < 0 ? errno : EIO);
    const int error =
        write_all(target, {buffer_.get(), static_cast<std::size_t>(count)}, -1);
    if (error != 0) fail(error);
    offset += static_cast<std::uint64_t>(count);
  }
}

void OutputFile::close_file() {
  ::close(file_);
  file_ = -1;
}

void OutputFile::fail(int error) const {
  const std::string name = path_ == "-" ? "standard output" : path_;
  throw FileError(
      {Severity::kError,
       {},
       fmt::format("Can't write '{}': {}", name, std::strerror(error)),
       {}});
}

}  // namespace lamina::slicer
