#include "plane/sweep/lone_loops.h"

#include <algorithm>
#include <cmath>

#include "base/lanes.h"
#include "plane/predicates.h"

namespace lamina::plane {
namespace {

// A lone loop keeps this distance [mm] from all else, ten ties, and is wider.
constexpr double kMargin = 1e-5;

// The grid pays where loops are many and the points of all others few.
constexpr std::uint32_t kLeastCandidates = 4;
constexpr std::uint32_t kMostPoints = 64;  // of a loop
constexpr std::uint32_t kPointsPerCandidate = 48;

// Loops that reach over more cells are not candidates.
constexpr std::int32_t kMostCells = 8;  // along an axis
constexpr double kCellsPerCandidate = 64;

// Whether a chain bends to the side, or nowhere. +1: left, -1: right.
bool bends_to(int side, std::span<const Vec2> chain) {
  for (std::size_t i = 2; i < chain.size(); ++i) {
    const double turn =
        cross(chain[i - 1] - chain[i - 2], chain[i] - chain[i - 1]);
    if (side * turn < 0) return false;
  }
  return true;
}

// From the chain to the x-axis.
double area_below(std::span<const Vec2> chain) {
  double sum = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    sum += (chain[i].x - chain[i - 1].x) * (chain[i].y + chain[i - 1].y);
  }
  return sum / 2;
}

}  // namespace

void LoneLoops::find(const LayerChains& layer, const ProgramStates& states) {
  points_ = layer.points;
  chains_ = layer.chains;
  sides_.assign(chains_.size(), kNoSide);
  if (!is_worthwhile(layer.loops)) return;
  list_candidates(layer.loops, states);
  if (candidates_.size() < kLeastCandidates) return;
  lay_grid();
  claim_boxes();
  block_edges(layer.loops);
  for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
    if (!is_alone(i)) continue;
    const Candidate& candidate = candidates_[i];
    const Side side = side_of(candidate);
    if (side == kNoSide) continue;
    sides_[candidate.chain] = side;
    sides_[candidate.chain + 1] = side == kLower ? kUpper : kLower;
  }
}

bool LoneLoops::is_worthwhile(std::span<const ChainLoop> loops) const {
  std::size_t pairs = 0;
  for (const ChainLoop& loop : loops) pairs += loop.chain_count == 2 ? 1 : 0;
  if (pairs < kLeastCandidates) return false;
  std::size_t points = 0;
  for (const Chain& chain : chains_) points += chain.point_count;
  return points <= kPointsPerCandidate * pairs;
}

void LoneLoops::list_candidates(std::span<const ChainLoop> loops,
                                const ProgramStates& states) {
  candidates_.clear();
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    const std::uint32_t chain = first;
    first += loops[i].chain_count;
    if (loops[i].chain_count != 2 ||
        states.may_overlap_itself(chains_[chain].operand) ||
        chains_[chain].point_count + chains_[chain + 1].point_count >
            kMostPoints) {
      continue;
    }
    Candidate candidate;
    candidate.loop = i;
    candidate.chain = chain;
    find_box(candidate);
    candidates_.push_back(candidate);
  }
}

void LoneLoops::find_box(Candidate& candidate) const {
  const Chain& first = chains_[candidate.chain];
  Lanes low = lanes_of(points_[first.first_point]);
  Lanes high = low;
  for (const Chain& chain : chains_.subspan(candidate.chain, 2)) {
    for (const Vec2& point : chain.points_in(points_)) {
      const Lanes place = lanes_of(point);
      low = least(low, place);
      high = greatest(high, place);
    }
  }
  candidate.box = {point_of(low) - kMargin, point_of(high) + kMargin};
}

bool LoneLoops::is_alone(std::uint32_t candidate) const {
  const Cells& cells = candidates_[candidate].cells;
  for (auto c = cells.first_column; c <= cells.last_column; ++c) {
    for (auto r = cells.first_row; r <= cells.last_row; ++r) {
      if (owners_[index_of(c, r)] != candidate) return false;
    }
  }
  return true;
}

// Returns the side of the first of the two chains; none where the loop is not
// convex or too thin for its box.
LoneLoops::Side LoneLoops::side_of(const Candidate& candidate) const {
  const auto a = chains_[candidate.chain].points_in(points_);
  const auto b = chains_[candidate.chain + 1].points_in(points_);
  const double area = area_below(b) - area_below(a);
  const Vec2 size = candidate.box.size();
  if (std::abs(area) < kMargin * (size.x + size.y)) return kNoSide;
  const int side = area > 0 ? 1 : -1;
  if (!bends_to(side, a) || !bends_to(-side, b)) return kNoSide;
  return area > 0 ? kLower : kUpper;
}

