#include "base/file/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file/detail/planted_link.h"
#include "base/file/open_file.h"

namespace lamina {

void fail_to_write(const std::string& path, int error) {
  throw FileError(fmt::format("Can't write '{}': {}",
                              path == "-" ? "standard output" : path,
                              std::strerror(error)));
}

OutputFile OutputFile::open(std::string path, TemporaryFiles& temporary_files) {
  auto buffer = std::make_unique_for_overwrite<char[]>(kBufferSize);
  OutputPlace place;
  if (path != "-") place = temporary_files.file_access().find_output(path);
  if (place.error != 0) fail_to_write(path, place.error);
  const bool is_there = place.there.has_value();
  const mode_t mode = is_there ? place.there->st_mode : S_IFREG;
  if (S_ISDIR(mode)) fail_to_write(path, EISDIR);
  const bool is_strangers =
      is_there && !S_ISREG(mode) && is_planted_at(place.path, *place.there);
  if (is_strangers) fail_to_write(path, EACCES);
  TemporaryFiles::File temporary;
  if (path == "-" || !S_ISREG(mode)) {
    place = {};
    temporary.file = temporary_files.open_nameless();
  } else {
    if (is_there && ::faccessat(AT_FDCWD, place.path.c_str(), W_OK,
                                AT_SYMLINK_NOFOLLOW) != 0) {
      fail_to_write(path, errno);
    }
    temporary = temporary_files.open_file(place.path);
  }
  if (temporary.file < 0) fail_to_write(path, errno);
  return {std::move(path), std::move(place), temporary_files,
          std::move(temporary), std::move(buffer)};
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
  if (error != 0) fail_to_write(path_, error);
  flushed_ += used_;
  used_ = 0;
}

void OutputFile::patch(std::uint64_t offset, std::string_view bytes) {
  flush();
  const int error =
      write_all(temporary_.file, bytes, static_cast<off_t>(offset));
  if (error != 0) fail_to_write(path_, error);
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
  if (::lseek(temporary_.file, 0, SEEK_END) < 0) fail_to_write(path_, errno);
}

std::string OutputFile::read(std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t done = 0; done < size;) {
    const ssize_t count =
        ::pread(temporary_.file, bytes.data() + done, size - done,
                static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail_to_write(path_, count < 0 ? errno : EIO);
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
    if (target < 0) fail_to_write(path_, errno);
    const int error = copy_bytes(temporary_.file, target);
    if (error != 0) fail_to_write(path_, error);
    if (target != STDOUT_FILENO && ::close(target) != 0)
      fail_to_write(path_, errno);
  } else if (!temporary_files_.commit_file(temporary_, place_, path_)) {
    fail_to_write(path_, errno);
  }
  temporary_files_.discard_file(temporary_);
}

}  // namespace lamina
