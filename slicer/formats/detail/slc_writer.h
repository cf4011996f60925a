#pragma once
// Writes SLC 2.0 (StereoLithography Contour), the format of wax and resin
// machines (docs/formats.md).
//
// Coordinates are float32 (float_contours.h).
//
// The header tells the extents, which are known last, and no reader expects
// blanks to fill a gap there. Their numbers therefore have a fixed width,
// filled up with decimals ("10.0000000000"), and are patched at the end. So is
// the sampling table: it begins with one row, and rows for further thicknesses
// are put in behind it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slicer/formats/detail/float_writer.h"

namespace lamina::slicer {

class SlcWriter : public FloatWriter {
 public:
  // deviation  as in WriterOptions; the header tells it, and what
  //            rounding adds, behind the name of the program
  SlcWriter(const std::string& path, TemporaryFiles& temporary_files,
            std::optional<double> deviation);

  // Throws FileError where two layers fall on the same float32 height, and
  // where thickness changes more often than the table has rows.
  void take(const Layer& layer) override;
  // Warns where the numbers are too coarse for the design.
  void finish(Diagnostics& diagnostics) override;

 private:
  // A row of the sampling table, as it lies in the file.
  struct SamplingRow {
    float bottom;
    float thickness;
    float compensation;
    float reserved;
  };

  void begin_file(const Layer& first);
  void add_row(const Layer& layer);
  void finish_table();
  void write_loop(std::span<const FloatPoint> loop);
  void write_header();
  std::string package() const;

  const std::optional<double> deviation_;
  bool has_layers_ = false;
  std::vector<SamplingRow> rows_;
  double thickness_ = 0;            // of the last row [mm]
  std::uint64_t table_offset_ = 0;  // of the number of rows, in the file
  float bottom_z_ = 0;              // of the first layer
  float last_z_ = 0;
  float top_z_ = 0;
};

}  // namespace lamina::slicer
