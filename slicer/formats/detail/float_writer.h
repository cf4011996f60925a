#pragma once
// What the writers of float32 contours (SLC, CLI, SVG, 3MF) have in common.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "slicer/formats/detail/file_writer.h"
#include "slicer/formats/detail/float_contours.h"

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
  void check_rise(float before, double height) const;

  FloatContours contours_;

 private:
  const char* const format_;
};

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
