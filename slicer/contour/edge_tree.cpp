#include "slicer/contour/edge_tree.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

double squared_distance_to(const Box2& box, Vec2 point) {
  const double x =
      std::max(std::max(box.low.x - point.x, point.x - box.high.x), 0.0);
  const double y =
      std::max(std::max(box.low.y - point.y, point.y - box.high.y), 0.0);
  return x * x + y * y;
}

// The square of what distance_to_segment() returns, before its root is rounded.
double squared_distance_to(const EdgeTree::Edge& edge, Vec2 point) {
  const double share = nearest_share(point, edge.from, edge.to);
  const Vec2 away = point - (edge.from + share * (edge.to - edge.from));
  return dot(away, away);
}

// More than rounding can add to a square.
constexpr double kRoundedUp = 1 + 1e-12;

}  // namespace

EdgeTree::EdgeTree(const plane::Contours& contours) {
  edges_.reserve(contours.points.size());
  visit_edges(contours, [&](Vec2 from, Vec2 to) {
    edges_.push_back({from, to});
  });
  std::vector<Box2> boxes((edges_.size() + kFanOut - 1) / kFanOut);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    boxes[i / kFanOut].add(edges_[i].from);
    boxes[i / kFanOut].add(edges_[i].to);
  }
  while (boxes.size() > 1) {
    std::vector<Box2> wider((boxes.size() + kFanOut - 1) / kFanOut);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      wider[i / kFanOut].add(boxes[i]);
    }
    levels_.push_back(std::move(boxes));
    boxes = std::move(wider);
  }
  levels_.push_back(std::move(boxes));
}

// Follows the edges as long as they come nearer.
void EdgeTree::follow(Vec2 point, double enough, std::size_t& edge,
                      double& its_distance) const {
  for (const std::size_t step : {std::size_t{1}, edges_.size() - 1}) {
    while (its_distance > enough) {
      std::size_t next = edge + step;
      if (next >= edges_.size()) next -= edges_.size();
      const double there = distance(next, point);
      if (!(there < its_distance)) break;
      its_distance = there;
      edge = next;
    }
  }
}

std::size_t EdgeTree::nearest(Vec2 point, std::size_t guess,
                              double enough) const {
  double best = distance(guess, point);
  std::size_t found = guess;
  follow(point, enough, found, best);
  if (best > enough) lower(point, enough, best, found);
  return found;
}

void EdgeTree::lower(Vec2 point, double enough, double& best,
                     std::size_t& guess) const {
  struct Place {
    double square;  // of the box's distance
    std::uint32_t level;
    std::uint32_t index;
  };
  // As deep as 64 bits can count, and kFanOut open on each level; of those the
  // nearest is last.
  std::array<Place, 32 * kFanOut> open;
  std::size_t count = 0;
  open[count++] = {0, static_cast<std::uint32_t>(levels_.size() - 1), 0};
  while (count > 0) {
    const auto [box_square, level, index] = open[--count];
    if (box_square >= best * best) continue;
    const std::size_t begin = index * kFanOut;
    if (level == 0) {
      const std::size_t end = std::min(begin + kFanOut, edges_.size());
      for (std::size_t edge = begin; edge < end; ++edge) {
        const double square = squared_distance_to(edges_[edge], point);
        if (square > kRoundedUp * best * best) continue;
        const double here = std::sqrt(square);
        if (here >= best) continue;
        best = here;
        guess = edge;
      }
      if (best <= enough) return;
      continue;
    }
    const std::vector<Box2>& boxes = levels_[level - 1];
    const std::size_t end = std::min(begin + kFanOut, boxes.size());
    const std::size_t first = count;
    for (std::size_t i = begin; i < end; ++i) {
      const double square = squared_distance_to(boxes[i], point);
      if (square >= best * best) continue;
      std::size_t place = count++;
      for (; place > first && open[place - 1].square < square; --place) {
        open[place] = open[place - 1];
      }
      open[place] = {square, level - 1, static_cast<std::uint32_t>(i)};
    }
  }
}

}  // namespace lamina::slicer
