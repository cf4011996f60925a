#include "slicer/contour/detail/planar_loops.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "base/vec.h"
#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

struct Edge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

class PlanarGraph {
 public:
  explicit PlanarGraph(const plane::Contours& contours)
      : points_(contours.points) {
    std::ranges::sort(points_, precedes);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    add_edges(contours);
    cancel_edges();
    sort_edges();
  }

  void write_loops(plane::Contours& contours) const;

 private:
  std::uint32_t vertex_at(Vec2 point) const {
    return static_cast<std::uint32_t>(
        std::ranges::lower_bound(points_, point, precedes) - points_.begin());
  }
  Vec2 direction(const Edge& edge) const {
    return points_[edge.to] - points_[edge.from];
  }
  void add_edges(const plane::Contours& contours);
  void cancel_edges();
  void sort_edges();
  std::uint32_t next_of(const Edge& edge) const;

  std::vector<Vec2> points_;
  std::vector<Edge> edges_;  // by their begin and by their angle there
  std::vector<std::uint32_t> begins_;  // of each vertex, in edges_
};

void PlanarGraph::add_edges(const plane::Contours& contours) {
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    std::uint32_t from = vertex_at(loop.back());
    for (const Vec2 point : loop) {
      const std::uint32_t to = vertex_at(point);
      if (from != to) edges_.push_back({from, to});
      from = to;
    }
  }
}

// Of edges between the same vertices leaves those that no other runs against.
void PlanarGraph::cancel_edges() {
  const auto ends = [](const Edge& edge) {
    return std::minmax({edge.from, edge.to});
  };
  std::ranges::sort(edges_, {}, ends);
  std::vector<Edge> kept;
  for (const Edge& edge : edges_) {
    const bool is_opposite = !kept.empty() && kept.back().from == edge.to &&
                             kept.back().to == edge.from;
    if (is_opposite) {
      kept.pop_back();
    } else {
      kept.push_back(edge);
    }
  }
  edges_ = std::move(kept);
}

void PlanarGraph::sort_edges() {
  std::ranges::sort(edges_, [this](const Edge& a, const Edge& b) {
    if (a.from != b.from) return a.from < b.from;
    return compare_angles(direction(a), direction(b)) < 0;
  });
  begins_.assign(points_.size() + 1, 0);
  for (const Edge& edge : edges_) ++begins_[edge.from + 1];
  for (std::size_t i = 1; i < begins_.size(); ++i) {
    begins_[i] += begins_[i - 1];
  }
}

// The edge at the other side of the sector on the left of this one, where it
// ends: clockwise from the way back.
std::uint32_t PlanarGraph::next_of(const Edge& edge) const {
  const auto begin = edges_.begin() + begins_[edge.to];
  const auto end = edges_.begin() + begins_[edge.to + 1];
  const Vec2 back = -direction(edge);
  const auto next = std::partition_point(begin, end, [&](const Edge& other) {
    return compare_angles(direction(other), back) < 0;
  });
  return static_cast<std::uint32_t>((next == begin ? end : next) - 1 -
                                    edges_.begin());
}

// Where a walk comes to a vertex again, what lies between is a loop of its own.
void PlanarGraph::write_loops(plane::Contours& contours) const {
  contours.clear();
  std::vector<bool> is_walked(edges_.size());
  std::vector<std::uint32_t> places(points_.size(), kNone);  // on the path
  std::vector<std::uint32_t> path;
  std::vector<Vec2> loop;
  const auto write_from = [&](std::size_t begin) {
    loop.clear();
    for (std::size_t i = begin; i < path.size(); ++i) {
      places[path[i]] = kNone;
      loop.push_back(points_[path[i]]);
    }
    path.resize(begin);
    contours.add_loop(loop);
  };
  for (std::uint32_t start = 0; start < edges_.size(); ++start) {
    std::uint32_t e = start;
    while (!is_walked[e]) {
      is_walked[e] = true;
      const std::uint32_t vertex = edges_[e].from;
      if (places[vertex] != kNone) write_from(places[vertex]);
      places[vertex] = static_cast<std::uint32_t>(path.size());
      path.push_back(vertex);
      e = next_of(edges_[e]);
    }
    if (!path.empty()) write_from(0);
  }
}

}  // namespace

void link_planar_loops(plane::Contours& contours) {
  PlanarGraph(contours).write_loops(contours);
}

}  // namespace lamina::slicer
