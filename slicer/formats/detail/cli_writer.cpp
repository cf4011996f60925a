// Writes CLI 2.0 (Common Layer Interface), binary or ASCII (docs/formats.md).
//
// Both hold the same float32 numbers (float_writer.h); ASCII has the
// shortest digits that read back as them. A layer's height is that of its
// upper side. Outer loops have direction 1, holes 0.
//
// The box and the number of layers, which the header names, are known last:
// they have a fixed width and are patched at the end. The header has no date,
// so that the same design gives the same bytes.

#include <array>
#include <charconv>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "slicer/formats/detail/float_writer.h"
#include "slicer/formats/detail/text_output.h"

namespace lamina::slicer {
namespace {

// Commands of the binary body: those with long numbers.
constexpr std::uint16_t kStartLayer = 127;
constexpr std::uint16_t kStartPolyline = 130;

constexpr std::int32_t kPart = 1;  // identifier of the only one
constexpr std::int32_t kInner = 0;
constexpr std::int32_t kOuter = 1;

// The shortest digits that read back as the same number; readers want no
// exponent.
void print_number(OutputFile& output, float value) {
  constexpr std::size_t kLongest = 64;  // 45 decimals and what stands before
  char* const begin = output.reserve(kLongest);
  const std::to_chars_result end =
      std::to_chars(begin, begin + kLongest, value + 0.0F,  // -0 prints as 0
                    std::chars_format::fixed);
  output.advance(static_cast<std::size_t>(end.ptr - begin));
}

class CliWriter : public FloatWriter {
 public:
  CliWriter(const std::string& path, TemporaryFiles& temporary_files,
            CliEncoding encoding)
      : FloatWriter("CLI", path, temporary_files),
        is_ascii_(encoding == CliEncoding::kAscii) {
    write_header();
  }

  // Throws FileError where two layers fall on the same float32 height.
  void take(const Layer& layer) override {
    if (layers_ == 0) {
      bottom_z_ = static_cast<float>(layer.bottom);
    } else {
      check_rise(top_z_, layer.top);
    }
    ++layers_;
    top_z_ = static_cast<float>(layer.top);
    contours_.take(layer);
    write_height();
    for (std::size_t i = 0; i < contours_.loop_count(); ++i) write_loop(i);
  }

 private:
  void write_header() {
    const FloatPoint low = contours_.low();
    const FloatPoint high = contours_.high();
    // In binary files the first command follows the last letter.
    write_head(fmt::format(
        "$$HEADERSTART\n{}\n$$UNITS/1\n$$VERSION/200\n$$LABEL/{},part\n"
        "$$DIMENSION/{},{},{},{},{},{}\n$$LAYERS/{:010}\n$$HEADEREND{}",
        is_ascii_ ? "$$ASCII" : "$$BINARY", kPart, fixed_width(low.x),
        fixed_width(low.y), fixed_width(bottom_z_), fixed_width(high.x),
        fixed_width(high.y), fixed_width(top_z_), layers_,
        is_ascii_ ? "\n$$GEOMETRYSTART\n" : ""));
  }

  void write_height() {
    if (is_ascii_) {
      output_.write("$$LAYER/");
      print_number(output_, top_z_);
      output_.write("\n");
    } else {
      append(output_, kStartLayer);
      append(output_, top_z_);
    }
  }

  void write_loop(std::size_t i) {
    const std::span<const FloatPoint> loop = contours_.loop(i);
    const auto count = static_cast<std::int32_t>(loop.size());
    const std::int32_t direction = contours_.is_hole(i) ? kInner : kOuter;
    if (!is_ascii_) {
      append(output_, kStartPolyline);
      append(output_, std::array{kPart, direction, count});
      output_.write(bytes_of(loop));
      return;
    }
    print(output_, FMT_COMPILE("$$POLYLINE/{},{},{}"), kPart, direction, count);
    for (const FloatPoint& point : loop) {
      for (const float value : {point.x, point.y}) {
        output_.write(",");
        print_number(output_, value);
      }
    }
    output_.write("\n");
  }

  void end_file() override {
    if (is_ascii_) output_.write("$$GEOMETRYEND\n");
    write_header();
  }

  const bool is_ascii_;
  std::uint32_t layers_ = 0;
  float bottom_z_ = 0;  // of the first layer
  float top_z_ = 0;     // of the last one
};

}  // namespace

std::unique_ptr<LayerWriter> make_cli_writer(const WriterOptions& options,
                                             const std::string& path,
                                             TemporaryFiles& temporary_files) {
  return std::make_unique<CliWriter>(path, temporary_files, options.cli);
}

}  // namespace lamina::slicer
