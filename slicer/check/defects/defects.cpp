#include "slicer/check/defects/defects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <glm/common.hpp>

#include "plane/cell_grid.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "slicer/contour/edge_order.h"

namespace lamina::slicer {
namespace {

struct Edge {
  Vec2 from;
  Vec2 to;
  std::uint32_t loop;
  std::uint32_t next;  // the edge that follows
};

// Whether the direction at→c lies strictly between at→a and at→b,
// counter-clockwise from a.
bool is_in_sector(Vec2 at, Vec2 a, Vec2 b, Vec2 c) {
  const int ab = orientation(at, a, b);
  const int ac = orientation(at, a, c);
  const int cb = orientation(at, c, b);
  if (ab > 0) return ac > 0 && cb > 0;
  return ac > 0 || cb > 0;  // a reflex sector
}

// `p` is on the line of the edge: is it between its ends?
bool is_within(const Edge& edge, Vec2 p) {
  return std::min(edge.from.x, edge.to.x) <= p.x &&
         p.x <= std::max(edge.from.x, edge.to.x) &&
         std::min(edge.from.y, edge.to.y) <= p.y &&
         p.y <= std::max(edge.from.y, edge.to.y);
}

using EdgePair = std::pair<std::uint32_t, std::uint32_t>;

// Leaves each pair once, sorted.
void remove_repeated(std::vector<EdgePair>& pairs) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

// Finds the edges of a layer by place.
class EdgeGrid {
 public:
  explicit EdgeGrid(std::span<const WrittenLoop> loops) {
    collect_edges(loops);
    choose_cells();
    members_.fill(grid_.size(), [this](const auto& list) {
      for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        visit_cells(edges_[i], [&](std::size_t cell) { list(cell, i); });
      }
    });
  }

  void find_crossings(std::vector<Defect>& defects) const {
    std::vector<EdgePair> crossing = crossing_edges();
    if (crossing.size() > kMostCrossings) crossing.resize(kMostCrossings);
    for (const auto& [first, second] : crossing) {
      const Edge& edge = edges_[first];
      defects.push_back(
          {DefectKind::kCrossing, edge.loop, (edge.from + edge.to) / 2.0});
    }
  }

 private:
  void collect_edges(std::span<const WrittenLoop> loops) {
    for (std::uint32_t l = 0; l < loops.size(); ++l) {
      const std::vector<Vec2>& points = loops[l].points;
      const auto first = static_cast<std::uint32_t>(edges_.size());
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (points[i] == points[i + 1]) continue;  // reported as a repeat
        const auto next = static_cast<std::uint32_t>(edges_.size()) + 1;
        edges_.push_back({points[i], points[i + 1], l, next});
      }
      if (edges_.size() > first) edges_.back().next = first;
    }
  }

  // Chooses about one cell for each edge, square if possible. Edges must not
  // stand in more than kMostCells on the average: along long ones, cells are
  // few then.
  void choose_cells() {
    constexpr double kMostCells = 64;
    if (edges_.empty()) return;
    Box2 box;
    Vec2 way(0);
    for (const Edge& edge : edges_) {
      box.add(edge.from);
      box.add(edge.to);
      way += glm::abs(edge.to - edge.from);
    }
    // A layer without width has one column.
    constexpr double kNoSize = 1e-150;
    const Vec2 size = glm::max(box.size(), Vec2(kNoSize));
    // Beyond the numbers' range no cell has a size: there is one then.
    if (!std::isfinite(size.x + size.y) || !std::isfinite(way.x + way.y)) {
      return;
    }
    const auto wanted = static_cast<double>(edges_.size());
    const Vec2 most = kMostCells * wanted * size / glm::max(way, size);
    const double columns = std::clamp(std::sqrt(wanted * size.x / size.y), 1.0,
                                      std::min(wanted, most.x));
    const double rows = std::clamp(wanted / columns, 1.0, most.y);
    const auto column_count = static_cast<std::uint32_t>(columns);
    const auto row_count = static_cast<std::uint32_t>(rows);
    grid_ = {box.low, Vec2(column_count, row_count) / size, column_count,
             row_count};
  }

  // Calls visit(cell) for every cell that the edge meets, and perhaps a few
  // beside them.
  template <typename Visit>
  void visit_cells(const Edge& edge, const Visit& visit) const {
    if (grid_.size() == 1) return visit(0);
    // Far above rounding, far below a cell.
    const Vec2 margin = 1e-6 / grid_.cells_per_mm();
    grid_.visit_cells(edge.from, edge.to, margin, visit);
  }

  // Whether the loop of `at` passes, at the end of that edge, from one side of
  // the loop of `other` to the other side.
  bool passes_through(const Edge& at, const Edge& other) const {
    const Vec2 p = at.to;
    const Vec2 before = at.from;
    const Vec2 after = edges_[at.next].to;
    if (p == other.from) return false;  // the edge before `other` sees to it
    if (p == other.to) {
      const Vec2 other_after = edges_[other.next].to;
      return is_in_sector(p, other.from, other_after, before) !=
             is_in_sector(p, other.from, other_after, after);
    }
    if (orientation(other.from, other.to, p) != 0 || !is_within(other, p))
      return false;
    return orientation(other.from, other.to, before) *
               orientation(other.from, other.to, after) <
           0;
  }

