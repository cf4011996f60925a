#pragma once
// What the writers of float32 contours (SLC, CLI, SVG) have in common.

#include <cstdint>
#include <string>
#include <string_view>

#include "slicer/formats/detail/float_contours.h"
#include "slicer/formats/layer_writer.h"

namespace lamina::slicer {

class FloatWriter : public FileWriter {
 public:
  std::uint64_t snapped_layers() const final {
    return contours_.snapped_layers();
  }
  double greatest_rounding() const final {
    return contours_.greatest_rounding();
  }

 protected:
  using FileWriter::FileWriter;

  // The begin of the file: written where nothing is yet, over what stands
  // there else, which must be as long.
  void write_head(std::string_view head) {
    if (output_.size() == 0) {
      output_.write(head);
    } else {
      output_.patch(0, head);
    }
  }

  // Throws FileError where a layer at `height` [mm] falls on the float32 height
  // of the one before, or below it.
  // format  as messages name it: "SLC"
  void check_rise(float before, double height, std::string_view format) const;

  FloatContours contours_;
};

// A number as it lies in memory.
template <typename Value>
void append(OutputFile& output, const Value& value) {
  output.write({reinterpret_cast<const char*>(&value), sizeof(value)});
}

}  // namespace lamina::slicer
