#pragma once
// The bytes of a file, mapped into memory: nothing is copied, and what is not
// looked at is not read.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace lamina::csg {

class FileBytes {
 public:
  // Nothing where there is no regular file that may be read.
  static std::optional<FileBytes> open(const std::string& path);

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

}  // namespace lamina::csg