// Cells half as large as a candidate is on the average, but not too many.
void LoneLoops::lay_grid() {
  box_ = {};
  Vec2 sum(0);
  for (const Candidate& candidate : candidates_) {
    box_.add(candidate.box);
    sum += candidate.box.size();
  }
  const auto count = static_cast<double>(candidates_.size());
  const Vec2 size = box_.size();
  const double wanted = (sum.x + sum.y) / (4 * count);
  const double least =
      std::max(std::sqrt(size.x * size.y / (kCellsPerCandidate * count)),
               std::max(size.x, size.y) / (kCellsPerCandidate * count));
  cells_per_mm_ = 1 / std::max(wanted, least);
  column_count_ = static_cast<std::size_t>(size.x * cells_per_mm_) + 1;
  row_count_ = static_cast<std::size_t>(size.y * cells_per_mm_) + 1;
  owners_.assign(column_count_ * row_count_, kFree);
}

// Candidates that are too large block their edges like all others.
void LoneLoops::claim_boxes() {
  std::erase_if(candidates_, [this](Candidate& candidate) {
    Cells& cells = candidate.cells;
    cells = {column_of(candidate.box.low.x), column_of(candidate.box.high.x),
             row_of(candidate.box.low.y), row_of(candidate.box.high.y)};
    return cells.last_column - cells.first_column >= kMostCells ||
           cells.last_row - cells.first_row >= kMostCells;
  });
  for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
    const Cells& cells = candidates_[i].cells;
    for (auto c = cells.first_column; c <= cells.last_column; ++c) {
      for (auto r = cells.first_row; r <= cells.last_row; ++r) {
        std::uint32_t& owner = owners_[index_of(c, r)];
        owner = owner == kFree ? i : kBlocked;
      }
    }
  }
}

// Blocks the cells that other loops pass: those of their chains, and of what
// joins the end of one to the begin of the next.
void LoneLoops::block_edges(std::span<const ChainLoop> loops) {
  auto next = candidates_.begin();
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    const std::uint32_t end = first + loops[i].chain_count;
    if (next != candidates_.end() && next->loop == i) {
      ++next;
      first = end;
      continue;
    }
    const auto goes_right = [&](const Chain& chain) {
      return chain.winding * loops[i].orientation > 0;
    };
    const Chain& last = chains_[end - 1];
    const auto last_points = last.points_in(points_);
    Vec2 from = goes_right(last) ? last_points.back() : last_points.front();
    for (std::uint32_t c = first; c < end; ++c) {
      const auto chain = chains_[c].points_in(points_);
      const bool is_forward = goes_right(chains_[c]);
      block(from, is_forward ? chain.front() : chain.back());
      from = is_forward ? chain.back() : chain.front();
      for (std::size_t k = 1; k < chain.size(); ++k) {
        block(chain[k - 1], chain[k]);
      }
    }
    first = end;
  }
}

// The cells of an edge, column by column.
void LoneLoops::block(const Vec2& from, const Vec2& to) {
  const Vec2& left = from.x <= to.x ? from : to;
  const Vec2& right = from.x <= to.x ? to : from;
  if (right.x < box_.low.x || left.x > box_.high.x ||
      std::max(from.y, to.y) < box_.low.y ||
      std::min(from.y, to.y) > box_.high.y) {
    return;
  }
  const double slope =
      right.x > left.x ? (right.y - left.y) / (right.x - left.x) : 0;
  const std::int32_t last_column = column_of(right.x);
  double begin_y = left.y;
  for (std::int32_t c = column_of(left.x); c <= last_column; ++c) {
    const double border = box_.low.x + (c + 1) / cells_per_mm_;
    const double end_y =
        c == last_column ? right.y : left.y + slope * (border - left.x);
    const auto [lowest, highest] = std::minmax(begin_y, end_y);
    const std::int32_t last_row = row_of(highest + kMargin / 2);
    for (std::int32_t r = row_of(lowest - kMargin / 2); r <= last_row; ++r) {
      owners_[index_of(c, r)] = kBlocked;
    }
    begin_y = end_y;
  }
}

std::int32_t LoneLoops::column_of(double x) const {
  const double column = (x - box_.low.x) * cells_per_mm_;
  return static_cast<std::int32_t>(
      std::clamp(column, 0.0, static_cast<double>(column_count_ - 1)));
}

std::int32_t LoneLoops::row_of(double y) const {
  const double row = (y - box_.low.y) * cells_per_mm_;
  return static_cast<std::int32_t>(
      std::clamp(row, 0.0, static_cast<double>(row_count_ - 1)));
}

}  // namespace lamina::plane
