#pragma once
// From a block of layers to contours, in either contour mode.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "plane/contours.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/slice/settings.h"
#include "slicer/slice/slice.h"

namespace lamina::slicer {

// What makes contours of a block of layers on one thread: the back end of a
// contour mode.
class BlockSlicer {
 public:
  virtual ~BlockSlicer() = default;
  // Cuts all leaves in these layers; forgets the block before.
  virtual void section(std::uint32_t first_layer,
                       std::uint32_t layer_count) = 0;
  // Whether layer `index` of the block has the loops of the one before it.
  virtual bool repeats(std::uint32_t /*index*/) const { return false; }
  // Whether a leaf's section in layer `index` of the block may reach into the
  // box.
  virtual bool reaches(std::uint32_t /*index*/, const Box2& /*box*/) const {
    return true;
  }
  // Replaces `contours` by the loops of layer `index` of the block.
  virtual void make_contours(std::uint32_t index,
                             plane::Contours& contours) = 0;
  // Finds the leaves beside the layer's thin places, if the mode knows them.
  virtual void find_leaves(std::uint32_t /*index*/,
                           std::span<ThinStretch> /*stretches*/) {}
  // Adds its counts.
  virtual void report_to(SliceReport& report) const = 0;
};

// Layers of a block share the walk over the leaves, so few large blocks are
// cheap; many small ones keep all threads busy and memory low.
struct BlockSizes {
  std::uint32_t smallest;  // layers
  std::uint32_t largest;
  std::uint32_t wanted_blocks;

  // The number of blocks, which depends on the job alone and not on the number
  // of threads.
  std::uint32_t count(std::uint32_t layer_count) const {
    const std::uint32_t size =
        std::min(largest, std::max(layer_count / wanted_blocks, smallest));
    return (layer_count + size - 1) / size;
  }
};

// What a job's threads share, and how each gets a slicer of its own.
struct Plan {
  BlockSizes blocks;
  std::function<std::unique_ptr<BlockSlicer>()> make_slicer;
  std::string renderer;  // as of SliceReport
};

// scene and grid must outlive the plan.
Plan plan_blocks(const csg::Scene& scene, const Settings& settings,
                 const ldni::LayerGrid& grid);

}  // namespace lamina::slicer
