#pragma once
// The bytes of a file, read once.
//
// They are a copy, not a view of the file: whoever shortens a mapped file ends
// the process that reads it. Copying costs a hundredth of what it takes to make
// a mesh of the bytes.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/file/file_access.h"

namespace lamina {

class FileBytes {
 public:
  // Nothing where there is no regular file that may be read; errno as of
  // FileAccess::open. Throws FileError where reading fails, or the file changes
  // meanwhile.
  static std::optional<FileBytes> open(const std::string& path,
                                       const FileAccess& access);

  FileBytes(FileBytes&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)) {}
  FileBytes& operator=(FileBytes&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~FileBytes();

  // Valid as long as this object.
  std::string_view view() const {
    return {static_cast<const char*>(data_), size_};
  }

 private:
  FileBytes(void* data, std::size_t size) : data_(data), size_(size) {}

  void* data_ = nullptr;  // null: an empty file
  std::size_t size_ = 0;
};

}  // namespace lamina
