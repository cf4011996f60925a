#include "base/file/open_file.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include <unistd.h>

namespace lamina {
namespace {

// Whether the file is as it was before `size` bytes of it were read. Files that
// are not regular, or that have no size, as in /proc, have no "before".
bool is_whole(const OpenFile& file, const struct stat& before,
              std::size_t size) {
  if (!S_ISREG(before.st_mode) || before.st_size == 0) return true;
  return file.is_unchanged_since(before) &&
         size == static_cast<std::size_t>(before.st_size);
}

}  // namespace

OpenFile::~OpenFile() {
  if (descriptor_ < 0) return;
  const int error = errno;
  ::close(descriptor_);
  errno = error;
}

bool OpenFile::is_unchanged_since(const struct stat& before) const {
  struct stat after {};
  return ::fstat(descriptor_, &after) == 0 && after.st_size == before.st_size &&
         after.st_mtim.tv_sec == before.st_mtim.tv_sec &&
         after.st_mtim.tv_nsec == before.st_mtim.tv_nsec;
}

std::optional<std::string> OpenFile::read_all(std::size_t spare) const {
  constexpr std::size_t kLeastPiece = 1 << 12;
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) return std::nullopt;
  // One byte more than there are shows the end without growing.
  const auto expected =
      static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
  std::string bytes;
  bytes.reserve(expected + 1 + spare);
  std::size_t size = 0;
  while (true) {
    if (size == bytes.size()) {
      bytes.resize(size == 0 ? std::max(expected + 1, kLeastPiece) : 2 * size);
    }
    const ssize_t count =
        ::read(descriptor_, bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  if (!is_whole(*this, status, size)) {
    errno = ESTALE;
    return std::nullopt;
  }
  bytes.resize(size);
  return bytes;
}

std::optional<std::string> OpenFile::read_at(std::uint64_t offset,
                                             std::size_t size) const {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::pread(descriptor_, bytes.data() + done, size - done,
                                  static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

int write_all(int file, std::string_view bytes, off_t offset) {
  while (!bytes.empty()) {
    const ssize_t count =
        offset < 0 ? ::write(file, bytes.data(), bytes.size())
                   : ::pwrite(file, bytes.data(), bytes.size(), offset);
    if (count < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    // A file that takes nothing and names no error never will take anything.
    if (count == 0) return ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(count));
    if (offset >= 0) offset += count;
  }
  return 0;
}

int copy_bytes(int from, int to) {
  std::array<char, 1 << 16> buffer;
  for (off_t offset = 0;;) {
    const ssize_t count = ::pread(from, buffer.data(), buffer.size(), offset);
    if (count == 0) return 0;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    const int error =
        write_all(to, {buffer.data(), static_cast<std::size_t>(count)});
    if (error != 0) return error;
    offset += count;
  }
}

}  // namespace lamina
