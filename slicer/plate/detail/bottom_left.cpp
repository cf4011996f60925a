#include "slicer/plate/detail/bottom_left.h"

#include <cmath>
#include <tuple>

#include "base/parallel.h"

namespace lamina::slicer {
namespace {

// Lengths that differ by less of a cell are one.
constexpr double kCellTie = 1e-6;

}  // namespace

BottomLeftFill::BottomLeftFill(std::span<const TurnedPiece> turned,
                               unsigned turns, Vec2 area, double cell,
                               double gap)
    : turned_(turned),
      turns_(turns),
      area_(area),
      cell_(cell),
      border_(
          static_cast<std::int32_t>(std::ceil(greatest_growth(gap) / cell))),
      shapes_(turned.size()) {
  for_each_index(turned_.size(), [&](std::size_t i) {
    shapes_[i] = CellShape(turned_[i].grown, Vec2(-border_ * cell_), cell_);
  });
}

CellPlace BottomLeftFill::last_place(std::size_t turned) const {
  const Vec2 room = (area_ - turned_[turned].size()) / cell_;
  return {static_cast<std::int32_t>(std::floor(room.x + kCellTie)),
          static_cast<std::int32_t>(std::floor(room.y + kCellTie))};
}

void BottomLeftFill::add_plate() {
  const auto cells = [&](double length) {
    return static_cast<std::int32_t>(length / cell_) + 2 * border_ + 2;
  };
  plates_.push_back({PlateBitmap(cells(area_.x), cells(area_.y)),
                     std::vector<std::int32_t>(turned_.size(), 0)});
}

std::optional<LaidPiece> BottomLeftFill::lay_on(std::size_t plate,
                                                std::size_t piece) {
  PlateState& state = plates_[plate];
  std::optional<std::tuple<double, std::size_t, CellPlace>> best;
  for (unsigned turn = 0; turn < turns_; ++turn) {
    const std::size_t i = piece * turns_ + turn;
    std::int32_t& first = state.first_columns[i];
    CellPlace last = last_place(i);
    if (first > last.column || last.row < 0) continue;
    // The piece must not reach farther than in the best turn so far.
    const double width = turned_[i].size().x / cell_;
    const auto reach = [&](std::int32_t column) { return column + width; };
    const std::int32_t end = last.column;
    if (best && reach(last.column) >= std::get<0>(*best)) {
      last.column = static_cast<std::int32_t>(
          std::ceil(std::get<0>(*best) - width - kCellTie) - 1);
    }
    const auto place = state.bitmap.find_place(shapes_[i], first, last);
    if (place) {
      first = place->column;
      best = {reach(place->column), i, *place};
    } else {
      first = last.column == end ? kFull : std::max(first, last.column + 1);
    }
  }
  if (!best) return std::nullopt;
  const auto& [reach, turned, place] = *best;
  state.bitmap.add(shapes_[turned], place);
  return LaidPiece{turned, plate, Vec2(place.column, place.row) * cell_};
}

std::optional<LaidPiece> BottomLeftFill::lay(std::size_t piece,
                                             std::size_t most_plates) {
  for (std::size_t plate = 0; plate < most_plates; ++plate) {
    if (plate == plates_.size()) add_plate();
    if (auto laid = lay_on(plate, piece)) return laid;
  }
  return std::nullopt;
}

}  // namespace lamina::slicer
