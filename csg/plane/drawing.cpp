#include "csg/plane/detail/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csg/vertex_table.h"

namespace lamina::planar {
namespace {

Drawing join_corners(std::span<const Contour> contours) {
  csg::VertexTable table;
  const auto name = [&](Vec2 p) { return table.name({p.x, p.y, 0}); };
  Drawing drawing;
  for (const Contour& contour : contours) {
    if (contour.empty()) continue;
    std::uint32_t from = name(contour.back());
    for (const Vec2 point : contour) {
      const std::uint32_t to = name(point);
      if (from != to) drawing.edges.push_back({from, to});
      from = to;
    }
  }
  for (const Vec3& p : table.take_points()) drawing.points.emplace_back(p);
  return drawing;
}

// Points in about as many cells.
class PointGrid {
 public:
  explicit PointGrid(const std::vector<Vec2>& points, double least_cell)
      : points_(points) {
    count_ = std::max(1, static_cast<int>(std::sqrt(points.size())));
    Vec2 high = low_ = points.front();
    for (const Vec2 point : points) {
      low_ = glm::min(low_, point);
      high = glm::max(high, point);
    }
    cell_ =
        glm::max((high - low_) / static_cast<double>(count_), Vec2(least_cell));
    fill();
  }

  // Those no farther than `distance` from the line from a to b, on their way.
  std::vector<std::uint32_t> near(Vec2 a, Vec2 b, double distance) const {
    const double length = glm::length(b - a);
    const Vec2 along = (b - a) / length;
    std::vector<std::pair<double, std::uint32_t>> found;
    const auto test = [&](std::uint32_t name) {
      const Vec2 d = points_[name] - a;
      const double way = glm::dot(d, along);
      if (way > 0 && way < length &&
          std::abs(along.x * d.y - along.y * d.x) <= distance) {
        found.emplace_back(way, name);
      }
    };
    const int last_row = row(std::max(a.y, b.y) + distance);
    for (int j = row(std::min(a.y, b.y) - distance); j <= last_row; ++j) {
      const auto [least, greatest] = range_in_row(a, b, j, distance);
      const int last_column = column(greatest + distance);
      for (int i = column(least - distance); i <= last_column; ++i) {
        const std::size_t cell = index(i, j);
        std::for_each(at(begins_[cell]), at(begins_[cell + 1]), test);
      }
    }
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> names;
    for (const auto& [way, name] : found) {
      if (points_[name] != a && points_[name] != b) names.push_back(name);
    }
    return names;
  }

 private:
  void fill() {
    begins_.assign(index(0, count_) + 1, 0);
    const auto cell_of = [&](Vec2 p) { return index(column(p.x), row(p.y)); };
    for (const Vec2 point : points_) ++begins_[cell_of(point) + 1];
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    names_.resize(points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      names_[next[cell_of(points_[i])]++] = i;
    }
  }

  int column(double x) const { return place((x - low_.x) / cell_.x); }
  int row(double y) const { return place((y - low_.y) / cell_.y); }
  int place(double x) const {
    return static_cast<int>(std::clamp(x, 0.0, count_ - 1.0));
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(count_) +
           static_cast<std::size_t>(column);
  }
  std::vector<std::uint32_t>::const_iterator at(std::uint32_t begin) const {
    return names_.begin() + static_cast<std::ptrdiff_t>(begin);
  }

  // The line's x in a row of cells, and in what is no farther from the row.
  std::pair<double, double> range_in_row(Vec2 a, Vec2 b, int row,
                                         double distance) const {
    if (a.y > b.y) std::swap(a, b);
    const double low = low_.y + row * cell_.y - distance;
    const double high = low_.y + (row + 1) * cell_.y + distance;
    const double slope = a.y < b.y ? (b.x - a.x) / (b.y - a.y) : 0;
    const double from = low <= a.y ? a.x : a.x + (low - a.y) * slope;
    const double to = high >= b.y ? b.x : a.x + (high - a.y) * slope;
    return std::minmax(from, to);
  }

  const std::vector<Vec2>& points_;
  int count_ = 1;  // of rows, and of columns
  Vec2 low_{0};
  Vec2 cell_{1};
  std::vector<std::uint32_t> begins_;  // in names_, of each cell; and the end
  std::vector<std::uint32_t> names_;
};

void cut_edges(Drawing& drawing, double snap) {
  const PointGrid grid(drawing.points, snap);
  std::vector<Edge> pieces;
  pieces.reserve(drawing.edges.size());
  for (const Edge& edge : drawing.edges) {
    std::uint32_t from = edge.from;
    for (const std::uint32_t point :
         grid.near(drawing.points[edge.from], drawing.points[edge.to], snap)) {
      pieces.push_back({from, point});
      from = point;
    }
    pieces.push_back({from, edge.to});
  }
  drawing.edges = std::move(pieces);
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

Drawing draw(std::span<const Contour> contours, double snap) {
  Drawing drawing = join_corners(contours);
  if (drawing.edges.empty()) return drawing;
  cut_edges(drawing, snap);
  cancel_pairs(drawing.edges);
  return drawing;
}

}  // namespace lamina::planar
