#pragma once
// An open file that closes itself, and reading and writing whole files,
// whatever it takes to get all bytes there.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <sys/stat.h>

namespace lamina {

class OpenFile {
 public:
  OpenFile() = default;
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  OpenFile(OpenFile&& other) noexcept : descriptor_(other.release()) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~OpenFile();  // keeps errno

  explicit operator bool() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  // The caller closes it from now on.
  int release() { return std::exchange(descriptor_, -1); }

  // Whether size and time of the last change are what they were.
  bool is_unchanged_since(const struct stat& before) const;

  // All bytes from here to the end; no value where reading fails (errno says
  // why; ESTALE: the file changed meanwhile). What is a stream, such as a pipe,
  // is read until it ends.
  //
  // spare  bytes that the caller will append: there is room for them
  std::optional<std::string> read_all(std::size_t spare = 0) const;

  // At most `size` bytes from `offset` on, fewer at the end; no value where
  // reading fails (errno says why).
  std::optional<std::string> read_at(std::uint64_t offset,
                                     std::size_t size) const;

 private:
  int descriptor_ = -1;
};

// Writes all bytes at the file's position, or, with an offset ≥ 0, there.
// Returns 0 or the error number.
int write_all(int file, std::string_view bytes, off_t offset = -1);

// Copies all bytes of a file, whose position stays, to the position of another.
// Returns 0 or the error number.
int copy_bytes(int from, int to);

}  // namespace lamina
