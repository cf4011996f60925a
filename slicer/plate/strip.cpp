#include "slicer/plate/strip.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "plane/region/boolean.h"
#include "slicer/plate/detail/bottom_left.h"
#include "slicer/plate/detail/guided_search.h"
#include "slicer/plate/detail/turned_piece.h"

namespace lamina::slicer {
namespace {

// The strip's depth has at least so many places. A coarse lattice lets the
// search see many more layouts in the same time; a finer one then brings the
// pieces of the best closer to each other.
constexpr double kPlacesPerDepth = 100;
constexpr std::int32_t kRefinement = 4;
constexpr double kCoarseWork = 0.6;  // share of the work

// By such a share of its length the strip becomes shorter at first.
constexpr double kCoarseCut = 0.02;
constexpr double kFineCut = 0.002;

// So many rounds in turn may fail to lower the overlap, and so many times two
// pieces are exchanged then.
constexpr std::size_t kPatience = 100;
constexpr int kExchanges = 2;

class StripPacker {
 public:
  StripPacker(std::span<const Piece> pieces, const Strip& strip)
      : pieces_(pieces),
        strip_(strip),
        turned_(turn_pieces(pieces, strip.gap, strip.turns)),
        step_(std::exp2(std::floor(std::log2(strip.depth / kPlacesPerDepth)))) {
  }

  StripPlan pack() {
    fill();
    shorten(kCoarseCut, strip_.work * kCoarseWork);
    refine();
    shorten(kFineCut, strip_.work * (1 - kCoarseWork));
    StripPlan plan;
    for (const LatticePiece& piece : best_) {
      const TurnedPiece& turned = turned_[piece.turned];
      const Vec2 corner = Vec2(piece.place.column, piece.place.row) * step_;
      plan.placements.push_back(
          {turned.piece, 0, turned.turn_deg, corner - turned.box.low});
    }
    plan.length = length();
    return plan;
  }

 private:
  void fill() {
    double most = 0;
    for (std::size_t i = 0; i < turned_.size(); ++i) {
      most += turned_[i].size().x *
              static_cast<double>(pieces_[turned_[i].piece].quantity);
    }
    BottomLeftFill fill(turned_, strip_.turns, {most, strip_.depth}, step_,
                        strip_.gap);
    std::vector<std::size_t> order(pieces_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
      return area(pieces_[a].footprint) > area(pieces_[b].footprint);
    });
    for (const std::size_t piece : order) {
      for (std::size_t k = 0; k < pieces_[piece].quantity; ++k) {
        const LaidPiece laid = fill.lay(piece, 1).value();
        const Vec2 at = glm::round(laid.corner / step_);
        best_.push_back({laid.turned,
                         {static_cast<std::int32_t>(at.x),
                          static_cast<std::int32_t>(at.y)}});
      }
    }
  }

  // Goes on with a finer lattice.
  void refine() {
    step_ /= kRefinement;
    for (LatticePiece& piece : best_) {
      piece.place.column *= kRefinement;
      piece.place.row *= kRefinement;
    }
  }

  double length() const {
    double length = 0;
    for (const LatticePiece& piece : best_) {
      length = std::max(
          length, piece.place.column * step_ + turned_[piece.turned].size().x);
    }
    return length;
  }

  // In a shorter strip a piece would fit in no turn.
  double least_length() const {
    double least = 0;
    for (const LatticePiece& laid : best_) {
      const std::size_t first = laid.turned / strip_.turns * strip_.turns;
      double shortest = turned_[laid.turned].size().x;
      for (unsigned turn = 0; turn < strip_.turns; ++turn) {
        const Vec2 size = turned_[first + turn].size();
        if (size.y <= strip_.depth) shortest = std::min(shortest, size.x);
      }
      least = std::max(least, shortest);
    }
    return least;
  }

  // Makes the strip shorter by a share of its length, again and again, and by a
  // smaller share where that fails.
  void shorten(double share, double work) {
    NoFitTables tables(turned_, step_);
    GuidedSearch search(turned_, strip_.turns, tables, strip_.seed);
    search.set_work(work * 1e6);
    const double least = least_length();
    while (search.work() > 0) {
      const double before = length();
      const double cut =
          std::min(std::max(1.0, std::floor(before * share / step_)),
                   std::floor((before - least) / step_));
      if (cut < 1) return;
      search.set_area({before, strip_.depth});
      search.set_pieces(best_);
      search.shift_left(static_cast<std::int32_t>(cut));
      search.set_area({before - cut * step_, strip_.depth});
      search.set_pieces(search.pieces());
      if (separate(search)) {
        best_ = search.pieces();
      } else {
        share /= 2;
      }
    }
  }

  // Whether the pieces find places, in some attempts: after each that fails two
  // pieces of the best state exchange theirs.
  static bool separate(GuidedSearch& search) {
    for (int attempt = 0; search.work() > 0; ++attempt) {
      if (search.separate(kPatience)) return true;
      if (attempt == kExchanges) return false;
      search.set_pieces(search.least_overlap());
      search.exchange_two();
    }
    return false;
  }

  std::span<const Piece> pieces_;
  const Strip& strip_;
  std::vector<TurnedPiece> turned_;
  double step_;  // of the lattice [mm]
  std::vector<LatticePiece> best_;
};

}  // namespace

StripPlan pack_strip(std::span<const Piece> pieces, const Strip& strip) {
  for (const Piece& piece : pieces) plane::require_near({&piece.footprint, 1});
  return StripPacker(pieces, strip).pack();
}

}  // namespace lamina::slicer
