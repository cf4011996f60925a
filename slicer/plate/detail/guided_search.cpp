#include "slicer/plate/detail/guided_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "plane/region/minkowski.h"

namespace lamina::slicer {
namespace {

// A weight is multiplied by this where a pair does not overlap, and by up to
// the second where it does.
constexpr float kDecay = 0.95F;
constexpr float kLeastRaise = 1.2F;
constexpr float kGreatestRaise = 2.0F;

// No sum of prices comes near to what a float holds.
constexpr float kGreatestWeight = 1e9F;

// What it takes to make a table: for each entry, and for each pair of convex
// parts.
constexpr double kWorkPerEntry = 8;
constexpr double kWorkPerPair = 1000;

// What it takes to look at an entry of a table by itself, and at one of those
// that follow each other.
constexpr double kWorkPerPrice = 2;
constexpr double kWorkPerGridSum = 0.25;

// So many places of each turn are improved.
constexpr std::size_t kCandidates = 3;

// So often a piece is drawn that differs from another one; they may all be the
// same.
constexpr int kDraws = 8;

// Weights are scaled to at most this on the coarse grid, whose sums have 16
// bits: four deep overlaps of that weight fill them.
constexpr float kGreatestGridWeight = 64;

// A candidate is improved within so many steps, in each direction.
constexpr std::int32_t kReach = 12;

// Places that are larger than the room by less than this fit, in steps.
constexpr double kStepTie = 1e-6;

}  // namespace

NoFitTables::NoFitTables(std::span<const TurnedPiece> turned, double step)
    : turned_(turned), step_(step), parts_(turned.size()) {}

const std::vector<plane::Contour>& NoFitTables::parts_of(std::size_t turned) {
  std::vector<plane::Contour>& parts = parts_[turned];
  if (parts.empty()) parts = plane::cut_into_convex(turned_[turned].grown);
  return parts;
}

const NoFitTable& NoFitTables::of(std::size_t a, std::size_t b) {
  std::unique_ptr<NoFitTable>& table = tables_[a * turned_.size() + b];
  if (table) return *table;
  const std::vector<plane::Contour>& a_parts = parts_of(a);
  const std::vector<plane::Contour>& b_parts = parts_of(b);
  table = std::make_unique<NoFitTable>(a_parts, b_parts, step_);
  work_ += kWorkPerEntry * static_cast<double>(table->size()) +
           kWorkPerPair * static_cast<double>(a_parts.size() * b_parts.size());
  const NoFitTable& made = *table;
  if (a != b) {
    tables_[b * turned_.size() + a] =
        std::make_unique<NoFitTable>(made.reversed());
  }
  return made;
}

CellPlace GuidedSearch::last_place(std::size_t turned) const {
  const Vec2 room =
      (area_ - turned_[turned].size()) / tables_.step() + kStepTie;
  return {static_cast<std::int32_t>(std::floor(room.x)),
          static_cast<std::int32_t>(std::floor(room.y))};
}

bool GuidedSearch::fits(std::size_t turned) const {
  const CellPlace last = last_place(turned);
  return last.column >= 0 && last.row >= 0;
}

void GuidedSearch::keep_inside(LatticePiece& piece) const {
  const std::size_t first = piece.turned / turns_ * turns_;
  for (unsigned turn = 0; turn < turns_ && !fits(piece.turned); ++turn) {
    piece.turned = first + turn;
  }
  const CellPlace last = last_place(piece.turned);
  piece.place.column = std::clamp(piece.place.column, 0, last.column);
  piece.place.row = std::clamp(piece.place.row, 0, last.row);
}

void GuidedSearch::set_pieces(std::vector<LatticePiece> pieces) {
  pieces_ = std::move(pieces);
  for (LatticePiece& piece : pieces_) keep_inside(piece);
  weights_.assign(pieces_.size() * pieces_.size(), 1);
  depths_.assign(weights_.size(), 0);
}

std::uint8_t GuidedSearch::depth(std::size_t i, std::size_t k) {
  const LatticePiece& a = pieces_[i];
  const LatticePiece& b = pieces_[k];
  return tables_.of(a.turned, b.turned)
      .depth(b.place.column - a.place.column, b.place.row - a.place.row);
}

// Measures the depths of all pairs; returns their sum.
double GuidedSearch::measure() {
  double sum = 0;
  const std::size_t count = pieces_.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k) {
      const std::uint8_t here = depth(i, k);
      depths_[i * count + k] = depths_[k * count + i] = here;
      sum += here;
    }
  }
  use_work(static_cast<double>(count * count));
  return sum;
}

