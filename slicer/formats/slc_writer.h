#pragma once
// Writes SLC 2.0 (StereoLithography Contour), the format of wax and resin
// machines (docs/formats.md).
//
// Coordinates are float32, to which the loops are rounded so that they stay
// simple and disjoint (round_loops.h).
//
// The header tells the extents, which are known last, and no reader expects
// blanks to fill a gap there. Their numbers therefore have a fixed width,
// filled up with decimals ("10.0000000000"), and are patched at the end.

#include <optional>
#include <string>
#include <vector>

#include "slicer/formats/layer_writer.h"
#include "slicer/round_loops.h"

namespace lamina::slicer {

// A point as the file holds it.
struct SlcPoint {
  float x;
  float y;
  friend bool operator==(const SlcPoint&, const SlcPoint&) = default;
};

class SlcWriter : public LayerWriter {
 public:
  // deviation  as for make_layer_writer(); the header tells it, and what
  //            rounding adds, behind the name of the program
  SlcWriter(OutputFile& output, std::optional<double> deviation);

  // Throws FileError where two layers fall on the same float32 height.
  void take(const Layer& layer) override;
  // Warns where the numbers are too coarse for the design.
  void finish(Diagnostics& diagnostics) override;
  std::uint64_t snapped_layers() const override {
    return rounder_.snapped_layers();
  }
  double greatest_rounding() const override;

 private:
  struct Extents {
    float low[3] = {0, 0, 0};
    float high[3] = {0, 0, 0};
  };

  void begin_file(const Layer& first);
  void extend_by_loop();
  void write_loop();
  void write_header(const Extents& extents);
  std::string package() const;

  OutputFile& output_;
  const std::optional<double> deviation_;
  bool has_layers_ = false;
  float last_z_ = 0;
  float top_z_ = 0;
  bool has_extents_ = false;
  double reach_ = 0;  // greatest coordinate before rounding
  Extents extents_;
  LoopRounder rounder_;
  ldni::Contours contours_;     // of the layer in hand, rounded
  std::vector<SlcPoint> loop_;  // the loop in hand
};

}  // namespace lamina::slicer
