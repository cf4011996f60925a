#pragma once
// Cuts closed loops at their local extrema of x into x-monotone chains.
//
// An edge that is vertical, or as good as (|dx| < kClusterWidth), belongs to no
// chain: rounding would otherwise give it a direction, and a wall that two
// leaves share would become two steep chains that cross. Its ends get one x,
// exactly, so that the chain before and the chain after it meet in one event
// cluster of the kinetic ray whatever else happens there (invariant I1).

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"

namespace lamina::plane {

class ChainBuilder {
 public:
  // Starts a block; what `block` held is dropped, its capacity kept.
  void begin(ChainBlock& block);

  // The loop under construction: points in walking order.
  std::vector<Vec2>& loop() { return loop_; }

  // Cuts the loop into chains of layer `layer` (counted from the block's
  // first) and empties it. orientation: +1 where the leaf is on the left of
  // the loop, -1 on the right.
  void close_loop(std::uint32_t layer, std::uint32_t operand,
                  std::int32_t orientation);

  // Adds the loop that was closed last to another layer as well, with the same
  // points.
  void repeat_loop(std::uint32_t layer);

  // Buckets the chains and loops by layer.
  void finish(ChainBlock& block);

 private:
  bool is_wide() const;
  void snap_verticals();
  bool cut(std::vector<Vec2>& loop, double vertical_width, std::uint32_t layer,
           Chain chain, std::int32_t orientation);
  void add_chain(std::span<const Vec2> run, bool is_forward, Chain chain,
                 std::uint32_t layer);

  ChainBlock* block_ = nullptr;
  std::vector<Vec2> loop_;
  std::vector<Vec2> snapped_;
  std::vector<Chain> chains_;          // in the order they were made
  std::vector<std::uint32_t> layers_;  // of chains_
  std::vector<ChainLoop> loops_;
  std::vector<std::uint32_t> loop_layers_;  // of loops_
  std::uint32_t last_chain_count_ = 0;      // of the loop closed last
};

}  // namespace lamina::plane
