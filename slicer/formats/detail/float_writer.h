#pragma once
// What the writers of float32 contours (SLC, CLI, SVG, 3MF) have in common.

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "slicer/formats/detail/float_contours.h"
#include "slicer/formats/detail/writers.h"

namespace lamina::slicer {

class FloatWriter : public FileWriter {
 public:
  // Warns where float32 numbers are too coarse for the design.
  void finish(Diagnostics& diagnostics) final {
    end_file();
    contours_.warn_of_coarse_numbers(format_, diagnostics);
  }
  std::uint64_t snapped_layers() const final {
    return contours_.snapped_layers();
  }
  double greatest_rounding() const final {
    return contours_.greatest_rounding();
  }

 protected:
  // format  as messages name it: "SLC"
  FloatWriter(const char* format, const std::string& path,
              TemporaryFiles& temporary_files)
      : FileWriter(path, temporary_files), format_(format) {}

  // Writes what follows the last layer.
  virtual void end_file() = 0;

  // Writes the beginning of the file, or writes it again once all is known; it
  // must be as long then.
  void write_head(std::string_view head) {
    if (output_.size() == 0) {
      output_.write(head);
    } else {
      output_.patch(0, head);
    }
  }

  // Throws FileError where a layer at `height` [mm] falls on the float32 height
  // of the one before, or below it.
  void check_rise(float before, double height) const {
    if (static_cast<float>(height) > before) return;
    throw FileError(fmt::format(
        "Can't write '{}': the layers at {} and {} mm are one in {}'s 32-bit "
        "numbers",
        output_.path(), before, height, format_));
  }

  FloatContours contours_;

 private:
  const char* const format_;
};

static_assert(std::endian::native == std::endian::little,
              "SLC and CLI are little-endian and written as numbers lie in "
              "memory");

// Numbers as they lie in memory.
template <typename Value>
std::string_view bytes_of(std::span<const Value> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}
template <typename Value>
void append(OutputFile& output, const Value& value) {
  output.write(bytes_of(std::span(&value, 1)));
}

}  // namespace lamina::slicer
