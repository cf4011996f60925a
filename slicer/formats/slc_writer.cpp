#include "slicer/formats/slc_writer.h"

#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/file/text_output.h"
#include "base/version.h"

namespace lamina::slicer {
namespace {

constexpr std::size_t kReservedSize = 256;
constexpr std::uint32_t kEndOfLayers = 0xFFFFFFFF;
// Of the sampling table.
const std::size_t kMostRows = most_thickness_runs(OutputFormat::kSlc);

// Thicknesses nearer than this [mm] are one. Far above what subtracting heights
// leaves of rounding, far below what a machine can set.
constexpr double kSameThickness = 1e-6;

template <typename Row>
std::string_view bytes_of(std::span<const Row> rows) {
  return {reinterpret_cast<const char*>(rows.data()), rows.size_bytes()};
}

}  // namespace

SlcWriter::SlcWriter(const std::string& path, TemporaryFiles& temporary_files,
                     std::optional<double> deviation)
    : FloatWriter(path, temporary_files), deviation_(deviation) {}

// The program's name; "lamina 0.1.0 within 0.00100117000 mm".
std::string SlcWriter::package() const {
  std::string text = fmt::format("lamina {}", version());
  if (deviation_) {
    text += fmt::format(" within {} mm",
                        fixed_width(*deviation_ + greatest_rounding()));
  }
  return text;
}

void SlcWriter::write_header() {
  const FloatPoint low = contours_.low();
  const FloatPoint high = contours_.high();
  const std::string header = fmt::format(
      "-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE {} -EXTENTS "
      "{},{} {},{} {},{}\r\n\x1A",
      package(), fixed_width(low.x), fixed_width(high.x), fixed_width(low.y),
      fixed_width(high.y), fixed_width(bottom_z_), fixed_width(top_z_));
  write_head(header);
}

void SlcWriter::begin_file(const Layer& first) {
  write_header();
  output_.write(std::string(kReservedSize, '\0'));
  table_offset_ = output_.size();
  append(output_, std::uint8_t{1});
  add_row(first);
  append(output_, rows_.front());
}

// Layers from this one upwards. Sections at given heights have no thickness.
void SlcWriter::add_row(const Layer& layer) {
  if (rows_.size() == kMostRows) {
    throw FileError(
        {Severity::kError,
         {},
         fmt::format("Can't write '{}': the thickness of layers changes more "
                     "often than SLC's table, which holds {} rows, can tell",
                     output_.path(), kMostRows)});
  }
  thickness_ = layer.top - layer.bottom;
  rows_.push_back({static_cast<float>(layer.bottom),
                   static_cast<float>(thickness_),
                   static_cast<float>(layer.compensation), 0.0F});
}

void SlcWriter::finish_table() {
  if (rows_.size() == 1) return;
  const std::uint64_t second_row = table_offset_ + 1 + sizeof(SamplingRow);
  output_.insert(second_row,
                 bytes_of(std::span<const SamplingRow>(rows_).subspan(1)));
  const char count = static_cast<char>(rows_.size());
  output_.patch(table_offset_, {&count, 1});
}

void SlcWriter::take(const Layer& layer) {
  const auto z = static_cast<float>(layer.bottom);
  if (!has_layers_) {
    begin_file(layer);
    bottom_z_ = z;
  } else {
    check_rise(last_z_, layer.bottom, "SLC");
    if (std::abs(layer.top - layer.bottom - thickness_) > kSameThickness) {
      add_row(layer);
    }
  }
  has_layers_ = true;
  last_z_ = z;
  top_z_ = static_cast<float>(layer.top);

  contours_.take(layer);
  append(output_, z);
  append(output_, static_cast<std::uint32_t>(contours_.loop_count()));
  for (std::size_t i = 0; i < contours_.loop_count(); ++i) {
    write_loop(contours_.loop(i));
  }
}

void SlcWriter::write_loop(std::span<const FloatPoint> loop) {
  append(output_, static_cast<std::uint32_t>(loop.size()));
  append(output_, std::uint32_t{0});  // gaps
  output_.write(bytes_of(loop));
}

void SlcWriter::finish(Diagnostics& diagnostics) {
  // A file without layers is still a file: it has a table, and its top is 0.
  if (!has_layers_) begin_file(Layer{});
  append(output_, top_z_);
  append(output_, kEndOfLayers);
  write_header();
  finish_table();
  contours_.warn_of_coarse_numbers("SLC", diagnostics);
}

}  // namespace lamina::slicer
