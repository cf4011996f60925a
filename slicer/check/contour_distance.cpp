#include "slicer/check/contour_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/plane.h"
#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Segment {
  Vec2 from;
  Vec2 to;
};

std::vector<Segment> segments_of(const ldni::Contours& contours) {
  std::vector<Segment> segments;
  segments.reserve(contours.points.size());
  visit_edges(contours, [&](Vec2 from, Vec2 to) {
    segments.push_back({from, to});
  });
  return segments;
}

double distance_to(const Box2& box, Vec2 point) {
  const Vec2 gap =
      glm::max(glm::max(box.low - point, point - box.high), Vec2(0));
  return glm::length(gap);
}

// Finds edges of one set by place.
class EdgeTree {
 public:
  explicit EdgeTree(std::vector<Segment> segments)
      : segments_(std::move(segments)) {
    std::vector<Box2> boxes(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      boxes[i].add(segments_[i].from);
      boxes[i].add(segments_[i].to);
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

  const std::vector<Segment>& segments() const { return segments_; }

  double distance(std::size_t segment, Vec2 point) const {
    return distance_to_segment(point, segments_[segment].from,
                               segments_[segment].to);
  }

  // The nearest edge, or any that is no farther than `enough`.
  //
  // guess  any edge; the search is the faster the nearer it is, or the next one
  std::size_t nearest(Vec2 point, std::size_t guess, double enough) const {
    double best = distance(guess, point);
    std::size_t found = guess;
    const std::size_t behind = guess + 1 < segments_.size() ? guess + 1 : 0;
    if (best > enough && distance(behind, point) < best) {
      best = distance(behind, point);
      found = behind;
    }
    if (best <= enough) return found;
    stack_.assign(1, {levels_.size() - 1, 0});
    while (!stack_.empty()) {
      const auto [level, index] = stack_.back();
      stack_.pop_back();
      if (distance_to(levels_[level][index], point) >= best) continue;
      if (level == 0) {
        const double here = distance(index, point);
        if (here < best) {
          best = here;
          found = index;
          if (best <= enough) return found;
        }
        continue;
      }
      const std::size_t begin = index * kFanOut;
      const std::size_t end =
          std::min(begin + kFanOut, levels_[level - 1].size());
      for (std::size_t i = end; i > begin; --i) {
        stack_.push_back({level - 1, i - 1});
      }
    }
    return found;
  }

 private:
  static constexpr std::size_t kFanOut = 6;

  struct Entry {
    std::size_t level;
    std::size_t index;
  };

  std::vector<Segment> segments_;
  std::vector<std::vector<Box2>> levels_;  // 0: of the edges
  mutable std::vector<Entry> stack_;
};

// Raises `greatest` to the greatest distance of points of `from` from `to`.
class Search {
 public:
  Search(const EdgeTree& to, ContourDistance& greatest)
      : to_(to), greatest_(greatest) {}

  void run(const std::vector<Segment>& from) {
    for (const Segment& segment : from) {
      // Edges follow each other, and so do the nearest ones.
      const End begin = segment.from == last_.point
                            ? last_
                            : end_at(segment.from, last_.nearest);
      last_ = end_at(segment.to, begin.nearest);
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

ContourDistance greatest_distance(const ldni::Contours& a,
                                  const ldni::Contours& b) {
  ContourDistance greatest;
  if (a.points.empty() && b.points.empty()) return greatest;
  if (a.points.empty() || b.points.empty()) {
    return {kInfinity, a.points.empty() ? b.points[0] : a.points[0]};
  }
  const EdgeTree tree_a(segments_of(a));
  const EdgeTree tree_b(segments_of(b));
  Search(tree_b, greatest).run(tree_a.segments());
  Search(tree_a, greatest).run(tree_b.segments());
  return greatest;
}

}  // namespace lamina::slicer
