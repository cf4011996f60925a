#pragma once
// Leaf sections: the contours of every leaf in every layer of a block, cut into
// x-monotone chains (the default sampler).
//
// The moving ray needs from a leaf no triangles and no polygon, only its
// samples from left to right. A chain is just that: the depths of one sheet of
// the leaf's surface between two turns, as a polyline. Leaves that are known by
// parameter give their chains by formula and only where a layer meets them, so
// the cost follows the output and not the density of the mesh: ring55 with
// 1.06 million facets is cut in 4 ms into 99 layers. Meshes give theirs by a
// walk over the triangles that a layer crosses.
//
// One rule, LayerGrid's threshold, decides on which side of a section a vertex
// is. Every loop is closed because of it, without any tolerance.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "csg/scene.h"
#include "ldni/section/grid.h"

namespace lamina::ldni {

// An x-monotone piece of a leaf's contour in a layer, stored by increasing x.
// Both ends are turns: local x-minima or x-maxima of the contour.
struct Chain {
  std::uint32_t first_point = 0;  // into ChainBlock::points
  std::uint32_t point_count = 0;  // ≥ 2
  std::uint32_t instance = 0;     // into Scene::instances
  // +1: solid of the leaf lies above (+y of) the chain where the leaf does not
  // overlap itself, -1: below. The winding number changes by this on the way
  // up through the chain.
  std::int32_t winding = 1;

  std::span<const Vec2> points_in(std::span<const Vec2> all) const {
    return all.subspan(first_point, point_count);
  }
};

// A closed loop of a leaf in a layer: so many chains, one after another as it
// leads through them; where one ends and the next begins a vertical edge may
// lie between.
struct ChainLoop {
  std::uint32_t chain_count = 0;
  // Chains of winding `orientation` lead to the right, the others to the left.
  std::int32_t orientation = 1;

  bool operator==(const ChainLoop&) const = default;
};

// Extent in x [mm] of a stop of the kinetic ray: what lies within it
// happens at one x. Edges of chains are wider. Large against the rounding of a
// coordinate (2e-12 mm at 1e4 mm), small against every feature.
inline constexpr double kColumnWidth = 1e-9;

namespace detail {
struct SectionScratch;
}

// The chains of layers [first_layer, first_layer + layer_count).
struct ChainBlock {
  ChainBlock();
  ~ChainBlock();
  ChainBlock(ChainBlock&&) noexcept;
  ChainBlock& operator=(ChainBlock&&) noexcept;

  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 0;
  std::vector<Vec2> points;               // layers may share some
  std::vector<Chain> chains;              // bucketed by layer
  std::vector<std::uint32_t> layer_ends;  // layer i: [ends[i-1], ends[i])
  std::vector<ChainLoop> loops;           // bucketed by layer
  std::vector<std::uint32_t> loop_ends;   // as layer_ends
  // Paths of meshes that broke their promise to be closed, closed by straight
  // lines: 0 for every sound scene.
  std::uint64_t open_paths = 0;
  // What a cut needs on the side; kept for the next one.
  std::unique_ptr<detail::SectionScratch> scratch;

  std::span<const Chain> layer(std::uint32_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : layer_ends[i - 1];
    return {chains.data() + begin, layer_ends[i] - begin};
  }
  // Whether the layer has the chains of the one before it, point for point, as
  // where all walls are upright; so it has its contours too.
  bool repeats(std::uint32_t i) const;
  // All chains of the layer, in their order.
  std::span<const ChainLoop> loops_of(std::uint32_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : loop_ends[i - 1];
    return {loops.data() + begin, loop_ends[i] - begin};
  }
};

// Cuts leaves into chains, block by block. Const and shared by all threads;
// what a cut needs on the side lives in the block. A layer's chains come in
// the same order whatever block the layer was cut in.
//
// The scene and the grid must outlive the sectioner.
class LeafSectioner {
 public:
  LeafSectioner(const csg::Scene& scene, const LayerGrid& grid);
  ~LeafSectioner();
  LeafSectioner(const LeafSectioner&) = delete;
  LeafSectioner& operator=(const LeafSectioner&) = delete;

  // Replaces `block` by the chains of those layers; its capacity is reused.
  // Cost: the instances that reach these layers, their rings or triangles, and
  // the points made; not the facets of a loft.
  void cut(std::uint32_t first_layer, std::uint32_t layer_count,
           ChainBlock& block) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace lamina::ldni
