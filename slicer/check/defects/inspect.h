#pragma once
// What layers hold and what is wrong with them: the findings of
// `lamina inspect`, of a file's layers or straight from a design.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "csg/mesh/mesh_facts.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/check/thin/thin_features.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_file.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/supports/support_contacts.h"

namespace lamina::slicer {

struct Inspection {
  struct LayerRow {
    double bottom = 0;     // [mm]
    double thickness = 0;  // [mm]
    LayerMeasures measures;
    double perimeter = 0;  // [mm]
  };

  std::string name;  // of the file or the design
  LayerFileFacts file;
  std::vector<csg::MeshFacts> meshes;  // of a file of meshes: each body
  std::vector<LayerRow> layers;
  Box3 box;  // of all contours and their layers; empty where there are none
  double top = 0;                  // of the part, as the file says [mm]
  double volume = 0;               // [mm³]
  double greatest_coordinate = 0;  // |x| or |y| [mm]

  std::uint64_t defects = 0;
  std::vector<std::string> reported_defects;  // the first ones, in words
  double min_feature = 0;                     // [mm]; 0: not searched for
  std::vector<ThinFeature> features;
  std::optional<PrintCheck> print;          // of the layer graph
  std::optional<SupportMeasures> supports;  // of a design that has them
};

struct InspectOptions {
  // Whether loops are searched for defects.
  bool finds_defects = true;
  // Width below which walls and gaps are reported [mm]; 0: none.
  double min_feature = 0;
  // Whether a layer graph is made; of a design the slicer makes it.
  bool makes_graph = true;
  PrintRules print;
};

// Takes layers in their order and looks at them one by one.
class Inspector : public LayerSink {
 public:
  explicit Inspector(const InspectOptions& options);

  void take(const Layer& layer) override;
  // Takes a layer with its loops as the file holds them.
  void take(const Layer& layer, std::span<const WrittenLoop> loops);
  // What it has found in the layers, which come from a file of such facts.
  Inspection finish(std::string name, LayerFileFacts file);

 private:
  void add_defect(std::string words);
  void add_faulty_loops(const FaultyLoops& loops, std::string_view fault);
  void add_loop_defects(const Layer& layer, std::span<const WrittenLoop> loops);
  void check_heights(const Layer& layer);

  Inspection found_;
  const bool finds_defects_;
  std::optional<ThinFinder> finder_;
  std::optional<FeatureCollector> collector_;
  std::optional<LayerGraph> graph_;
  std::vector<ThinStretch> stretches_;
};

}  // namespace lamina::slicer
