#include "csg/plane/detail/planar_graph.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "base/plane.h"
#include "base/point_grid.h"
#include "csg/vertex_table.h"

namespace lamina::planar {
namespace {

PlanarGraph join_corners(std::span<const Contour> contours) {
  csg::VertexTable table;
  const auto name = [&](Vec2 p) { return table.name({p.x, p.y, 0}); };
  PlanarGraph graph;
  for (const Contour& contour : contours) {
    if (contour.empty()) continue;
    std::uint32_t from = name(contour.back());
    for (const Vec2 point : contour) {
      const std::uint32_t to = name(point);
      if (from != to) graph.edges.push_back({from, to});
      from = to;
    }
  }
  for (const Vec3& p : table.take_points()) graph.points.emplace_back(p);
  return graph;
}

// Points no farther than a distance from an edge, and not its ends.
class HotPixels {
 public:
  HotPixels(const std::vector<Vec2>& points, double distance)
      : points_(points), distance_(distance) {
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    grid_.fill(points, all);
  }

  // In the order in which the edge passes them.
  std::vector<std::uint32_t> along(const Edge& edge) const {
    const Vec2 a = points_[edge.from];
    const Vec2 b = points_[edge.to];
    const double length = glm::length(b - a);
    const Vec2 along = (b - a) / length;
    std::vector<std::pair<double, std::uint32_t>> passed;
    grid_.has_near(a, b, distance_, [&](std::uint32_t point) {
      const Vec2 d = points_[point] - a;
      const double way = dot(d, along);
      if (way > 0 && way < length && std::abs(cross(along, d)) <= distance_ &&
          point != edge.from && point != edge.to) {
        passed.emplace_back(way, point);
      }
      return false;  // look at all
    });
    std::sort(passed.begin(), passed.end());
    std::vector<std::uint32_t> points;
    points.reserve(passed.size());
    for (const auto& [way, point] : passed) points.push_back(point);
    return points;
  }

 private:
  const std::vector<Vec2>& points_;
  double distance_;
  PointGrid grid_;
};

void cut_edges(PlanarGraph& graph, double snap) {
  const HotPixels pixels(graph.points, snap);
  std::vector<Edge> cut;
  cut.reserve(graph.edges.size());
  for (const Edge& edge : graph.edges) {
    std::uint32_t from = edge.from;
    for (const std::uint32_t point : pixels.along(edge)) {
      cut.push_back({from, point});
      from = point;
    }
    cut.push_back({from, edge.to});
  }
  graph.edges = std::move(cut);
}

// Of edges between the same two points one is left where their number is odd,
// in the direction that most of them have.
void cancel_pairs(std::vector<Edge>& edges) {
  const auto ends = [](const Edge& edge) {
    return std::minmax({edge.from, edge.to});
  };
  std::sort(edges.begin(), edges.end(),
            [&](const Edge& a, const Edge& b) { return ends(a) < ends(b); });
  std::vector<Edge> single;
  for (std::size_t i = 0; i < edges.size();) {
    const auto [low, high] = ends(edges[i]);
    int sum = 0;
    for (; i < edges.size() && ends(edges[i]) == std::pair(low, high); ++i) {
      sum += edges[i].from == low ? 1 : -1;
    }
    if (sum % 2 != 0)
      single.push_back(sum > 0 ? Edge{low, high} : Edge{high, low});
  }
  edges = std::move(single);
}

}  // namespace

PlanarGraph snap_round(std::span<const Contour> contours, double snap) {
  PlanarGraph graph = join_corners(contours);
  if (graph.edges.empty()) return graph;
  cut_edges(graph, snap);
  cancel_pairs(graph.edges);
  return graph;
}

}  // namespace lamina::planar