void GuidedSearch::raise_weights() {
  const float greatest = *std::max_element(depths_.begin(), depths_.end());
  for (std::size_t i = 0; i < depths_.size(); ++i) {
    if (depths_[i] == 0) {
      weights_[i] = std::max(1.0F, weights_[i] * kDecay);
    } else {
      const float raise = kLeastRaise + (kGreatestRaise - kLeastRaise) *
                                            (depths_[i] / greatest);
      weights_[i] = std::min(kGreatestWeight, weights_[i] * raise);
    }
  }
}

// The pieces that overlap others, in random order.
std::vector<std::size_t> GuidedSearch::draw_order() {
  std::vector<std::size_t> order;
  const std::size_t count = pieces_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto depths = std::span(depths_).subspan(i * count, count);
    if (std::any_of(depths.begin(), depths.end(),
                    [](std::uint8_t depth) { return depth > 0; })) {
      order.push_back(i);
    }
  }
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random_below(i)]);
  }
  return order;
}

bool GuidedSearch::separate(std::size_t patience) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t rounds = 0; rounds < patience && work() > 0; ++rounds) {
    const double overlap = measure();
    if (overlap == 0) return true;
    if (overlap < least) {
      least = overlap;
      least_overlap_ = pieces_;
      rounds = 0;
    }
    raise_weights();
    for (const std::size_t i : draw_order()) {
      if (work() > 0) move(i);
    }
  }
  return false;
}

void GuidedSearch::find_tables(std::size_t i, std::size_t turned) {
  near_tables_.resize(pieces_.size());
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    near_tables_[k] = k == i ? nullptr : &tables_.of(pieces_[k].turned, turned);
  }
}

// The price of a place, by the pieces in reach.
double GuidedSearch::price(std::size_t i, CellPlace place) const {
  double sum = 0;
  for (const std::size_t k : near_) {
    const CellPlace other = pieces_[k].place;
    sum += weights_[i * pieces_.size() + k] *
           near_tables_[k]->depth(place.column - other.column,
                                  place.row - other.row);
  }
  return sum;
}

// Adds up prices at every fourth place.
void GuidedSearch::fill_grid(std::size_t i, CellPlace last) {
  constexpr std::int32_t kStride = NoFitTable::kStride;
  const auto phase = [&](std::int32_t most) {
    return static_cast<std::int32_t>(
        random_below(static_cast<std::size_t>(std::min(most + 1, kStride))));
  };
  grid_.first = {phase(last.column), phase(last.row)};
  grid_.columns = (last.column - grid_.first.column) / kStride + 1;
  grid_.rows = (last.row - grid_.first.row) / kStride + 1;
  grid_.sums.assign(column_index(grid_.columns, grid_.rows, 0), 0);
  const auto weights =
      std::span(weights_).subspan(i * pieces_.size(), pieces_.size());
  const float scale =
      kGreatestGridWeight / *std::max_element(weights.begin(), weights.end());
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    if (k == i) continue;
    const auto weight =
        static_cast<std::uint16_t>(std::max(1.0F, weights[k] * scale));
    near_tables_[k]->add_to(grid_, pieces_[k].place, weight);
    use_work(kWorkPerGridSum *
             static_cast<double>(near_tables_[k]->coarse_size()));
  }
  use_work(static_cast<double>(grid_.sums.size()) / 2);
}

// Keeps the best place of each of the best columns.
void GuidedSearch::find_candidates(std::size_t i, std::size_t turned) {
  fill_grid(i, last_place(turned));
  columns_.clear();
  const auto column = [&](std::int32_t c) {
    return std::span(grid_.sums)
        .subspan(column_index(c, grid_.rows, 0),
                 static_cast<std::size_t>(grid_.rows));
  };
  for (std::int32_t c = 0; c < grid_.columns; ++c) {
    std::uint16_t least = std::numeric_limits<std::uint16_t>::max();
    for (const std::uint16_t sum : column(c)) least = std::min(least, sum);
    columns_.emplace_back(least, c);
  }
  const auto kept =
      static_cast<std::ptrdiff_t>(std::min(kCandidates, columns_.size()));
  std::partial_sort(columns_.begin(), columns_.begin() + kept, columns_.end());
  candidates_.clear();
  for (std::ptrdiff_t n = 0; n < kept; ++n) {
    const auto [least, c] = columns_[static_cast<std::size_t>(n)];
    const auto sums = column(c);
    const auto r = static_cast<std::int32_t>(
        std::find(sums.begin(), sums.end(), least) - sums.begin());
    candidates_.push_back({turned,
                           {grid_.first.column + c * NoFitTable::kStride,
                            grid_.first.row + r * NoFitTable::kStride}});
  }
}

