#include "slicer/plate/detail/plate_saver.h"

#include <algorithm>
#include <cmath>

namespace lamina::slicer {
namespace {

// The shorter side of a plate has at least so many places.
constexpr double kPlacesPerSide = 100;

// Plates that would be covered beyond this share are not tried.
constexpr double kMostCovered = 0.9;

// So many rounds in turn may fail to lower the overlap.
constexpr std::size_t kSaverPatience = 40;

// A power of two, as the cells of bottom-left fill.
double step_for(Vec2 area) {
  const double step = std::min(area.x, area.y) / kPlacesPerSide;
  return std::exp2(std::floor(std::log2(step)));
}

}  // namespace

PlateSaver::PlateSaver(std::span<const TurnedPiece> turned, unsigned turns,
                       Vec2 area, double work)
    : turned_(turned),
      turns_(turns),
      area_(area),
      tables_(turned, step_for(area)),
      search_(turned, turns, tables_, 1) {
  search_.set_area(area);
  search_.set_work(work);
}

// Half of the gap around a plate's pieces may lie outside of its area, but few
// pieces lie as close as that.
double PlateSaver::covered(std::size_t turned) const {
  return plane::area(turned_[turned].grown) / (area_.x * area_.y);
}

bool PlateSaver::add_to(std::size_t plate, std::size_t piece,
                        std::vector<LaidPiece>& laid) {
  const auto rows_of = [&](double length) {
    return static_cast<std::int32_t>(std::lround(length / tables_.step()));
  };
  std::vector<LatticePiece> pieces = {
      {piece * turns_, {rows_of(area_.x / 2), rows_of(area_.y / 2)}}};
  double share = covered(piece * turns_);
  for (const LaidPiece& one : laid) {
    if (one.plate != plate) continue;
    share += covered(one.turned);
    pieces.push_back(
        {one.turned, {rows_of(one.corner.x), rows_of(one.corner.y)}});
  }
  if (share > kMostCovered) return false;
  search_.set_pieces(std::move(pieces));
  if (!search_.separate(kSaverPatience)) return false;
  std::erase_if(laid, [&](const LaidPiece& one) { return one.plate == plate; });
  for (const LatticePiece& one : search_.pieces()) {
    laid.push_back({one.turned, plate,
                    Vec2(one.place.column, one.place.row) * tables_.step()});
  }
  return true;
}

bool PlateSaver::add(std::size_t piece, std::size_t plates,
                     std::vector<LaidPiece>& laid) {
  for (std::size_t plate = plates; plate > 0 && search_.work() > 0; --plate) {
    if (add_to(plate - 1, piece, laid)) return true;
  }
  return false;
}

bool PlateSaver::empty_last(std::size_t plates, std::vector<LaidPiece>& laid) {
  double share = 0;
  for (const LaidPiece& one : laid) share += covered(one.turned);
  if (share > kMostCovered * static_cast<double>(plates - 1)) return false;
  std::vector<LaidPiece> others;
  std::vector<std::size_t> moving;
  for (const LaidPiece& one : laid) {
    if (one.plate + 1 < plates) {
      others.push_back(one);
    } else {
      moving.push_back(one.turned / turns_);
    }
  }
  std::stable_sort(moving.begin(), moving.end(), [&](auto a, auto b) {
    return covered(a * turns_) > covered(b * turns_);
  });
  for (const std::size_t piece : moving) {
    if (!add(piece, plates - 1, others)) return false;
  }
  laid = std::move(others);
  return true;
}

}  // namespace lamina::slicer
