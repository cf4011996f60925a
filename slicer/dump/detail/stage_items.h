#pragma once
// The stages of one layer, computed anew, item by item.

#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"
#include "csg/scene.h"
#include "ldni/section/leaf_section.h"
#include "plane/contours.h"
#include "slicer/dump/layer_dump.h"

namespace lamina::slicer {

enum class DumpShape : std::uint8_t {
  kNone,
  kLine,   // through the points, which the text lists, too
  kFrame,  // the same, dashed, and not in the text
  kMarks,  // a mark at each point
};

struct DumpItem {
  std::string text;  // a line, or several, without the last '\n'
  DumpShape shape = DumpShape::kNone;
  std::vector<Vec2> points{};
  std::uint32_t instance = 0;  // whose colour the shape has
};

// A layer of the grid, cut and swept.
struct DumpedLayer {
  // The scene must outlive the object.
  DumpedLayer(const csg::Scene& its_scene, const ldni::LayerGrid& grid,
              std::uint32_t number, LineOf leaf_line);

  const csg::Scene& scene;
  const plane::BooleanProgram program;
  const LineOf line_of;
  ldni::SectionBlock block;
  plane::LayerChains chains;
  plane::Contours contours;
};

std::vector<DumpItem> stage_items(const DumpedLayer& layer, DumpStage stage);

}  // namespace lamina::slicer