  bool cross(const Edge& a, const Edge& b) const {
    if (std::max(a.from.x, a.to.x) < std::min(b.from.x, b.to.x) ||
        std::max(b.from.x, b.to.x) < std::min(a.from.x, a.to.x) ||
        std::max(a.from.y, a.to.y) < std::min(b.from.y, b.to.y) ||
        std::max(b.from.y, b.to.y) < std::min(a.from.y, a.to.y)) {
      return false;
    }
    const int b_from = orientation(a.from, a.to, b.from);
    const int b_to = orientation(a.from, a.to, b.to);
    if (b_from * b_to > 0) return false;
    if (b_from == 0 && b_to == 0) {
      // On one line: they may share a point but no length.
      const Vec2 along = a.to - a.from;
      const auto place = [&](Vec2 p) {
        return along.x * (p.x - a.from.x) + along.y * (p.y - a.from.y);
      };
      const double low = std::min(place(b.from), place(b.to));
      const double high = std::max(place(b.from), place(b.to));
      return std::min(high, place(a.to)) > std::max(low, 0.0);
    }
    const int a_from = orientation(b.from, b.to, a.from);
    const int a_to = orientation(b.from, b.to, a.to);
    if (a_from * a_to > 0) return false;
    if (b_from * b_to < 0 && a_from * a_to < 0) return true;
    if (&edges_[a.next] == &b || &edges_[b.next] == &a) return false;
    return passes_through(a, b) || passes_through(b, a);
  }

  std::vector<EdgePair> crossing_edges() const {
    // Two edges may meet in several cells.
    constexpr std::size_t kMostRepeated = 4 * kMostCrossings;
    std::vector<EdgePair> crossing;
    for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
      const auto edges = members_[cell];
      for (std::size_t i = 0; i < edges.size(); ++i) {
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
          if (!cross(edges_[edges[i]], edges_[edges[j]])) continue;
          crossing.emplace_back(edges[i], edges[j]);
          if (crossing.size() < kMostRepeated) continue;
          remove_repeated(crossing);
          if (crossing.size() >= kMostCrossings) return crossing;
        }
      }
    }
    remove_repeated(crossing);
    return crossing;
  }

  std::vector<Edge> edges_;
  CellGrid grid_;
  CellLists<std::uint32_t> members_;
};

// Finds loops that are turned against their nesting. Loops do not cross, so
// what goes around one edge of a loop goes around the loop.
void find_turned(std::span<const WrittenLoop> loops,
                 std::span<const std::uint32_t> enclosing,
                 std::vector<Defect>& defects) {
  EdgeOrder order;
  std::vector<std::size_t> ends(1, 0);  // of each loop, among the edges
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    const std::vector<Vec2>& points = loops[l].points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (points[i].x != points[i + 1].x) {
        order.add(points[i], points[i + 1], l);
      }
    }
    ends.push_back(order.edges().size());
  }
  order.build();
  for (const std::uint32_t l : enclosing) {
    const std::vector<Vec2>& points = loops[l].points;
    // Of a loop near the ends of the numbers the area may be none of its own.
    if (ends[l + 1] == ends[l]) continue;
    const EdgeOrder::Edge& edge = order.edges()[ends[l]];
    const bool is_hole = signed_area(points) < 0;
    // The inside is to the left of an outer loop, to the right of a hole: below
    // an edge that has it below, the loop itself goes around, too.
    const int turn = is_hole ? -1 : 1;
    const int own = edge.winding == turn ? 0 : turn;
    if (order.below(edge).winding - own != (is_hole ? 1 : 0)) {
      defects.push_back({DefectKind::kOrientation, l, points.front()});
    }
  }
}

// Finds the defects of a loop by itself; returns whether it encloses something.
bool find_own_defects(const WrittenLoop& loop, std::uint32_t index,
                      std::vector<Defect>& defects) {
  const std::vector<Vec2>& points = loop.points;
  const Vec2 place = points.empty() ? Vec2(0) : points.front();
  if (loop.gaps != 0) defects.push_back({DefectKind::kGap, index, place});
  if (points.size() < 2 || points.front() != points.back()) {
    defects.push_back({DefectKind::kOpen, index, place});
    return false;
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i] == points[i + 1]) {
      defects.push_back({DefectKind::kRepeat, index, points[i]});
    }
  }
  if (points.size() < 4 || signed_area(points) == 0) {
    defects.push_back({DefectKind::kZeroArea, index, place});
    return false;
  }
  return true;
}

}  // namespace

std::string_view describe(DefectKind kind) {
  constexpr auto kWords = std::to_array<std::string_view>(
      {"is not closed", "counts gaps", "repeats a vertex", "has no area",
       "crosses itself or another", "is turned against its nesting"});
  return kWords[static_cast<std::size_t>(kind)];
}

std::vector<Defect> find_defects(std::span<const WrittenLoop> loops) {
  std::vector<Defect> defects;
  std::vector<std::uint32_t> enclosing;
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    if (find_own_defects(loops[l], l, defects)) enclosing.push_back(l);
  }
  const EdgeGrid grid(loops);
  const std::size_t known = defects.size();
  grid.find_crossings(defects);
  // Loops that cross have no nesting.
  if (defects.size() > known) return defects;
  find_turned(loops, enclosing, defects);
  return defects;
}

}  // namespace lamina::slicer
