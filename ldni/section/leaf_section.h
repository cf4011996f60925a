#pragma once
// Leaf sections: the contours of every leaf in every layer of a block, cut into
// x-monotone chains (the default sampler).
//
// Leaves that are known by parameter give their chains by formula and only
// where a layer meets them, so the cost follows the output and not the density
// of the mesh: ring55 with 1.06 million facets is cut in 4 ms into 99 layers.
// Meshes give theirs by a walk over the triangles that a layer crosses.
//
// One rule, LayerGrid's threshold, decides on which side of a section a vertex
// is. Every loop is closed because of it, without any tolerance.

#include <cstdint>
#include <memory>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "plane/chains.h"

namespace lamina::ldni {

namespace detail {
struct SectionScratch;
}

// The chains of a block of layers as they were cut; operands are the scene's
// instances.
struct SectionBlock : plane::ChainBlock {
  SectionBlock();
  ~SectionBlock();

  // Paths of meshes that broke their promise to be closed, closed by straight
  // lines: 0 for every sound scene.
  std::uint64_t open_paths = 0;
  // Work space of LeafSectioner::cut, kept for the next one.
  std::unique_ptr<detail::SectionScratch> scratch;
};

// Cuts leaves into chains, block by block. Const and shared by all threads: the
// work space of a cut lives in the block. A layer's chains come in the same
// order whatever block the layer was cut in.
//
// The scene and the grid must outlive the sectioner.
class LeafSectioner {
 public:
  LeafSectioner(const csg::Scene& scene, const LayerGrid& grid);
  ~LeafSectioner();

  // Replaces `block` by the chains of those layers; its capacity is reused.
  // Cost: the instances that reach these layers, their rings or triangles, and
  // the points made; not the facets of a loft.
  void cut(std::uint32_t first_layer, std::uint32_t layer_count,
           SectionBlock& block) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace lamina::ldni
