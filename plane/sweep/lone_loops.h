#pragma once
// Convex loops of a layer that no other boundary comes near.
//
// In many layers of a lattice most struts are cut across, far from each other.
// Within the box of such a loop the leaf's own boundary is all there is: so the
// state of the program around it decides whether the loop is boundary of the
// solid, as a whole or not at all. The ray looks that up where the loop begins
// and passes over it: no entries, no certificates, no events.
//
// A coarse grid over the layer finds them. Small convex loops claim the cells
// of their boxes; all other edges, vertical ones too, block the cells that they
// pass. A loop is alone where all its cells are its own.

#include <cstdint>
#include <span>
#include <vector>

#include "plane/chains.h"
#include "plane/program/program_states.h"

namespace lamina::plane {

class LoneLoops {
 public:
  // Finds the lone loops of a layer and forgets those of the one before.
  void find(const LayerChains& layer, const ProgramStates& states);

  // Both take the number of a chain in the layer.
  bool is_lone(std::uint32_t chain) const { return sides_[chain] != kNoSide; }
  bool is_lower(std::uint32_t chain) const { return sides_[chain] == kLower; }

 private:
  enum Side : std::uint8_t { kNoSide, kLower, kUpper };
  // Cells of a box, both ends included.
  struct Cells {
    std::int32_t first_column = 0;
    std::int32_t last_column = 0;
    std::int32_t first_row = 0;
    std::int32_t last_row = 0;
  };
  struct Candidate {
    Box2 box;
    Cells cells;
    std::uint32_t loop = 0;   // of the layer
    std::uint32_t chain = 0;  // the first of its two
  };

  bool is_worthwhile(std::span<const ChainLoop> loops) const;
  void list_candidates(std::span<const ChainLoop> loops,
                       const ProgramStates& states);
  void find_box(Candidate& candidate) const;
  void lay_grid();
  void claim_boxes();
  bool is_alone(std::uint32_t candidate) const;
  Side side_of(const Candidate& candidate) const;
  void block_edges(std::span<const ChainLoop> loops);
  void block(const Vec2& from, const Vec2& to);
  std::int32_t column_of(double x) const;
  std::int32_t row_of(double y) const;
  std::size_t index_of(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(column) * row_count_ +
           static_cast<std::size_t>(row);
  }

  std::vector<std::uint8_t> sides_;  // of the layer's chains

  // The present layer.
  std::span<const Vec2> points_;
  std::span<const Chain> chains_;
  std::vector<Candidate> candidates_;
  Box2 box_;  // of the grid, which holds all candidates
  double cells_per_mm_ = 0;
  std::size_t column_count_ = 0;
  std::size_t row_count_ = 0;
  std::vector<std::uint32_t> owners_;  // of cells: a candidate, or one of two:
  static constexpr std::uint32_t kFree = 0xffffffff;
  static constexpr std::uint32_t kBlocked = 0xfffffffe;
};

}  // namespace lamina::plane
