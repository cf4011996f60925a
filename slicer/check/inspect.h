#pragma once
// `lamina inspect`: what layers hold and what is wrong with them, in a file or
// straight from a design.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "slicer/check/thin_features.h"
#include "slicer/check/thin_finder.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/formats/slc_reader.h"

namespace lamina::slicer {

struct Inspection {
  struct LayerRow {
    double bottom = 0;     // [mm]
    double thickness = 0;  // [mm]
    LayerMeasures measures;
  };

  std::string name;    // of the file or the design
  std::string format;  // "SLC 2.0"; empty: layers of a design
  std::string writer;  // program; empty: not told
  // Of SLC only: a line of words, the table, and the header's extents
  // (low and high of x, y, z, in the file's unit).
  std::string header;
  std::vector<SlcSampling> sampling;
  std::optional<std::array<Vec2, 3>> extents;

  std::vector<LayerRow> layers;
  Box3 box;  // of all contours and their layers; empty where there are none
  double top = 0;         // of the part, as the file says [mm]
  double volume = 0;      // [mm³]
  bool has_sides = true;  // LayerFileFacts
  std::uint64_t lines_left_out = 0;
  std::optional<double> deviation;  // from the design's sections [mm]
  double greatest_coordinate = 0;   // |x| or |y| [mm]
  bool is_float32 = true;

  std::uint64_t defects = 0;
  std::vector<std::string> told_defects;  // the first ones, in words
  double min_feature = 0;                 // [mm]; 0: not looked for
  std::vector<ThinFeature> features;
};

// Takes layers in their order and looks at them one by one.
class Inspector : public LayerSink {
 public:
  // min_feature  width below which walls and gaps are told [mm]; 0: none are
  explicit Inspector(double min_feature);

  void take(const Layer& layer) override;
  // What it has found.
  Inspection finish();

 private:
  friend Inspection inspect_file(const std::string& path, double min_feature,
                                 const FileAccess& access);

  void take(const Layer& layer, const SlcLayer& boundaries);
  void add_defect(std::string words);

  Inspection found_;
  std::optional<ThinFinder> finder_;
  std::optional<FeatureCollector> collector_;
  std::vector<ThinStretch> stretches_;
};

// Reads the file layer by layer. Throws FileError where it is no file of layers
// (layer_reader.h) or breaks off.
Inspection inspect_file(const std::string& path, double min_feature,
                        const FileAccess& access);

}  // namespace lamina::slicer
