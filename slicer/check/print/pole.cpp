#include "slicer/check/print/pole.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "plane/edge_tree.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

// No place is farther from the boundary than so many times the one returned.
constexpr double kEnough = 1.25;

// Squares to look at: what many more would find is hardly better.
constexpr std::size_t kMostSquares = 1000;

// A region is slender where its box is longer than so many times its width,
// twice the area over the perimeter. Squares as small as the width are so many
// that few of them are looked at: some, and some for each point.
constexpr double kSlender = 50;
constexpr std::size_t kSquares = 16;
constexpr std::size_t kSquaresPerPoint = 4;

// Chords across a slender region.
constexpr std::size_t kChords = 16;

struct Square {
  Vec2 middle;
  double half = 0;      // of its side
  double distance = 0;  // of the middle from the boundary; negative outside

  // No place in it is farther from the boundary.
  double bound() const { return distance + half * 1.4142135623730951; }
  bool operator<(const Square& other) const { return bound() < other.bound(); }
};

bool is_slender(const plane::Contours& region, double size) {
  double area = 0;
  double length = 0;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    area += signed_area(region.loop(i));
    length += perimeter(region.loop(i));
  }
  return size * length > kSlender * 2 * area;
}

// From an end of the region to the one opposite, in two looks.
Vec2 length_of(const plane::Contours& region, Vec2& begin) {
  const auto farthest_from = [&region](Vec2 place) {
    return *std::ranges::max_element(region.points, {}, [place](Vec2 point) {
      return glm::distance(place, point);
    });
  };
  begin = farthest_from(region.points.front());
  return farthest_from(begin) - begin;
}

// The middles of the longest parts of chords across the region's length. The
// middle of a chord across a strip is as far from both sides as a place in it
// can be, whichever way the chord runs.
std::vector<Vec2> chord_middles(const plane::Contours& region) {
  Vec2 begin;
  const Vec2 length = length_of(region, begin);
  const double scale = kChords / dot(length, length);
  // Places along the length in chords, the first half a chord from the end; and
  // across it in lengths.
  const auto along = [&](Vec2 point) {
    return dot(length, point - begin) * scale - 0.5;
  };
  const auto across = [&](Vec2 point) {
    return cross(length, point - begin) / dot(length, length);
  };
  std::array<std::vector<double>, kChords> crossings;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Vec2 from(along(loop[k]), across(loop[k]));
      const Vec2& next = loop[k + 1 < loop.size() ? k + 1 : 0];
      Vec2 to(along(next), across(next));
      if (from.x > to.x) std::swap(from, to);
      const double last = std::min(std::ceil(to.x), double{kChords});
      for (double chord = std::max(std::ceil(from.x), 0.0); chord < last;
           ++chord) {
        crossings[static_cast<std::size_t>(chord)].push_back(
            from.y + (chord - from.x) * (to.y - from.y) / (to.x - from.x));
      }
    }
  }
  std::vector<Vec2> middles;
  for (std::size_t chord = 0; chord < kChords; ++chord) {
    std::vector<double>& ends = crossings[chord];
    std::ranges::sort(ends);
    double longest = 0;
    double middle = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      if (ends[i + 1] - ends[i] <= longest) continue;
      longest = ends[i + 1] - ends[i];
      middle = ends[i] + longest / 2;
    }
    if (longest <= 0) continue;
    const double share = (static_cast<double>(chord) + 0.5) / kChords;
    middles.push_back(begin + share * length + middle * left_of(length));
  }
  return middles;
}

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
  const Box2 box = box_of(region.points);
  const double size = std::max(box.size().x, box.size().y);
  const bool is_slender = slicer::is_slender(region, size);
  std::size_t left = kMostSquares;
  if (is_slender) {
    left = std::min(left, kSquares + kSquaresPerPoint * region.points.size());
  }
  std::priority_queue<Square> open;
  open.push(square_at(box.center(), size / 2));
  Square best = open.top();
  const auto is_proved = [&] {
    return open.top().bound() <= std::max(kEnough * best.distance, 0.0);
  };
  while (!is_proved() && --left > 0) {
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
  if (is_slender && !is_proved()) {
    for (const Vec2 middle : chord_middles(region)) {
      const Square place = square_at(middle, 0);
      if (place.distance > best.distance) best = place;
    }
  }
  return best.distance > 0 ? best.middle : region.points.front();
}

}  // namespace lamina::slicer
