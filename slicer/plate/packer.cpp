#include "slicer/plate/packer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/check.h"
#include "plane/region/boolean.h"
#include "slicer/plate/detail/bottom_left.h"
#include "slicer/plate/detail/plate_saver.h"
#include "slicer/plate/detail/turned_piece.h"
#include "slicer/plate/distance.h"
#include "slicer/plate/footprint.h"

namespace lamina::slicer {
namespace {

// Pieces down to this share of the highest of their class are of like height.
constexpr double kLikeHeight = 0.8;

// A plate has about so many cells along its longer side, and at most so many
// where pieces are small; a piece of middle size has so many along its side.
constexpr double kCellsPerPlate = 512;
constexpr double kMostCellsPerPlate = 4096;
constexpr double kCellsPerPiece = 16;

// Pieces that are larger than the free area by less than this fit [mm].
constexpr double kFitTie = 1e-6;

// A power of two, so that pieces of whole millimetres fit without a rest [mm].
double cell_for(std::span<const TurnedPiece> turned, Vec2 area) {
  double sides = 0;
  for (const TurnedPiece& piece : turned) {
    sides += std::min(piece.size().x, piece.size().y);
  }
  const double side = std::max(area.x, area.y);
  const double cell =
      std::clamp(sides / static_cast<double>(turned.size()) / kCellsPerPiece,
                 side / kMostCellsPerPlate, side / kCellsPerPlate);
  return std::exp2(std::floor(std::log2(cell)));
}

// The higher class first, in it the larger piece.
std::vector<std::size_t> order_of(std::span<const Piece> pieces) {
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
    return pieces[a].height > pieces[b].height;
  });
  std::vector<double> areas;
  for (const Piece& piece : pieces) areas.push_back(area(piece.footprint));
  for (auto begin = order.begin(); begin != order.end();) {
    const double least = kLikeHeight * pieces[*begin].height;
    const auto end = std::find_if(begin, order.end(), [&](std::size_t i) {
      return pieces[i].height < least;
    });
    std::stable_sort(begin, end,
                     [&](auto a, auto b) { return areas[a] > areas[b]; });
    begin = end;
  }
  return order;
}

class Packer {
 public:
  Packer(std::span<const Piece> pieces, const Plate& plate)
      : pieces_(pieces),
        plate_(plate),
        area_(plate.size - 2 * plate.margin),
        turned_(turn_pieces(pieces, plate.gap, plate.turns)) {
    plan_.left_over.resize(pieces.size());
  }

  PlatePlan pack() {
    find_too_large();
    if (plan_.too_large.size() < pieces_.size()) {
      fill();
      if (plate_.work > 0) save_plates();
    }
    write_placements();
    check();
    return std::move(plan_);
  }

 private:
  bool fits(std::size_t piece) const {
    const auto turns = std::span(turned_).subspan(piece * plate_.turns);
    return std::any_of(turns.begin(), turns.begin() + plate_.turns,
                       [&](const TurnedPiece& turned) {
                         const Vec2 room = area_ + kFitTie - turned.size();
                         return room.x >= 0 && room.y >= 0;
                       });
  }

  void find_too_large() {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!fits(i)) plan_.too_large.push_back(i);
    }
  }

  void fill() {
    const std::size_t most_plates =
        plate_.most_plates == 0 ? std::numeric_limits<std::size_t>::max()
                                : plate_.most_plates;
    BottomLeftFill plates(turned_, plate_.turns, area_,
                          cell_for(turned_, area_), plate_.gap);
    for (const std::size_t piece : order_of(pieces_)) {
      if (std::binary_search(plan_.too_large.begin(), plan_.too_large.end(),
                             piece)) {
        continue;
      }
      for (std::size_t k = 0; k < pieces_[piece].quantity; ++k) {
        const auto laid = plates.lay(piece, most_plates);
        if (!laid) {
          plan_.left_over[piece] = pieces_[piece].quantity - k;
          break;
        }
        laid_.push_back(*laid);
      }
    }
  }

  void save_plates() {
    PlateSaver saver(turned_, plate_.turns, area_, plate_.work * 1e6);
    std::size_t plates = 0;
    for (const LaidPiece& laid : laid_) {
      plates = std::max(plates, laid.plate + 1);
    }
    for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
      while (plan_.left_over[piece] > 0 && saver.add(piece, plates, laid_)) {
        --plan_.left_over[piece];
      }
    }
    while (plates > 1 && saver.empty_last(plates, laid_)) --plates;
  }

  void write_placements() {
    for (const LaidPiece& laid : laid_) {
      const TurnedPiece& turned = turned_[laid.turned];
      plan_.placements.push_back(
          {turned.piece, laid.plate, turned.turn_deg,
           laid.corner + plate_.margin - turned.box.low});
      plan_.plates = std::max(plan_.plates, laid.plate + 1);
    }
    std::stable_sort(plan_.placements.begin(), plan_.placements.end(),
                     [](const Placement& a, const Placement& b) {
                       return a.plate != b.plate ? a.plate < b.plate
                                                 : a.piece < b.piece;
                     });
  }

  void check() const {
    std::vector<plane::Region> placed;
    auto at = plan_.placements.begin();
    for (std::size_t plate = 0; plate < plan_.plates; ++plate) {
      placed.clear();
      for (; at != plan_.placements.end() && at->plate == plate; ++at) {
        placed.push_back(
            place(pieces_[at->piece].footprint, at->turn_deg, at->shift));
      }
      LAMINA_CHECK_EQ(find_too_near(placed, plate_.gap).size(), 0U);
    }
  }

  std::span<const Piece> pieces_;
  const Plate& plate_;
  Vec2 area_;
  std::vector<TurnedPiece> turned_;
  std::vector<LaidPiece> laid_;
  PlatePlan plan_;
};

}  // namespace

PlatePlan pack_plates(std::span<const Piece> pieces, const Plate& plate) {
  for (const Piece& piece : pieces) plane::require_near({&piece.footprint, 1});
  return Packer(pieces, plate).pack();
}

}  // namespace lamina::slicer
