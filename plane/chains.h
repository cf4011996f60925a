#pragma once
// The chains of a block of layers: what the moving ray is given.
//
// The ray needs from a leaf only its samples from left to right. A chain is
// just that: a polyline that runs to the right, from one local extremum of x to
// the next (a bound of Vatti 1992, turned by 90 degrees).

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::plane {

// Extent in x [mm] of an event cluster of the moving ray: what lies within it
// happens at one x. Edges of chains are wider. Large against the rounding of a
// coordinate (2e-12 mm at 1e4 mm), small against every feature.
inline constexpr double kClusterWidth = 1e-9;

// An x-monotone part of a leaf's contour in a layer, stored by increasing x.
struct Chain {
  std::uint32_t first_point = 0;  // into ChainBlock::points
  std::uint32_t point_count = 0;  // ≥ 2
  std::uint32_t operand = 0;      // into BooleanProgram::operands
  // +1: solid of the leaf lies above (+y of) the chain where the leaf does not
  // overlap itself, -1: below. The winding number changes by this on the way
  // up through the chain.
  std::int32_t winding = 1;

  std::span<const Vec2> points_in(std::span<const Vec2> all) const {
    return all.subspan(first_point, point_count);
  }
};

// y of the points of a chain at an x of their extent; points give their own y
// exactly.
double y_at(std::span<const Vec2> points, double x);

// A closed loop of a leaf in a layer: so many chains, one after another as it
// leads through them; where one ends and the next begins a vertical edge may
// lie between.
struct ChainLoop {
  std::uint32_t chain_count = 0;
  // Chains of winding `orientation` lead to the right, the others to the left.
  std::int32_t orientation = 1;

  bool operator==(const ChainLoop&) const = default;
};

// What the ray is given of one layer. The loops lead through all of the chains
// in their order.
struct LayerChains {
  std::span<const Vec2> points;
  std::span<const Chain> chains;
  std::span<const ChainLoop> loops;
};

// The chains of layers [first_layer, first_layer + layer_count).
struct ChainBlock {
  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 0;
  std::vector<Vec2> points;               // layers may share some
  std::vector<Chain> chains;              // bucketed by layer
  std::vector<std::uint32_t> layer_ends;  // layer i: [ends[i-1], ends[i])
  std::vector<ChainLoop> loops;           // bucketed by layer
  std::vector<std::uint32_t> loop_ends;   // as layer_ends

  std::span<const Chain> layer(std::uint32_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : layer_ends[i - 1];
    return {chains.data() + begin, layer_ends[i] - begin};
  }
  std::span<const ChainLoop> loops_of(std::uint32_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : loop_ends[i - 1];
    return {loops.data() + begin, loop_ends[i] - begin};
  }
  LayerChains chains_of(std::uint32_t i) const {
    return {points, layer(i), loops_of(i)};
  }
  // Whether the layer has the chains of the one before it, point for point, as
  // where all walls are upright; so it has its contours too.
  bool repeats(std::uint32_t i) const;
};

}  // namespace lamina::plane
