#include "slicer/formats/slc_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "parser/diagnostic.h"
#include "slicer/version.h"

namespace lamina::slicer {
namespace {

static_assert(std::endian::native == std::endian::little,
              "SLC is little-endian and is written as it lies in memory");

constexpr std::size_t kReservedSize = 256;
constexpr std::uint32_t kEndOfLayers = 0xFFFFFFFF;

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

// Twice the area, exactly 0 for a loop that runs there and back again.
bool has_no_area(std::span<const SlcPoint> loop) {
  double doubled = 0;
  SlcPoint previous = loop.back();
  const double x0 = previous.x;
  const double y0 = previous.y;
  for (const SlcPoint& point : loop) {
    doubled +=
        (previous.x - x0) * (point.y - y0) - (point.x - x0) * (previous.y - y0);
    previous = point;
  }
  return doubled == 0;
}

template <typename Value>
void append(OutputFile& output, const Value& value) {
  output.write({reinterpret_cast<const char*>(&value), sizeof(value)});
}

}  // namespace

SlcWriter::SlcWriter(OutputFile& output) : output_(output) {}

void SlcWriter::write_header(const Extents& extents) {
  const auto& [low, high] = extents;
  const std::string header = fmt::format(
      "-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE lamina {} -EXTENTS "
      "{},{} {},{} {},{}\r\n\x1A",
      version(), fixed_width(low[0]), fixed_width(high[0]), fixed_width(low[1]),
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

  points_.clear();
  ends_.clear();
  for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
    round_loop(layer.contours.loop(i));
    if (loop_.size() < 3) continue;
    extend_by_loop();
    points_.insert(points_.end(), loop_.begin(), loop_.end());
    ends_.push_back(static_cast<std::uint32_t>(points_.size()));
  }
  append(output_, z);
  append(output_, static_cast<std::uint32_t>(ends_.size()));
  std::size_t begin = 0;
  for (const std::uint32_t end : ends_) {
    write_loop({points_.data() + begin, end - begin});
    begin = end;
  }
}

void SlcWriter::round_loop(std::span<const Vec2> loop) {
  loop_.clear();
  for (const Vec2& exact : loop) {
    // Adding 0 turns -0 to 0: equal points shall have equal bytes.
    const SlcPoint point{static_cast<float>(exact.x) + 0.0F,
                         static_cast<float>(exact.y) + 0.0F};
    if (!loop_.empty() && loop_.back() == point) continue;
    if (loop_.size() >= 2 && loop_[loop_.size() - 2] == point) {
      loop_.pop_back();  // a spike
      continue;
    }
    loop_.push_back(point);
  }
  // The same two rules where the end meets the beginning.
  std::size_t begin = 0;
  std::size_t end = loop_.size();
  while (end - begin >= 3) {
    if (loop_[end - 1] == loop_[begin] || loop_[end - 2] == loop_[begin]) {
      --end;
    } else if (loop_[end - 1] == loop_[begin + 1]) {
      ++begin;
    } else {
      break;
    }
  }
  loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(end), loop_.end());
  loop_.erase(loop_.begin(),
              loop_.begin() + static_cast<std::ptrdiff_t>(begin));
  if (loop_.size() < 3 || has_no_area(loop_)) loop_.clear();
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

void SlcWriter::write_loop(std::span<const SlcPoint> loop) {
  append(output_, static_cast<std::uint32_t>(loop.size() + 1));
  append(output_, std::uint32_t{0});  // gaps
  output_.write(
      {reinterpret_cast<const char*>(loop.data()), loop.size_bytes()});
  append(output_, loop.front());
}

void SlcWriter::finish() {
  // A file without layers is still a file: it has a table, and its top is 0.
  if (!has_layers_) begin_file(Layer{});
  append(output_, top_z_);
  append(output_, kEndOfLayers);
  extents_.high[2] = top_z_;
  write_header(extents_);
}

}  // namespace lamina::slicer
