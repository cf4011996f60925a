#include "slicer/formats/detail/cli_writer.h"

#include <charconv>
#include <string>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/file/text_output.h"

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

}  // namespace

CliWriter::CliWriter(const std::string& path, TemporaryFiles& temporary_files,
                     CliEncoding encoding)
    : FloatWriter(path, temporary_files), encoding_(encoding) {
  write_header();
}

void CliWriter::write_header() {
  const bool is_ascii = encoding_ == CliEncoding::kAscii;
  const FloatPoint low = contours_.low();
  const FloatPoint high = contours_.high();
  // In binary files the first command follows the last letter.
  const std::string header = fmt::format(
      "$$HEADERSTART\n{}\n$$UNITS/1\n$$VERSION/200\n$$LABEL/{},part\n"
      "$$DIMENSION/{},{},{},{},{},{}\n$$LAYERS/{:010}\n$$HEADEREND{}",
      is_ascii ? "$$ASCII" : "$$BINARY", kPart, fixed_width(low.x),
      fixed_width(low.y), fixed_width(bottom_z_), fixed_width(high.x),
      fixed_width(high.y), fixed_width(top_z_), layers_,
      is_ascii ? "\n$$GEOMETRYSTART\n" : "");
  write_head(header);
}

void CliWriter::write_height(float z) {
  if (encoding_ == CliEncoding::kAscii) {
    output_.write("$$LAYER/");
    print_number(output_, z);
    output_.write("\n");
  } else {
    append(output_, kStartLayer);
    append(output_, z);
  }
}

void CliWriter::write_loop(std::span<const FloatPoint> loop) {
  const auto count = static_cast<std::int32_t>(loop.size());
  const std::int32_t direction = signed_area(loop) > 0 ? kOuter : kInner;
  if (encoding_ == CliEncoding::kBinary) {
    append(output_, kStartPolyline);
    for (const std::int32_t value : {kPart, direction, count}) {
      append(output_, value);
    }
    output_.write(
        {reinterpret_cast<const char*>(loop.data()), loop.size_bytes()});
    return;
  }
  print(output_, FMT_COMPILE("$$POLYLINE/{},{},{}"), kPart, direction, count);
  for (const FloatPoint& point : loop) {
    output_.write(",");
    print_number(output_, point.x);
    output_.write(",");
    print_number(output_, point.y);
  }
  output_.write("\n");
}

void CliWriter::take(const Layer& layer) {
  const auto z = static_cast<float>(layer.top);
  if (layers_ == 0) {
    bottom_z_ = static_cast<float>(layer.bottom);
  } else {
    check_rise(top_z_, layer.top, "CLI");
  }
  ++layers_;
  top_z_ = z;
  contours_.take(layer);
  write_height(z);
  for (std::size_t i = 0; i < contours_.loop_count(); ++i) {
    write_loop(contours_.loop(i));
  }
}

void CliWriter::finish(Diagnostics& diagnostics) {
  if (encoding_ == CliEncoding::kAscii) output_.write("$$GEOMETRYEND\n");
  write_header();
  contours_.warn_of_coarse_numbers("CLI", diagnostics);
}

}  // namespace lamina::slicer
