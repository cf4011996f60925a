#pragma once
// A look inside: what one layer is between two stages.
//
//   scene     leaves, instances and the Boolean program; which meet the layer
//   chains    the sections of those leaves, as the moving ray gets them
//   events    the event points of the ray: what begins, ends, swaps and ties,
//             and where boundary begins and ends
//   contours  what the ray returns, and the leaf of each edge
//
// A wrong contour is found by halving: if the chains are right, the fault is in
// the sweep, else in what comes before (docs/wrong-contour.md). The layer is
// computed anew by the functions that a run calls, so that a run pays nothing
// for dumps.
//
// A stage becomes a list of items, each a line of text with a shape. The text
// has every digit, for diff and for tests. The drawing is an SVG of the same
// items, over the contours of the layer; browsers show an item's line where the
// mouse is.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "csg/scene.h"
#include "ldni/section/grid.h"

namespace lamina::slicer {

enum class DumpStage : std::uint8_t { kScene, kChains, kEvents, kContours };
inline constexpr std::array<std::string_view, 4> kDumpStages = {
    "scene", "chains", "events", "contours"};

// Returns the line of the design that made an instance.
using LineOf = std::string (*)(const csg::Instance& instance);

struct DumpRequest {
  DumpStage stage = DumpStage::kScene;
  double z = 0;             // in the layer that is dumped [mm]
  bool is_drawing = false;  // SVG instead of text
  LineOf line_of = nullptr;
};

// Throws GeometryError where no layer of the grid holds the height; where
// layers have no thickness it must be that of a section.
std::string dump_layer(const csg::Scene& scene, const ldni::LayerGrid& grid,
                       const DumpRequest& request);

}  // namespace lamina::slicer
