#pragma once
// Leaves that lie within others are left out of a layer.
//
// Where many solids overlap, most of them are hidden: a grain in a heap shows
// only if it sticks out of the heap. Within a leaf that an operator unites, the
// operator holds whatever else is below it; within one that it subtracts, it
// does not. So a leaf of a layer that lies within such leaves of operators
// above it changes nothing, and it goes before the layer is swept. Those that
// cover it stay: leaves are asked from the largest to the smallest, each
// against those that stayed, so no two leaves cover each other.
//
// "Within" is asked in a grid for each operator of many leaves. A cell counts
// as covered where it lies in one leaf as a whole, and a leaf is covered where
// all cells are that it touches. Both err to the side of leaves that stay. A
// margin keeps what ties with a leaf's border from being covered by it. The
// cost is that of the layer's points and of the columns of cells that each leaf
// crosses.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/cascade/leaf_parts.h"
#include "plane/chains.h"
#include "plane/program/boolean_program.h"

namespace lamina::plane {

class CoveredLeaves {
 public:
  // The program must outlive the object.
  explicit CoveredLeaves(const BooleanProgram& program) : program_(program) {}

  // The layer, whose chains are those of the program's operands, without leaves
  // that are covered. Valid until the next call, as long as the layer is.
  LayerChains leave_out(const LayerChains& layer);

 private:
  static constexpr int kRows = 256;
  // One bit for each row of cells.
  using ColumnBits = std::array<std::uint64_t, kRows / 64>;
  // An extent along y; empty where low > high.
  struct Reach {
    double low = 1e300;
    double high = -1e300;
  };
  // The cells of an operator.
  struct Grid {
    std::uint32_t leaf_count = 0;  // that may cover others
    Box2 box;                      // around them
    double column_width = 0;
    double row_height = 0;
    std::vector<ColumnBits> covered;

    int column_of(double x) const;
    double left_of(int column) const {
      return box.low.x + column * column_width;
    }
  };

  void make_grids(std::span<const LeafPart> parts);
  Grid* grid_of_coverer(std::uint32_t operand);
  bool is_covered(const LeafPart& part);
  bool is_covered(const LeafPart& part, const Grid& grid);
  void cover(const LeafPart& part, Grid& grid);
  // Calls visit(column, reach) for the cells that a chain touches, in any
  // order; a column may come several times.
  template <typename Visit>
  void visit_columns(const Chain& chain, const Grid& grid,
                     const Visit& visit) const;

  const BooleanProgram& program_;
  std::span<const Vec2> points_;
  std::vector<Grid> grids_;
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> grid_of_node_;  // or kNone
  std::vector<std::uint32_t> parents_;       // nearest node above with a grid
  std::vector<Reach> reach_;                 // work space, by column
  std::vector<std::array<Reach, 2>> sides_;  // likewise

  std::vector<Chain> chains_;
  std::vector<ChainLoop> loops_;
};

}  // namespace lamina::plane
