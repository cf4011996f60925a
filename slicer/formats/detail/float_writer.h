#pragma once
// What the writers of float32 contours (SLC, CLI, SVG, 3MF) have in common.

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "plane/contours.h"
#include "plane/loop_area.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/round_loops.h"
#include "slicer/formats/detail/writers.h"

namespace lamina::slicer {

// A point as the file holds it.
struct FloatPoint {
  float x;
  float y;
};

// The contours of layers in float32 numbers, rounded so that loops stay simple
// and disjoint (round_loops.h). What headers say of all layers together is
// gathered meanwhile.
class FloatContours {
 public:
  // Replaces the layer.
  void take(const Layer& layer);

  // The loops of the layer. The last point of loop() repeats its first;
  // open_loop() is without it.
  std::size_t loop_count() const { return ends_.size(); }
  std::span<const FloatPoint> loop(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return {points_.data() + begin, ends_[i] - begin};
  }
  std::span<const FloatPoint> open_loop(std::size_t i) const {
    return loop(i).first(loop(i).size() - 1);
  }
  bool is_hole(std::size_t i) const {
    return signed_area(rounded_.loop(i)) < 0;
  }

  // Box of all layers taken; (0, 0) to (0, 0) where no layer had a loop.
  FloatPoint low() const { return low_; }
  FloatPoint high() const { return high_; }

  // Greatest distance that rounding moved a point by, so far [mm].
  double greatest_rounding() const;
  // Layers that needed more than rounding each point (round_loops.h).
  std::uint64_t snapped_layers() const { return rounder_.snapped_layers(); }

  // Warns where float32 numbers are too coarse for what was taken.
  // format  as messages name it: "SLC"
  void warn_of_coarse_numbers(std::string_view format,
                              Diagnostics& diagnostics) const;

 private:
  void extend();

  LoopRounder rounder_;
  // The last layer, where it took work to round it.
  bool is_kept_ = false;
  double clearance_ = 0;
  plane::Contours taken_;
  plane::Contours rounded_;
  std::vector<FloatPoint> points_;
  std::vector<std::size_t> ends_;
  bool has_loops_ = false;  // so far
  FloatPoint low_ = {0, 0};
  FloatPoint high_ = {0, 0};
  double reach_ = 0;  // greatest coordinate before rounding
};

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
