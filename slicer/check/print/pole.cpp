#include "slicer/check/print/pole.h"

#include <algorithm>
#include <queue>

#include "plane/edge_tree.h"
#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

// No place is farther from the boundary than so many times the one returned.
constexpr double kEnough = 1.25;

// Squares to look at: what many more would find is hardly better.
constexpr int kMostSquares = 1000;

struct Square {
  Vec2 middle;
  double half = 0;      // of its side
  double distance = 0;  // of the middle from the boundary; negative outside

  // No place in it is farther from the boundary.
  double bound() const { return distance + half * 1.4142135623730951; }
  bool operator<(const Square& other) const { return bound() < other.bound(); }
};

}  // namespace

Vec2 pole_of(const plane::Contours& region) {
  const plane::EdgeTree tree(region);
  std::size_t guess = 0;
  const auto square_at = [&](Vec2 middle, double half) {
    guess = tree.nearest(middle, guess, 0);
    const double distance = tree.distance(guess, middle);
    const bool is_inside = tree.winding_number(middle) != 0;
    return Square{middle, half, is_inside ? distance : -distance};
  };
  Box2 box;
  box.add(std::span<const Vec2>(region.points));
  const double size = std::max(box.size().x, box.size().y);
  int left = kMostSquares;
  std::priority_queue<Square> open;
  open.push(square_at(box.center(), size / 2));
  Square best = open.top();
  while (open.top().bound() > std::max(kEnough * best.distance, 0.0) &&
         --left > 0) {
    const Square square = open.top();
    open.pop();
    const double half = square.half / 2;
    for (const Vec2 side :
         {Vec2(-1, -1), Vec2(1, -1), Vec2(-1, 1), Vec2(1, 1)}) {
      const Square part = square_at(square.middle + half * side, half);
      if (part.distance > best.distance) best = part;
      open.push(part);
    }
  }
  return best.distance > 0 ? best.middle : region.points.front();
}

}  // namespace lamina::slicer
