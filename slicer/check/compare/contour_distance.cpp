#include "slicer/check/compare/contour_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "slicer/contour/edge_tree.h"

namespace lamina::slicer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Raises `greatest` to the greatest distance of points of `from` from `to`.
class Search {
 public:
  Search(const EdgeTree& to, ContourDistance& greatest)
      : to_(to), greatest_(greatest) {}

  void run(const std::vector<EdgeTree::Edge>& from) {
    for (const EdgeTree::Edge& edge : from) {
      // Edges follow each other, and so do the nearest ones.
      const End begin =
          edge.from == last_.point ? last_ : end_at(edge.from, last_.nearest);
      last_ = end_at(edge.to, begin.nearest);
      parts_.assign(1, {begin, last_});
      while (!parts_.empty()) {
        const Part part = parts_.back();
        parts_.pop_back();
        halve(part);
      }
    }
  }

 private:
  struct End {
    Vec2 point = Vec2(kInfinity);
    std::size_t nearest = 0;  // or near enough
    double distance = 0;      // from that
  };
  struct Part {
    End begin;
    End end;
  };

  // A distance below the greatest so far need not be exact.
  End end_at(Vec2 point, std::size_t guess) {
    const std::size_t nearest = to_.nearest(point, guess, greatest_.distance);
    const double distance = to_.distance(nearest, point);
    if (distance > greatest_.distance) greatest_ = {distance, point};
    return {point, nearest, distance};
  }

  void halve(const Part& part) {
    const double bound =
        std::min(std::max(part.begin.distance,
                          to_.distance(part.begin.nearest, part.end.point)),
                 std::max(part.end.distance,
                          to_.distance(part.end.nearest, part.begin.point)));
    if (bound <= greatest_.distance + kDistanceResolution) return;
    const Vec2 middle = (part.begin.point + part.end.point) / 2.0;
    if (middle == part.begin.point || middle == part.end.point) return;
    const End half = end_at(middle, part.begin.nearest);
    parts_.push_back({part.begin, half});
    parts_.push_back({half, part.end});
  }

  const EdgeTree& to_;
  ContourDistance& greatest_;
  End last_;
  std::vector<Part> parts_;
};

}  // namespace

ContourDistance greatest_distance(const plane::Contours& a,
                                  const plane::Contours& b) {
  ContourDistance greatest;
  if (a.points.empty() && b.points.empty()) return greatest;
  if (a.points.empty() || b.points.empty()) {
    return {kInfinity, a.points.empty() ? b.points[0] : a.points[0]};
  }
  const EdgeTree tree_a(a);
  const EdgeTree tree_b(b);
  Search(tree_b, greatest).run(tree_a.edges());
  Search(tree_a, greatest).run(tree_b.edges());
  return greatest;
}

}  // namespace lamina::slicer
