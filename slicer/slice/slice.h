#pragma once
// From a scene to layers: blocks of layers pass through a pipeline (cut the
// leaves, move the ray, build loops) in parallel and leave it in order.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "csg/scene.h"
#include "ldni/image/paper_counts.h"
#include "ldni/section/grid.h"
#include "plane/cascade/kinetic_ray.h"
#include "plane/region/region.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/check/thin/thin_features.h"
#include "slicer/contour/compensate.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/slice/settings.h"
#include "slicer/supports/support_contacts.h"

namespace lamina::slicer {

// Thrown where there is nothing to slice, in OpenSCAD's words.
struct EmptyDesign : GeometryError {
  EmptyDesign() : GeometryError("Current top level object is empty.") {}
};

// What a job did (`--report`). Times are processor seconds summed over
// threads.
struct SliceReport {
  plane::SweepCounts sweep;
  ldni::PaperCounts paper;  // all 0 but for the paper's contours
  std::string renderer;     // what drew, if OpenGL did
  // Gaps in sections of leaves that had to be closed: 0 if all is well.
  std::uint64_t open_paths = 0;
  double section_seconds = 0;      // leaves to chains, or to samples
  double sweep_seconds = 0;        // Boolean and contours
  double feature_seconds = 0;      // search for thin places
  double graph_seconds = 0;        // layer graph
  double output_seconds = 0;       // compensation, simplification and writing
  std::uint32_t layers = 0;        // written
  std::uint32_t layers_there = 0;  // written or not
  std::uint64_t loops = 0;
  std::uint64_t holes = 0;   // of the loops
  std::uint64_t points = 0;  // written
  double volume = 0;         // of the layers [mm³]; 0 for --heights
  double greatest_area = 0;  // of a layer [mm²]
  Box3 box;                  // of all contours and their layers
  CompensationCounts losses;
  std::vector<ThinFeature> features;  // thinner than Settings::min_feature
  // What the layer graph found; nothing where makes_whole_print() is false.
  std::optional<PrintCheck> print;
  // Of the design's supports; nothing where it has none.
  std::optional<SupportMeasures> supports;

  // Counts a layer that is written.
  void add(const LayerMeasures& layer, double bottom, double top);
};

// Where the layers of a scene stand. Throws GeometryError where the scene is
// empty (unless heights were given) or would have too many layers.
ldni::LayerGrid plan_layers(const csg::Scene& scene, const Settings& settings);

// Gives the same layers for any number of threads. Throws GeometryError if no
// wanted layer has a contour (unless heights were given). Warns of what
// compensation lost.
//
// grid  of plan_layers()
SliceReport slice(const csg::Scene& scene, const ldni::LayerGrid& grid,
                  const Settings& settings, LayerSink& sink,
                  Diagnostics& diagnostics);

// All layers, for what plans by them: what slicing says is dropped, since the
// run itself says it. Throws as slice() does.
std::vector<Layer> all_layers(const csg::Scene& scene,
                              const Settings& settings);

// The same in layers of one thickness, with all else as usual; none of a scene
// in which nothing is left.
//
// asked  its thickness of layers and its threads
std::vector<Layer> layers_or_none(const csg::Scene& scene,
                                  const Settings& asked);

// The one layer of a 2D design, at height 0, with all its vertices. It has no
// foot.
SliceReport slice_outline(const plane::Region& outline,
                          const Settings& settings, LayerSink& sink,
                          Diagnostics& diagnostics);

}  // namespace lamina::slicer
