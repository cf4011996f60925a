#pragma once
// Writing to the system, whatever it takes to get all bytes there.

#include <array>
#include <cerrno>
#include <cstddef>
#include <string_view>

#include <unistd.h>

namespace lamina {

// Writes all bytes at the file's position, or, with an offset ≥ 0, there.
// Returns 0 or the error number.
inline int write_all(int file, std::string_view bytes, off_t offset = -1) {
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

// Copies all bytes of a file, whose position stays, to the position of another.
// Returns 0 or the error number.
inline int copy_bytes(int from, int to) {
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
