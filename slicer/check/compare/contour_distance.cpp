#include "slicer/check/compare/contour_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "plane/edge_tree.h"
#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Raises `greatest` to the greatest distance of points of `from` from `to`.
class Search {
 public:
  Search(const plane::EdgeTree& to, ContourDistance& greatest)
      : to_(to), greatest_(greatest) {}

  void run(const plane::Contours& contours) {
    visit_edges(contours, [this](Vec2 from, Vec2 to) {
      // Edges follow each other, and so do the nearest ones.
      const End begin =
          from == last_.point ? last_ : end_at(from, last_.nearest);
      last_ = end_at(to, begin.nearest);
      parts_.assign(1, {begin, last_});
      while (!parts_.empty()) {
        const Part part = parts_.back();
        parts_.pop_back();
        halve(part);
      }
    });
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

  const plane::EdgeTree& to_;
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
  Search(plane::EdgeTree(b), greatest).run(a);
  Search(plane::EdgeTree(a), greatest).run(b);
  return greatest;
}

}  // namespace lamina::slicer
