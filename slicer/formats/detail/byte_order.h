#pragma once
// Numbers of files whose records are laid out byte by byte: integers and
// float32, high byte first (.goo) or low byte first (.ctb).

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace lamina::slicer {

// Appends fields to a record.
template <std::endian kOrder>
class RecordWriter {
 public:
  void u8(std::uint8_t value) { put(value, 1); }
  void u16(std::uint32_t value) { put(value, 2); }
  void u32(std::uint64_t value) { put(value, 4); }
  void f32(double value) {
    put(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  }
  void zeros(std::size_t count) { bytes_.append(count, '\0'); }
  void raw(std::string_view bytes) { bytes_ += bytes; }

  // A text of printable ASCII, filled up with at least one NUL.
  void text(std::string_view text, std::size_t size) {
    std::string field(text.substr(0, size - 1));
    for (char& c : field) {
      if (c < ' ' || c > '~') c = '?';
    }
    field.resize(size);
    bytes_ += field;
  }

  std::size_t size() const { return bytes_.size(); }
  const std::string& bytes() const { return bytes_; }

 private:
  void put(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) {
      const int place = kOrder == std::endian::big ? size - 1 - i : i;
      bytes_ += static_cast<char>(value >> (8 * place));
    }
  }

  std::string bytes_;
};

// Takes fields off a file, one after the other. Throws std::runtime_error
// where the file ends before.
template <std::endian kOrder>
class RecordReader {
 public:
  RecordReader(std::string_view file, std::uint64_t place)
      : file_(file), place_(place) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(take(1)); }
  std::uint32_t u16() { return static_cast<std::uint32_t>(take(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(take(4)); }
  double f32() {
    return std::bit_cast<float>(static_cast<std::uint32_t>(take(4)));
  }
  std::string_view raw(std::uint64_t size) {
    if (place_ > file_.size() || size > file_.size() - place_) {
      throw std::runtime_error("the file ends too early");
    }
    const std::string_view bytes = file_.substr(place_, size);
    place_ += size;
    return bytes;
  }
  void skip(std::uint64_t size) { raw(size); }
  bool is_at_end() const { return place_ == file_.size(); }

 private:
  std::uint64_t take(std::size_t size) {
    const std::string_view bytes = raw(size);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = kOrder == std::endian::big ? i : size - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes[place]);
    }
    return value;
  }

  std::string_view file_;
  std::uint64_t place_;
};

// Joins runs of equal pixels that come one after the other, and hands them on
// where another grey begins: write(grey, count), with at most kLongestRun
// pixels each.
template <typename Write>
class RunJoiner {
 public:
  // What the lengths of both formats have room for.
  static constexpr std::uint64_t kLongestRun = (1U << 28) - 1;

  explicit RunJoiner(Write write) : write_(std::move(write)) {}

  void add(std::uint8_t grey, std::uint64_t count) {
    if (count == 0) return;
    if (grey != grey_) finish();
    grey_ = grey;
    count_ += count;
  }
  void finish() {
    while (count_ > 0) {
      const std::uint64_t count = std::min(count_, kLongestRun);
      write_(grey_, count);
      count_ -= count;
    }
  }

 private:
  Write write_;
  std::uint8_t grey_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace lamina::slicer
