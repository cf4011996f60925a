#include "slicer/plate/detail/turned_piece.h"

#include "base/parallel.h"
#include "plane/region/offset.h"
#include "plane/tie_distance.h"
#include "slicer/contour/simplify.h"
#include "slicer/plate/footprint.h"

namespace lamina::slicer {
namespace {

// By so much of the gap an outline is simplified, and a round join differs from
// an arc. It is given away on either side of a gap.
constexpr double kToleranceShare = 0.02;

// What the border of a footprint is moved outwards. Nothing at gap 0: two
// squares may touch.
double growth(double gap) {
  if (gap <= 2 * kTieDistance) return 0;
  return gap * (0.5 + 2 * kToleranceShare) + kTieDistance;
}

plane::Region grow(const plane::Region& footprint, double gap) {
  if (growth(gap) == 0) return footprint;
  const double tolerance = gap * kToleranceShare;
  plane::Contours contours = plane::to_contours(footprint);
  Simplifier(tolerance).simplify(contours);
  return plane::offset(plane::to_region(contours), growth(gap),
                       plane::Join::kRound, tolerance);
}

Box2 box_of(const plane::Region& region) {
  Box2 box;
  for (const plane::Contour& contour : region.contours) box.add(contour);
  return region.is_empty() ? Box2{Vec2(0), Vec2(0)} : box;
}

}  // namespace

double greatest_growth(double gap) {
  return growth(gap) + 2 * gap * kToleranceShare;
}

std::vector<TurnedPiece> turn_pieces(std::span<const Piece> pieces, double gap,
                                     unsigned turns) {
  std::vector<TurnedPiece> turned(pieces.size() * turns);
  for_each_index(pieces.size(), [&](std::size_t i) {
    const plane::Region grown = grow(pieces[i].footprint, gap);
    for (unsigned turn = 0; turn < turns; ++turn) {
      TurnedPiece& piece = turned[i * turns + turn];
      piece.piece = i;
      piece.turn_deg = 360.0 * turn / turns;
      piece.box = box_of(place(pieces[i].footprint, piece.turn_deg, Vec2(0)));
      piece.grown = place(grown, piece.turn_deg, -piece.box.low);
    }
  });
  return turned;
}

}  // namespace lamina::slicer