// Finds the pieces that the moved one may meet within reach of a place.
void GuidedSearch::find_near(std::size_t i, CellPlace place) {
  near_.clear();
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    if (k == i) continue;
    const CellPlace low = near_tables_[k]->low();
    const CellPlace high = near_tables_[k]->high();
    const std::int32_t column = place.column - pieces_[k].place.column;
    const std::int32_t row = place.row - pieces_[k].place.row;
    if (column >= low.column - kReach && column < high.column + kReach &&
        row >= low.row - kReach && row < high.row + kReach) {
      near_.push_back(k);
    }
  }
}

// Looks at the eight neighbours so many steps away; moves to the cheapest.
bool GuidedSearch::take_step(std::size_t i, std::int32_t step, CellPlace low,
                             CellPlace high, Candidate& candidate) {
  const CellPlace from = candidate.piece.place;
  for (std::int32_t x = from.column - step; x <= from.column + step;
       x += step) {
    for (std::int32_t y = from.row - step; y <= from.row + step; y += step) {
      if (x < low.column || y < low.row || x > high.column || y > high.row) {
        continue;
      }
      const double here = price(i, {x, y});
      if (here < candidate.price) {
        candidate = {here, {candidate.piece.turned, {x, y}}};
      }
    }
  }
  use_work(kWorkPerPrice * 8 * static_cast<double>(near_.size()));
  return !(candidate.piece.place == from);
}

// Walks to cheaper neighbours until there is none.
GuidedSearch::Candidate GuidedSearch::improve(std::size_t i,
                                              LatticePiece piece) {
  const CellPlace last = last_place(piece.turned);
  const CellPlace begin = piece.place;
  const CellPlace low{std::max(0, begin.column - kReach),
                      std::max(0, begin.row - kReach)};
  const CellPlace high{std::min(last.column, begin.column + kReach),
                       std::min(last.row, begin.row + kReach)};
  find_near(i, begin);
  Candidate candidate{price(i, begin), piece};
  for (std::int32_t step = 2; step > 0 && candidate.price > 0;) {
    if (!take_step(i, step, low, high, candidate)) --step;
  }
  return candidate;
}

void GuidedSearch::move(std::size_t i) {
  find_tables(i, pieces_[i].turned);
  Candidate best = improve(i, pieces_[i]);
  const std::size_t first = pieces_[i].turned / turns_ * turns_;
  for (unsigned turn = 0; turn < turns_ && best.price > 0; ++turn) {
    if (!fits(first + turn)) continue;
    find_tables(i, first + turn);
    find_candidates(i, first + turn);
    for (const LatticePiece& candidate : candidates_) {
      const Candidate better = improve(i, candidate);
      if (better.price < best.price) best = better;
    }
  }
  pieces_[i] = best.piece;
}

// The larger one of two pieces that are drawn.
std::size_t GuidedSearch::draw_large() {
  const std::size_t i = random_below(pieces_.size());
  const std::size_t k = random_below(pieces_.size());
  const auto extent = [&](std::size_t piece) {
    const Vec2 size = turned_[pieces_[piece].turned].size();
    return size.x * size.y;
  };
  return extent(k) > extent(i) ? k : i;
}

void GuidedSearch::exchange_two() {
  const std::size_t i = draw_large();
  std::size_t k = draw_large();
  const auto is_like = [&] {
    return pieces_[k].turned / turns_ == pieces_[i].turned / turns_;
  };
  for (int draws = 0; draws < kDraws && is_like(); ++draws) k = draw_large();
  std::swap(pieces_[i].place, pieces_[k].place);
  keep_inside(pieces_[i]);
  keep_inside(pieces_[k]);
}

void GuidedSearch::shift_left(std::int32_t columns) {
  const auto behind = static_cast<std::int32_t>(
      random_below(static_cast<std::size_t>(area_.x / tables_.step()) + 1));
  for (LatticePiece& piece : pieces_) {
    if (piece.place.column >= behind) piece.place.column -= columns;
    keep_inside(piece);
  }
}

}  // namespace lamina::slicer
