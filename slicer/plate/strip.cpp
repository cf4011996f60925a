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

// The strip's depth has at least so many places.
constexpr double kPlacesPerDepth = 200;

class StripPacker {
 public:
  StripPacker(std::span<const Piece> pieces, const Strip& strip)
      : pieces_(pieces),
        strip_(strip),
        turned_(turn_pieces(pieces, strip.gap, strip.turns)),
        step_(std::exp2(std::floor(std::log2(strip.depth / kPlacesPerDepth)))),
        tables_(turned_, step_),
        search_(turned_, strip.turns, tables_, strip.seed) {}

  StripPlan pack() {
    fill();
    search_.set_work(strip_.work * 1e6);
    shorten();
    StripPlan plan;
    for (const LatticePiece& piece : best_) {
      const TurnedPiece& turned = turned_[piece.turned];
      const Vec2 corner = Vec2(piece.place.column, piece.place.row) * step_;
      plan.placements.push_back(
          {turned.piece, 0, turned.turn_deg, corner - turned.box.low});
      plan.length = std::max(plan.length, corner.x + turned.size().x);
    }
    return plan;
  }

 private:
  void fill() {
    double length = 0;
    for (std::size_t i = 0; i < turned_.size(); ++i) {
      length += turned_[i].size().x *
                static_cast<double>(pieces_[turned_[i].piece].quantity);
    }
    BottomLeftFill fill(turned_, strip_.turns, {length, strip_.depth}, step_,
                        strip_.gap);
    std::vector<std::size_t> order(pieces_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
      return area(pieces_[a].footprint) > area(pieces_[b].footprint);
    });
    for (const std::size_t piece : order) {
      for (std::size_t k = 0; k < pieces_[piece].quantity; ++k) {
        const auto laid = fill.lay(piece, 1);
        if (!laid) continue;
        const Vec2 at = glm::round(laid->corner / step_);
        best_.push_back({laid->turned,
                         {static_cast<std::int32_t>(at.x),
                          static_cast<std::int32_t>(at.y)}});
      }
    }
  }

  double length_of(std::span<const LatticePiece> pieces) const {
    double length = 0;
    for (const LatticePiece& piece : pieces) {
      length = std::max(
          length, piece.place.column * step_ + turned_[piece.turned].size().x);
    }
    return length;
  }

  void shorten() {
    double share = 0.04;
    while (search_.work() > 0) {
      const double length = length_of(best_);
      const double cut = std::max(1.0, std::floor(length * share / step_));
      search_.set_area({length, strip_.depth});
      search_.set_pieces(best_);
      search_.shift_left(static_cast<std::int32_t>(cut));
      search_.set_area({length - cut * step_, strip_.depth});
      search_.set_pieces(search_.pieces());
      bool done = search_.separate(60);
      for (int k = 0; k < 2 && !done && search_.work() > 0; ++k) {
        search_.exchange_two();
        done = search_.separate(60);
      }
      if (done) {
        best_ = search_.pieces();
      } else {
        share /= 2;
        share = std::max(share, 0.001);
      }
    }
  }

  std::span<const Piece> pieces_;
  const Strip& strip_;
  std::vector<TurnedPiece> turned_;
  double step_;
  NoFitTables tables_;
  GuidedSearch search_;
  std::vector<LatticePiece> best_;
};

}  // namespace

StripPlan pack_strip(std::span<const Piece> pieces, const Strip& strip) {
  for (const Piece& piece : pieces) plane::require_near({&piece.footprint, 1});
  return StripPacker(pieces, strip).pack();
}

}  // namespace lamina::slicer
