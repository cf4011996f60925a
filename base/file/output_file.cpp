#include "base/file/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "base/file/write_all.h"

namespace lamina {
OutputFile::OutputFile(std::string path, TemporaryFiles& temporary_files)
    : path_(std::move(path)),
      temporary_files_(temporary_files),
      buffer_(std::make_unique_for_overwrite<char[]>(kBufferSize)) {
  const FileAccess& access = temporary_files_.file_access();
  if (path_ != "-") place_ = access.find_output(path_);
  if (place_.error != 0) fail(place_.error);
  const auto there = place_.there;
  if (there && S_ISDIR(there->st_mode)) fail(EISDIR);
  if (path_ == "-" || (there && !S_ISREG(there->st_mode))) {
    place_ = {};
    temporary_.file = temporary_files_.open_nameless();
  } else {
    if (there && ::faccessat(AT_FDCWD, place_.path.c_str(), W_OK,
                             AT_SYMLINK_NOFOLLOW) != 0) {
      fail(errno);
    }
    temporary_ = temporary_files_.open_file(place_.path);
  }
  if (temporary_.file < 0) fail(errno);
}

OutputFile::~OutputFile() { temporary_files_.discard_file(temporary_); }

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t count = std::min(bytes.size(), kLargestPiece);
    std::memcpy(reserve(count), bytes.data(), count);
    advance(count);
    bytes.remove_prefix(count);
  }
}

void OutputFile::flush() {
  const int error = write_all(temporary_.file, {buffer_.get(), used_});
  if (error != 0) fail(error);
  flushed_ += used_;
  used_ = 0;
}

void OutputFile::patch(std::uint64_t offset, std::string_view bytes) {
  flush();
  const int error =
      write_all(temporary_.file, bytes, static_cast<off_t>(offset));
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
  if (::lseek(temporary_.file, 0, SEEK_END) < 0) fail(errno);
}

std::string OutputFile::read(std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t done = 0; done < size;) {
    const ssize_t count =
        ::pread(temporary_.file, bytes.data() + done, size - done,
                static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count < 0 ? errno : EIO);
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

void OutputFile::commit() {
  flush();
  if (place_.path.empty()) {
    const int target = path_ == "-"
                           ? STDOUT_FILENO
                           : ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (target < 0) fail(errno);
    copy_to(target);
    if (target != STDOUT_FILENO && ::close(target) != 0) fail(errno);
  } else if (!temporary_files_.commit_file(temporary_, place_.path)) {
    fail(errno);
  }
  temporary_files_.discard_file(temporary_);
}

void OutputFile::copy_to(int target) {
  std::uint64_t offset = 0;
  while (offset < flushed_) {
    const ssize_t count = ::pread(temporary_.file, buffer_.get(), kBufferSize,
                                  static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count < 0 ? errno : EIO);
    const int error =
        write_all(target, {buffer_.get(), static_cast<std::size_t>(count)});
    if (error != 0) fail(error);
    offset += static_cast<std::uint64_t>(count);
  }
}

void OutputFile::fail(int error) const {
  const std::string name = path_ == "-" ? "standard output" : path_;
  throw FileError(
      fmt::format("Can't write '{}': {}", name, std::strerror(error)));
}

}  // namespace lamina
