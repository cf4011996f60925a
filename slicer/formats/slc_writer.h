#pragma once
// Writes SLC 2.0 (StereoLithography Contour), the format of wax and resin
// machines (docs/formats.md).
//
// Coordinates are float32: near 100 mm two neighbours are 8e-6 mm apart. So
// every point is rounded first and judged afterwards: points that fell on
// their neighbour are dropped, spikes that lead back to where they came from
// too, and loops that lost their area. Some readers take a repeat for a gap.
//
// The header tells the extents, which are known last, and no reader expects
// blanks to fill a gap there. Their numbers therefore have a fixed width,
// filled up with decimals ("10.0000000000"), and are patched at the end.

#include <cstdint>
#include <span>
#include <vector>

#include "slicer/formats/layer_writer.h"

namespace lamina::slicer {

// A point as the file holds it.
struct SlcPoint {
  float x;
  float y;
  friend bool operator==(const SlcPoint&, const SlcPoint&) = default;
};

class SlcWriter : public LayerWriter {
 public:
  explicit SlcWriter(OutputFile& output);

  // Throws FileError where two layers fall on the same float32 height.
  void take(const Layer& layer) override;
  void finish() override;

 private:
  struct Extents {
    float low[3] = {0, 0, 0};
    float high[3] = {0, 0, 0};
  };

  void begin_file(const Layer& first);
  void round_loop(std::span<const Vec2> loop);
  void extend_by_loop();
  void write_loop(std::span<const SlcPoint> loop);
  void write_header(const Extents& extents);

  OutputFile& output_;
  bool has_layers_ = false;
  float last_z_ = 0;
  float top_z_ = 0;
  bool has_extents_ = false;
  Extents extents_;
  std::uint64_t row_offset_ = 0;     // of the sampling table
  std::vector<SlcPoint> loop_;       // the loop in hand, rounded
  std::vector<SlcPoint> points_;     // of the layer in hand
  std::vector<std::uint32_t> ends_;  // of its loops
};

}  // namespace lamina::slicer
