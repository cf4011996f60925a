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

// So many places of each turn are improved.
constexpr std::size_t kCandidates = 3;

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
  if (!table) {
    table = std::make_unique<NoFitTable>(parts_of(a), parts_of(b), step_);
    entries_ += table->size();
    if (a != b) {
      const NoFitTable& made = *table;
      tables_[b * turned_.size() + a] =
          std::make_unique<NoFitTable>(made.reversed());
      return made;
    }
  }
  return *table;
}

CellPlace GuidedSearch::last_place(std::size_t turned) const {
  const Vec2 room =
      (area_ - turned_[turned].size()) / tables_.step() + kStepTie;
  return {static_cast<std::int32_t>(std::floor(room.x)),
          static_cast<std::int32_t>(std::floor(room.y))};
}

void GuidedSearch::keep_inside(LatticePiece& piece) const {
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
  work_ -= static_cast<double>(count * count);
  return sum;
}

void GuidedSearch::raise_weights() {
  const float greatest = *std::max_element(depths_.begin(), depths_.end());
  for (std::size_t i = 0; i < depths_.size(); ++i) {
    if (depths_[i] == 0) {
      weights_[i] = std::max(1.0F, weights_[i] * kDecay);
    } else {
      weights_[i] *= kLeastRaise +
                     (kGreatestRaise - kLeastRaise) * (depths_[i] / greatest);
    }
  }
}

bool GuidedSearch::separate(std::size_t patience) {
  double least = std::numeric_limits<double>::max();
  std::vector<std::size_t> order;
  for (std::size_t rounds = 0; rounds < patience && work_ > 0; ++rounds) {
    const double overlap = measure();
    if (overlap == 0) return true;
    if (overlap < least) {
      least = overlap;
      rounds = 0;
    }
    raise_weights();
    order.clear();
    const std::size_t count = pieces_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = depths_.begin() + static_cast<std::ptrdiff_t>(i * count);
      if (std::any_of(row, row + static_cast<std::ptrdiff_t>(count),
                      [](std::uint8_t d) { return d > 0; })) {
        order.push_back(i);
      }
    }
    for (std::size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[random_below(i)]);
    }
    for (const std::size_t i : order) move(i);
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

// Looks at every fourth place, and keeps the best of each of the best columns.
void GuidedSearch::add_candidates(std::size_t i, std::size_t turned) {
  const CellPlace last = last_place(turned);
  if (last.column < 0 || last.row < 0) return;
  constexpr std::int32_t kStride = NoFitTable::kStride;
  const auto phase = [&](std::int32_t most) {
    return static_cast<std::int32_t>(
        random_below(static_cast<std::size_t>(std::min(most + 1, kStride))));
  };
  grid_.first = {phase(last.column), phase(last.row)};
  grid_.columns = (last.column - grid_.first.column) / kStride + 1;
  grid_.rows = (last.row - grid_.first.row) / kStride + 1;
  grid_.sums.assign(static_cast<std::size_t>(grid_.columns * grid_.rows), 0);
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    if (k == i) continue;
    near_tables_[k]->add_to(grid_, pieces_[k].place, weight(i, k));
    work_ -= static_cast<double>(near_tables_[k]->size()) / 64;
  }
  const std::size_t begin = candidates_.size();
  for (std::int32_t c = 0; c < grid_.columns; ++c) {
    const auto column = grid_.sums.begin() + c * grid_.rows;
    const auto least = std::min_element(column, column + grid_.rows);
    candidates_.push_back(
        {*least,
         {turned,
          {grid_.first.column + c * kStride,
           grid_.first.row +
               static_cast<std::int32_t>(least - column) * kStride}}});
  }
  work_ -= static_cast<double>(grid_.sums.size()) / 2;
  const auto first = candidates_.begin() + static_cast<std::ptrdiff_t>(begin);
  const std::size_t kept = std::min(kCandidates, candidates_.size() - begin);
  std::partial_sort(
      first, first + static_cast<std::ptrdiff_t>(kept), candidates_.end(),
      [](const Candidate& a, const Candidate& b) { return a.price < b.price; });
  candidates_.resize(begin + kept);
}

// Walks to cheaper neighbours until there is none.
GuidedSearch::Candidate GuidedSearch::improve(std::size_t i,
                                              Candidate candidate) {
  const CellPlace last = last_place(candidate.piece.turned);
  const CellPlace begin = candidate.piece.place;
  near_.clear();
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    if (k == i) continue;
    const NoFitTable& table = *near_tables_[k];
    const CellPlace low = table.low();
    const CellPlace high = table.high();
    const std::int32_t column = begin.column - pieces_[k].place.column;
    const std::int32_t row = begin.row - pieces_[k].place.row;
    if (column >= low.column - kReach && column < high.column + kReach &&
        row >= low.row - kReach && row < high.row + kReach) {
      near_.push_back(k);
    }
  }
  CellPlace& place = candidate.piece.place;
  candidate.price = price(i, place);
  for (std::int32_t step = 2; step > 0 && candidate.price > 0;) {
    CellPlace best = place;
    for (std::int32_t dc = -step; dc <= step; dc += step) {
      for (std::int32_t dr = -step; dr <= step; dr += step) {
        const CellPlace next{place.column + dc, place.row + dr};
        if (next.column < 0 || next.row < 0 || next.column > last.column ||
            next.row > last.row ||
            std::abs(next.column - begin.column) > kReach ||
            std::abs(next.row - begin.row) > kReach) {
          continue;
        }
        const double here = price(i, next);
        if (here < candidate.price) {
          candidate.price = here;
          best = next;
        }
      }
    }
    work_ -= 8 * static_cast<double>(near_.size());
    if (best == place) {
      --step;
    } else {
      place = best;
    }
  }
  return candidate;
}

bool GuidedSearch::move(std::size_t i) {
  find_tables(i, pieces_[i].turned);
  Candidate best = improve(i, {0, pieces_[i]});
  const std::size_t piece = pieces_[i].turned / turns_;
  for (unsigned turn = 0; turn < turns_ && best.price > 0; ++turn) {
    const std::size_t turned = piece * turns_ + turn;
    find_tables(i, turned);
    candidates_.clear();
    add_candidates(i, turned);
    for (const Candidate& candidate : candidates_) {
      if (candidate.price > 4 * best.price + 40) continue;
      const Candidate better = improve(i, candidate);
      if (better.price < best.price) best = better;
    }
  }
  const bool moves = !(best.piece.place == pieces_[i].place) ||
                     best.piece.turned != pieces_[i].turned;
  pieces_[i] = best.piece;
  return moves;
}

void GuidedSearch::exchange_two() {
  const std::size_t i = random_below(pieces_.size());
  const std::size_t k = random_below(pieces_.size());
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
