#include "slicer/plate/detail/turned_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "plane/region/offset.h"
#include "plane/tie_distance.h"
#include "slicer/contour/simplify.h"
#include "slicer/plate/footprint.h"

namespace lamina::slicer {
namespace {

// By so much of the gap an outline is simplified, and a round join differs from
// an arc. It is given away on either side of a gap.
constexpr double kToleranceShare = 0.04;

// What the border of a footprint is moved outwards. Nothing at gap 0: two
// squares may touch.
double growth(double gap) {
  if (gap <= 2 * kTieDistance) return 0;
  return gap * (0.5 + 2 * kToleranceShare) + kTieDistance;
}

plane::Region grow(const plane::Region& footprint, double gap) {
  if (growth(gap) == 0) return footprint;
  const double tolerance = gap * kToleranceShare;
  plane::Contours contours = plane::to_contours(
      plane::offset(footprint, growth(gap), plane::Join::kRound, tolerance));
  Simplifier(tolerance).simplify(contours);
  return plane::to_region(contours);
}

Box2 box_or_origin(const plane::Region& region) {
  return region.is_empty() ? Box2{Vec2(0), Vec2(0)}
                           : plane::box_of(region.contours);
}

double diameter(const plane::Contour& contour) {
  const plane::Region hull = plane::convex_hull(contour);
  double longest = 0;
  for (const plane::Contour& corners : hull.contours) {
    for (const Vec2 a : corners) {
      for (const Vec2 b : corners)
        longest = std::max(longest, dot(b - a, b - a));
    }
  }
  return std::sqrt(longest);
}

double least_diameter(std::span<const Piece> pieces) {
  double least = std::numeric_limits<double>::max();
  for (const Piece& piece : pieces) {
    double its = 0;
    for (const plane::Contour& contour : piece.footprint.contours) {
      its = std::max(its, diameter(contour));
    }
    if (piece.quantity > 0) least = std::min(least, its);
  }
  return least;
}

// Fills holes in which no piece can lie: a disc is simpler than a ring.
void fill_holes(plane::Region& region, double least_diameter) {
  const std::size_t removed =
      std::erase_if(region.contours, [&](const plane::Contour& contour) {
        return plane::area({{contour}}) < 0 &&
               diameter(contour) < least_diameter;
      });
  // What lay in the hole is now in the region twice.
  if (removed > 0) {
    region = plane::from_contours(region.contours, plane::FillRule::kNonZero);
  }
}

}  // namespace

double greatest_growth(double gap) {
  return growth(gap) + gap * kToleranceShare;
}

std::vector<TurnedPiece> turn_pieces(std::span<const Piece> pieces, double gap,
                                     unsigned turns) {
  std::vector<TurnedPiece> turned(pieces.size() * turns);
  const double least = least_diameter(pieces);
  for_each_index(pieces.size(), [&](std::size_t i) {
    plane::Region grown = grow(pieces[i].footprint, gap);
    fill_holes(grown, least);
    for (unsigned turn = 0; turn < turns; ++turn) {
      TurnedPiece& piece = turned[i * turns + turn];
      piece.piece = i;
      piece.turn_deg = 360.0 * turn / turns;
      piece.box =
          box_or_origin(place(pieces[i].footprint, piece.turn_deg, Vec2(0)));
      piece.grown = place(grown, piece.turn_deg, -piece.box.low);
    }
  });
  return turned;
}

}  // namespace lamina::slicer
