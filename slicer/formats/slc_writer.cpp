#include "slicer/formats/slc_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "parser/diagnostic.h"
#include "slicer/deviation.h"
#include "slicer/version.h"

namespace lamina::slicer {
namespace {

static_assert(std::endian::native == std::endian::little,
              "SLC is little-endian and is written as it lies in memory");

constexpr std::size_t kReservedSize = 256;
constexpr std::uint32_t kEndOfLayers = 0xFFFFFFFF;

// Neighbouring numbers of the file may be this far apart without a word [mm].
constexpr double kCoarse = 1e-3;

// Of each number of -EXTENTS: sign, four digits, point, seven decimals.
constexpr std::size_t kNumberWidth = 13;

// `value` with as many decimals as make it kNumberWidth characters long.
std::string fixed_width(double value) {
  value += 0.0;  // -0 prints as 0
  for (int decimals = kNumberWidth - 2; decimals > 0; --decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.size() == kNumberWidth) return text;
  }
  return fmt::format("{:.6e}", value).substr(0, kNumberWidth);
}

void warn_of_coarse_numbers(double reach, Diagnostics& diagnostics) {
  const auto farthest = static_cast<float>(reach);
  const double spacing =
      std::nextafter(farthest, std::numeric_limits<float>::infinity()) -
      farthest;
  if (spacing < kCoarse) return;
  diagnostics.warning(
      {},
      fmt::format("{:.6g} mm from the origin, the 32-bit numbers of SLC are "
                  "{:.2g} mm apart: move the design nearer to the origin",
                  reach, spacing));
}

template <typename Value>
void append(OutputFile& output, const Value& value) {
  output.write({reinterpret_cast<const char*>(&value), sizeof(value)});
}

}  // namespace

SlcWriter::SlcWriter(OutputFile& output, std::optional<double> deviation)
    : output_(output), deviation_(deviation) {}

double SlcWriter::greatest_rounding() const {
  return rounder_.most_moves() * float32_rounding(reach_);
}

// The program's name; "lamina 0.1.0 within 0.00100117000 mm".
std::string SlcWriter::package() const {
  std::string text = fmt::format("lamina {}", version());
  if (deviation_) {
    text += fmt::format(" within {} mm",
                        fixed_width(*deviation_ + greatest_rounding()));
  }
  return text;
}

void SlcWriter::write_header(const Extents& extents) {
  const auto& [low, high] = extents;
  const std::string header = fmt::format(
      "-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE {} -EXTENTS "
      "{},{} {},{} {},{}\r\n\x1A",
      package(), fixed_width(low[0]), fixed_width(high[0]), fixed_width(low[1]),
      fixed_width(high[1]), fixed_width(low[2]), fixed_width(high[2]));
  if (output_.size() == 0) {
    output_.write(header);
  } else {
    output_.patch(0, header);
  }
}

void SlcWriter::begin_file(const Layer& first) {
  write_header(extents_);
  output_.write(std::string(kReservedSize, '\0'));
  // One row rules them all: layers are of equal thickness. Sections at given
  // heights have none.
  append(output_, std::uint8_t{1});
  append(output_, static_cast<float>(first.bottom));
  append(output_, static_cast<float>(first.top - first.bottom));
  append(output_, static_cast<float>(first.compensation));
  append(output_, 0.0F);  // reserved
}

void SlcWriter::take(const Layer& layer) {
  const auto z = static_cast<float>(layer.bottom);
  if (!has_layers_) {
    begin_file(layer);
    extents_.low[2] = z;
  } else if (!(z > last_z_)) {
    throw FileError({Severity::kError,
                     {},
                     fmt::format("Can't write '{}': the layers at {} and {} mm "
                                 "are one in SLC's 32-bit numbers",
                                 output_.path(), last_z_, layer.bottom),
                     {}});
  }
  has_layers_ = true;
  last_z_ = z;
  top_z_ = static_cast<float>(layer.top);

  for (const Vec2& point : layer.contours.points) {
    reach_ = std::max({reach_, std::abs(point.x), std::abs(point.y)});
  }
  contours_ = layer.contours;
  rounder_.round(contours_, layer.clearance);
  append(output_, z);
  append(output_, static_cast<std::uint32_t>(contours_.loop_count()));
  for (std::size_t i = 0; i < contours_.loop_count(); ++i) {
    loop_.clear();
    for (const Vec2& point : contours_.loop(i)) {
      loop_.push_back(
          {static_cast<float>(point.x), static_cast<float>(point.y)});
    }
    extend_by_loop();
    write_loop();
  }
}

void SlcWriter::extend_by_loop() {
  if (!has_extents_) {
    extents_.low[0] = extents_.high[0] = loop_.front().x;
    extents_.low[1] = extents_.high[1] = loop_.front().y;
    has_extents_ = true;
  }
  for (const SlcPoint& point : loop_) {
    extents_.low[0] = std::min(extents_.low[0], point.x);
    extents_.high[0] = std::max(extents_.high[0], point.x);
    extents_.low[1] = std::min(extents_.low[1], point.y);
    extents_.high[1] = std::max(extents_.high[1], point.y);
  }
}

void SlcWriter::write_loop() {
  append(output_, static_cast<std::uint32_t>(loop_.size() + 1));
  append(output_, std::uint32_t{0});  // gaps
  output_.write({reinterpret_cast<const char*>(loop_.data()),
                 loop_.size() * sizeof(SlcPoint)});
  append(output_, loop_.front());
}

void SlcWriter::finish(Diagnostics& diagnostics) {
  // A file without layers is still a file: it has a table, and its top is 0.
  if (!has_layers_) begin_file(Layer{});
  append(output_, top_z_);
  append(output_, kEndOfLayers);
  extents_.high[2] = top_z_;
  write_header(extents_);
  warn_of_coarse_numbers(reach_, diagnostics);
}

}  // namespace lamina::slicer
