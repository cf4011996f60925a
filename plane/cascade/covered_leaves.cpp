#include "plane/cascade/covered_leaves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "plane/program/program_state.h"
#include "plane/tie_distance.h"

namespace lamina::plane {
namespace {

// What is nearer than this [mm] to a leaf's border is not covered by it.
constexpr double kCoverMargin = 16 * kTieDistance;

// An operator has a grid where at least so many leaves may cover others.
constexpr std::uint32_t kFewestLeaves = 16;

// Columns: one for so many leaves, within limits.
constexpr std::uint32_t kLeavesPerColumn = 4;
constexpr std::uint32_t kFewestColumns = 32;
constexpr std::uint32_t kMostColumns = 256;

// Operators above a leaf that are asked, from the nearest one on.
constexpr int kMostGrids = 4;

// Whether the operator above has the same value wherever the leaf is, whatever
// else is below it.
bool decides_its_operator(const BooleanProgram& program, const Operand& leaf) {
  return program.nodes[leaf.parent].op == BooleanOp::kUnion ||
         is_subtrahend(program.nodes, leaf);
}

// Calls visit(word, mask) for the words of a column's bits that rows [begin,
// end) lie in.
template <typename Visit>
void visit_words(int begin, int end, const Visit& visit) {
  constexpr int kBits = 64;
  for (int word = begin / kBits; word * kBits < end; ++word) {
    const int low = std::max(begin - word * kBits, 0);
    const int high = std::min(end - word * kBits, kBits);
    const std::uint64_t below_high =
        high == kBits ? ~std::uint64_t{0} : (std::uint64_t{1} << high) - 1;
    visit(static_cast<std::size_t>(word),
          below_high & ~((std::uint64_t{1} << low) - 1));
  }
}

}  // namespace

int CoveredLeaves::Grid::column_of(double x) const {
  const double column = std::floor((x - box.low.x) / column_width);
  return static_cast<int>(
      std::clamp(column, 0.0, static_cast<double>(covered.size()) - 1.0));
}

LayerChains CoveredLeaves::leave_out(const LayerChains& layer) {
  points_ = layer.points;
  const std::vector<LeafPart> parts = leaf_parts(layer);
  make_grids(parts);
  if (grids_.empty()) return layer;
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&parts](std::uint32_t i) {
                             const Vec2 size = parts[i].box.size();
                             return size.x * size.y;
                           });
  std::vector<bool> stays(parts.size());
  for (const std::uint32_t i : order) {
    const LeafPart& part = parts[i];
    stays[i] = !is_covered(part);
    Grid* grid = stays[i] ? grid_of_coverer(part.operand) : nullptr;
    if (grid != nullptr) cover(part, *grid);
  }
  chains_.clear();
  loops_.clear();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!stays[i]) continue;
    const LeafPart& part = parts[i];
    chains_.insert(chains_.end(), part.chains.begin(), part.chains.end());
    loops_.insert(loops_.end(), part.loops.begin(), part.loops.end());
  }
  return {layer.points, chains_, loops_};
}

void CoveredLeaves::make_grids(std::span<const LeafPart> parts) {
  const std::vector<BooleanNode>& program = program_.nodes;
  std::vector<Grid> all(program.size());
  for (const LeafPart& part : parts) {
    const Operand& operand = program_.operands[part.operand];
    if (!decides_its_operator(program_, operand)) continue;
    Grid& grid = all[operand.parent];
    ++grid.leaf_count;
    grid.box.add(part.box);
  }
  grids_.clear();
  grid_of_node_.assign(program.size(), kNone);
  parents_.assign(program.size(), kNone);
  for (std::uint32_t node = 0; node < program.size(); ++node) {
    // Parents come before their children.
    const std::uint32_t parent = program[node].parent;
    if (node > 0) {
      parents_[node] =
          grid_of_node_[parent] != kNone ? parent : parents_[parent];
    }
    Grid& grid = all[node];
    if (grid.leaf_count < kFewestLeaves ||
        std::min(grid.box.size().x, grid.box.size().y) < kCoverMargin) {
      continue;
    }
    const std::uint32_t columns = std::clamp(grid.leaf_count / kLeavesPerColumn,
                                             kFewestColumns, kMostColumns);
    grid.covered.resize(columns);
    grid.column_width = grid.box.size().x / columns;
    grid.row_height = grid.box.size().y / kRows;
    grid_of_node_[node] = static_cast<std::uint32_t>(grids_.size());
    grids_.push_back(std::move(grid));
  }
}

