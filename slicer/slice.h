#pragma once
// From a scene to layers: blocks of layers stream through a pipeline (cut the
// leaves, move the ray, build loops), in parallel, and leave it in order.

#include "csg/planar/region.h"
#include "csg/scene.h"
#include "ldni/kinetic_ray.h"
#include "parser/diagnostic.h"
#include "slicer/compensate.h"
#include "slicer/layer.h"
#include "slicer/settings.h"

namespace lamina::slicer {

// What a job did (`--report`). Times are processor seconds summed over
// threads.
struct SliceReport {
  ldni::SweepCounts sweep;
  std::uint64_t open_paths =
      0;                       // of leaves' sections, closed: 0 if all is well
  double section_seconds = 0;  // leaves to chains, or to samples
  double sweep_seconds = 0;    // Boolean and contours
  double output_seconds = 0;   // compensation, simplification and writing
  std::uint32_t layers = 0;    // written
  std::uint64_t loops = 0;
  std::uint64_t points = 0;  // written
  CompensationCounts losses;
};

// Same layers for any number of threads. Throws GeometryError if no layer has
// a contour (unless heights were given). Warns of what compensation lost.
SliceReport slice(const csg::Scene& scene, const Settings& settings,
                  LayerSink& sink, Diagnostics& diagnostics);

// The one layer of a 2D design, at height 0, with all its vertices.
SliceReport slice_outline(const planar::Region& outline,
                          const Settings& settings, LayerSink& sink,
                          Diagnostics& diagnostics);

}  // namespace lamina::slicer
