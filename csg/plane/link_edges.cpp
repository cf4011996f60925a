#include "csg/plane/link_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/cell_grid.h"
#include "base/loop_area.h"
#include "base/plane.h"
#include "csg/plane/detail/planar_graph.h"

namespace lamina::planar {
namespace {

// Each edge ends in two darts: number 2·edge where it begins, 2·edge + 1 where
// it ends. The darts of a point stand counter-clockwise around it; there is an
// even number of them.
class Linker {
 public:
  explicit Linker(const PlanarGraph& graph)
      : points_(graph.points), edges_(graph.edges) {
    list_darts();
    sort_darts();
  }

  // Loops that do not cross and go through no point twice.
  std::vector<Contour> link() {
    std::vector<bool> is_done(edges_.size());
    is_on_way_.assign(points_.size(), false);
    for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) {
      if (is_done[edge]) continue;
      const std::uint32_t first = 2 * edge;
      std::uint32_t dart = first;
      do {
        is_done[dart / 2] = true;
        visit(origin(dart));
        dart = partner(dart ^ 1);
      } while (dart != first);
      visit(origin(first));
      is_on_way_[origin(first)] = false;
      way_.clear();
    }
    return std::move(loops_);
  }

 private:
  std::uint32_t origin(std::uint32_t dart) const {
    const Edge& edge = edges_[dart / 2];
    return dart % 2 == 0 ? edge.from : edge.to;
  }

  Vec2 direction(std::uint32_t dart) const {
    return points_[origin(dart ^ 1)] - points_[origin(dart)];
  }

  void list_darts() {
    begins_.assign(points_.size() + 1, 0);
    for (std::uint32_t dart = 0; dart < 2 * edges_.size(); ++dart) {
      ++begins_[origin(dart) + 1];
    }
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    darts_.resize(2 * edges_.size());
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    for (std::uint32_t dart = 0; dart < darts_.size(); ++dart) {
      darts_[next[origin(dart)]++] = dart;
    }
  }

  // An edge has solid on its left if its direction is right. So the first dart
  // is one that leaves the point: solid comes next.
  void sort_darts() {
    const auto at = [&](std::uint32_t place) {
      return darts_.begin() + static_cast<std::ptrdiff_t>(place);
    };
    for (std::size_t point = 0; point < points_.size(); ++point) {
      const auto begin = at(begins_[point]);
      const auto end = at(begins_[point + 1]);
      std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
        return compare_angles(direction(a), direction(b)) < 0;
      });
      const auto leaves = [](std::uint32_t dart) { return dart % 2 == 0; };
      const auto first = std::find_if(begin, end, leaves);
      if (first != end) std::rotate(begin, first, end);
    }
    places_.resize(darts_.size());
    for (std::uint32_t i = 0; i < darts_.size(); ++i) places_[darts_[i]] = i;
  }

  // The dart beside this one, across what is solid.
  std::uint32_t partner(std::uint32_t dart) const {
    const std::uint32_t begin = begins_[origin(dart)];
    return darts_[begin + ((places_[dart] - begin) ^ 1)];
  }

  // Goes on to this point. Where the way has been there it closes a loop.
  void visit(std::uint32_t point) {
    if (is_on_way_[point]) {
      Contour loop;
      for (bool is_whole = false; !is_whole; way_.pop_back()) {
        const std::uint32_t last = way_.back();
        loop.push_back(points_[last]);
        is_on_way_[last] = false;
        is_whole = last == point;
      }
      std::reverse(loop.begin(), loop.end());
      if (loop.size() > 2) loops_.push_back(std::move(loop));
    }
    way_.push_back(point);
    is_on_way_[point] = true;
  }

  const std::vector<Vec2>& points_;
  const std::vector<Edge>& edges_;
  std::vector<std::uint32_t> begins_;  // in darts_, of each point; and the end
  std::vector<std::uint32_t> darts_;
  std::vector<std::uint32_t> places_;  // in darts_, of each dart

  std::vector<std::uint32_t> way_;  // points that are in no loop yet
  std::vector<bool> is_on_way_;     // by name
  std::vector<Contour> loops_;
};

struct Line {
  Vec2 from;
  Vec2 to;
};

double width(const Line& line) { return std::abs(line.to.x - line.from.x); }

Line widest_edge(const Contour& contour) {
  Line widest = {contour.back(), contour.front()};
  for (std::size_t i = 1; i < contour.size(); ++i) {
    const Line edge = {contour[i - 1], contour[i]};
    if (width(edge) > width(widest)) widest = edge;
  }
  return widest;
}

// Finds on which side of loops it is solid. The plane is cut into strips, so
// that few edges have to be looked at.
class SideFinder {
 public:
  explicit SideFinder(const std::vector<Contour>& loops) {
    if (loops.empty()) return;
    double low = loops[0][0].x;
    double high = low;
    for (const Contour& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Line edge = {loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]};
        low = std::min(low, edge.from.x);
        high = std::max(high, edge.from.x);
        edges_.push_back(edge);
      }
    }
    fill_strips(low, high);
  }

  bool is_solid_on_the_left(const Contour& loop) const {
    const Line edge = widest_edge(loop);
    // Where no corner is likely to stand.
    constexpr double kSomewhere = 0.41421356;
    const Vec2 p = edge.from + kSomewhere * (edge.to - edge.from);
    return is_solid_above(p, edge) == (edge.from.x < edge.to.x);
  }

 private:
  // Columns of one cell.
  void fill_strips(double low, double high) {
    // Wide edges stand in all of them.
    constexpr double kMostStrips = 256;
    const double root = std::sqrt(static_cast<double>(edges_.size()));
    const double count = std::max(std::floor(std::min(root, kMostStrips)), 1.0);
    grid_ = {{low, 0}, {high, 0}, high > low ? count / (high - low) : 0};
    strips_.fill(grid_.size(), [&](const auto& list) {
      for (const Line& edge : edges_) {
        const auto [from, to] = std::minmax(edge.from.x, edge.to.x);
        const std::uint32_t last = grid_.column_of(to);
        for (std::uint32_t k = grid_.column_of(from); k <= last; ++k) {
          list(k, edge);
        }
      }
    });
  }

  // Just above this point of an edge.
  bool is_solid_above(Vec2 p, const Line& its_edge) const {
    bool is_solid = false;
    for (const Line& edge : strips_[grid_.column_of(p.x)]) {
      const bool is_own = edge.from == its_edge.from && edge.to == its_edge.to;
      if (!is_own && stands_above(edge, p)) is_solid = !is_solid;
    }
    return is_solid;
  }

  static bool stands_above(const Line& edge, Vec2 p) {
    const auto [a, b] = edge;
    if ((a.x <= p.x) == (b.x <= p.x)) return false;
    return orientation(a, b, p) == (a.x < b.x ? -1 : 1);
  }

  std::vector<Line> edges_;
  CellGrid grid_;  // of one row
  CellLists<Line> strips_;
};

}  // namespace

std::vector<Contour> link_edges(std::span<const Contour> contours,
                                double snap) {
  const PlanarGraph graph = snap_round(contours, snap);
  std::vector<Contour> loops = Linker(graph).link();
  if (loops.size() == 1) {
    if (sliver_area(loops[0]) < 0)
      std::reverse(loops[0].begin(), loops[0].end());
    return loops;
  }
  const SideFinder sides(loops);
  for (Contour& loop : loops) {
    if (!sides.is_solid_on_the_left(loop)) {
      std::reverse(loop.begin(), loop.end());
    }
  }
  return loops;
}

}  // namespace lamina::planar