// The grid of the operator that the leaf decides; null where there is none.
CoveredLeaves::Grid* CoveredLeaves::grid_of_coverer(std::uint32_t operand) {
  const Operand& leaf = program_.operands[operand];
  const std::uint32_t grid = grid_of_node_[leaf.parent];
  return grid != kNone && decides_its_operator(program_, leaf) ? &grids_[grid]
                                                               : nullptr;
}

bool CoveredLeaves::is_covered(const LeafPart& part) {
  std::uint32_t node = program_.operands[part.operand].parent;
  if (grid_of_node_[node] == kNone) node = parents_[node];
  for (int asked = 0; asked < kMostGrids && node != kNone; ++asked) {
    if (is_covered(part, grids_[grid_of_node_[node]])) return true;
    node = parents_[node];
  }
  return false;
}

template <typename Visit>
void CoveredLeaves::visit_columns(const Chain& chain, const Grid& grid,
                                  const Visit& visit) const {
  const auto points = chain.points_in(points_);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 from = points[i];
    const Vec2 to = points[i + 1];
    const double slope = (to.y - from.y) / (to.x - from.x);
    const auto y_at = [&](double x) {
      return from.y + slope * (std::clamp(x, from.x, to.x) - from.x);
    };
    const int last = grid.column_of(to.x + kCoverMargin);
    for (int column = grid.column_of(from.x - kCoverMargin); column <= last;
         ++column) {
      const double left = y_at(grid.left_of(column) - kCoverMargin);
      const double right = y_at(grid.left_of(column + 1) + kCoverMargin);
      visit(column, Reach{std::min(left, right), std::max(left, right)});
    }
  }
}

bool CoveredLeaves::is_covered(const LeafPart& part, const Grid& grid) {
  if (!grid.box.holds(part.box)) return false;
  const int first = grid.column_of(part.box.low.x - kCoverMargin);
  const int last = grid.column_of(part.box.high.x + kCoverMargin);
  reach_.assign(static_cast<std::size_t>(last - first) + 1, Reach());
  for (const Chain& chain : part.chains) {
    visit_columns(chain, grid, [&](int column, const Reach& reach) {
      Reach& own = reach_[static_cast<std::size_t>(column - first)];
      own.low = std::min(own.low, reach.low);
      own.high = std::max(own.high, reach.high);
    });
  }
  for (int column = first; column <= last; ++column) {
    const Reach& own = reach_[static_cast<std::size_t>(column - first)];
    if (own.low > own.high) continue;
    const auto row_of = [&](double y) {
      return static_cast<int>(
          std::clamp(std::floor((y - grid.box.low.y) / grid.row_height), 0.0,
                     kRows - 1.0));
    };
    const ColumnBits& bits = grid.covered[static_cast<std::size_t>(column)];
    bool is_full = true;
    visit_words(row_of(own.low - kCoverMargin),
                row_of(own.high + kCoverMargin) + 1,
                [&](std::size_t word, std::uint64_t mask) {
                  is_full = is_full && (bits[word] & mask) == mask;
                });
    if (!is_full) return false;
  }
  return true;
}

// Marks the cells between the two chains of a leaf that is one loop of two.
void CoveredLeaves::cover(const LeafPart& part, Grid& grid) {
  if (part.loops.size() != 1 || part.chains.size() != 2) return;
  const int first = grid.column_of(part.box.low.x);
  const int last = grid.column_of(part.box.high.x);
  sides_.assign(static_cast<std::size_t>(last - first) + 1, {});
  for (std::size_t i = 0; i < 2; ++i) {
    visit_columns(part.chains[i], grid, [&](int column, const Reach& reach) {
      if (column < first || column > last) return;
      Reach& own = sides_[static_cast<std::size_t>(column - first)][i];
      own.low = std::min(own.low, reach.low);
      own.high = std::max(own.high, reach.high);
    });
  }
  for (int column = first; column <= last; ++column) {
    if (grid.left_of(column) < part.box.low.x + kCoverMargin ||
        grid.left_of(column + 1) > part.box.high.x - kCoverMargin) {
      continue;
    }
    const auto& [one, other] = sides_[static_cast<std::size_t>(column - first)];
    const double low = std::min(one.high, other.high);
    const double high = std::max(one.low, other.low);
    const double begin =
        std::ceil((low + kCoverMargin - grid.box.low.y) / grid.row_height);
    const double end =
        std::floor((high - kCoverMargin - grid.box.low.y) / grid.row_height);
    ColumnBits& bits = grid.covered[static_cast<std::size_t>(column)];
    if (begin >= end) continue;
    visit_words(
        static_cast<int>(begin), static_cast<int>(end),
        [&](std::size_t word, std::uint64_t mask) { bits[word] |= mask; });
  }
}

}  // namespace lamina::plane
