// Writes SLC 2.0 (StereoLithography Contour), the format of wax and resin
// machines (docs/formats.md). Coordinates are float32 (float_writer.h).
//
// The extents, which the header names, are known last, and no reader expects
// blanks to fill a gap there. Their numbers therefore have a fixed width,
// filled up with decimals ("10.0000000000"), and are patched at the end. So is
// the sampling table: it begins with one row, and rows for further thicknesses
// are put in behind it.

#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/version.h"
#include "slicer/formats/detail/float_writer.h"
#include "slicer/formats/detail/text_output.h"
#include "slicer/formats/slc_reader.h"

namespace lamina::slicer {
namespace {

const std::size_t kMostRows =  // of the sampling table
    most_thickness_runs(OutputFormat::kSlc);

// Thicknesses nearer than this [mm] are one. Far above what subtracting heights
// leaves of rounding, far below what a machine can set.
constexpr double kSameThickness = 1e-6;

// A row of the sampling table, as it lies in the file.
struct TableRow {
  float bottom;
  float thickness;
  float compensation;
  float reserved;
};

class SlcWriter : public FloatWriter {
 public:
  // deviation  as in WriterOptions; the header gives it, with what rounding
  //            adds, behind the name of the program
  SlcWriter(const std::string& path, TemporaryFiles& temporary_files,
            std::optional<double> deviation)
      : FloatWriter("SLC", path, temporary_files), deviation_(deviation) {}

  // Throws FileError where two layers fall on the same float32 height, and
  // where thickness changes more often than the table has rows.
  void take(const Layer& layer) override {
    const auto z = static_cast<float>(layer.bottom);
    if (rows_.empty()) {
      begin_file(layer);
      bottom_z_ = z;
    } else {
      check_rise(last_z_, layer.bottom);
      if (std::abs(layer.top - layer.bottom - thickness_) > kSameThickness ||
          static_cast<float>(layer.compensation) != rows_.back().compensation) {
        add_row(layer);
      }
    }
    last_z_ = z;
    top_z_ = static_cast<float>(layer.top);

    contours_.take(layer);
    append(output_, z);
    append(output_, static_cast<std::uint32_t>(contours_.loop_count()));
    for (std::size_t i = 0; i < contours_.loop_count(); ++i) {
      const std::span<const FloatPoint> loop = contours_.loop(i);
      append(output_, static_cast<std::uint32_t>(loop.size()));
      append(output_, std::uint32_t{0});  // gaps
      output_.write(bytes_of(loop));
    }
  }

 private:
  void begin_file(const Layer& first) {
    write_header();
    output_.write(std::string(kSlcReservedSize, '\0'));
    table_offset_ = output_.size();
    append(output_, std::uint8_t{1});
    add_row(first);
    append(output_, rows_.front());
  }

  // Layers from this one upwards. Sections at given heights have no thickness.
  void add_row(const Layer& layer) {
    if (rows_.size() == kMostRows) {
      throw FileError(
          fmt::format("Can't write '{}': the thickness or the compensation of "
                      "layers changes more often than SLC's table, which holds "
                      "{} rows, can say",
                      output_.path(), kMostRows));
    }
    thickness_ = layer.top - layer.bottom;
    rows_.push_back({static_cast<float>(layer.bottom),
                     static_cast<float>(thickness_),
                     static_cast<float>(layer.compensation), 0.0F});
  }

  void write_header() {
    const FloatPoint low = contours_.low();
    const FloatPoint high = contours_.high();
    write_head(fmt::format(
        "-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE {} -EXTENTS "
        "{},{} {},{} {},{}\r\n\x1A",
        package(), fixed_width(low.x), fixed_width(high.x), fixed_width(low.y),
        fixed_width(high.y), fixed_width(bottom_z_), fixed_width(top_z_)));
  }

  // The program's name; "lamina 0.1.0 within 0.00100117000 mm".
  std::string package() const {
    std::string text = fmt::format("lamina {}", version());
    if (deviation_) {
      text += fmt::format(" within {} mm",
                          fixed_width(*deviation_ + greatest_rounding()));
    }
    return text;
  }

  void end_file() override {
    // A file without layers is still a file: it has a table, and its top is 0.
    if (rows_.empty()) begin_file(Layer{});
    append(output_, top_z_);
    append(output_, kSlcEndOfLayers);
    write_header();
    finish_table();
  }

  void finish_table() {
    if (rows_.size() == 1) return;
    const std::uint64_t second_row = table_offset_ + 1 + sizeof(TableRow);
    output_.insert(second_row,
                   bytes_of(std::span<const TableRow>(rows_).subspan(1)));
    const char count = static_cast<char>(rows_.size());
    output_.patch(table_offset_, {&count, 1});
  }

  const std::optional<double> deviation_;
  std::vector<TableRow> rows_;      // empty: the file has not begun
  double thickness_ = 0;            // of the last row [mm]
  std::uint64_t table_offset_ = 0;  // of the number of rows, in the file
  float bottom_z_ = 0;              // of the first layer
  float last_z_ = 0;
  float top_z_ = 0;
};

}  // namespace

std::unique_ptr<LayerWriter> make_slc_writer(const WriterOptions& options,
                                             const std::string& path,
                                             TemporaryFiles& temporary_files) {
  return std::make_unique<SlcWriter>(path, temporary_files, options.deviation);
}

}  // namespace lamina::slicer
