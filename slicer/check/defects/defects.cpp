#include "slicer/check/defects/defects.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "plane/edge_tree.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "slicer/contour/edge_order.h"

namespace lamina::slicer {
namespace {

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
bool is_within(Vec2 from, Vec2 to, Vec2 p) {
  return std::min(from.x, to.x) <= p.x && p.x <= std::max(from.x, to.x) &&
         std::min(from.y, to.y) <= p.y && p.y <= std::max(from.y, to.y);
}

using EdgePair = std::pair<std::uint32_t, std::uint32_t>;

// Finds the edges of a layer that cross.
class Crossings {
 public:
  explicit Crossings(std::span<const WrittenLoop> loops) {
    for (std::uint32_t l = 0; l < loops.size(); ++l) {
      const std::size_t begin = points_.size();
      for (const Vec2& point : loops[l].points) {
        // What repeats is reported as such.
        if (points_.size() == begin || point != points_.back()) {
          points_.push_back(point);
        }
      }
      if (points_.size() < begin + 2) {
        points_.resize(begin);
        continue;
      }
      ends_.push_back(static_cast<std::uint32_t>(points_.size()));
      numbers_.push_back(l);
    }
    vertices_.resize(points_.size());
    std::iota(vertices_.begin(), vertices_.end(), 0U);
    edges_.fill(points_, vertices_, ends_);
  }

  void find(std::vector<Defect>& defects) const {
    std::vector<EdgePair> crossing;
    // Stops where more are found than are reported.
    edges_.visit_near(
        0,
        [&](const EdgeTree::Bundle& a, const EdgeTree::Bundle& b) {
          compare(a, b, crossing);
          return crossing.size() >= kMostCrossings;
        },
        EdgeTree::Crowd::kVisit);
    std::ranges::sort(crossing);
    if (crossing.size() > kMostCrossings) crossing.resize(kMostCrossings);
    for (const auto& [first, second] : crossing) {
      const std::uint32_t loop = edges_.bundle(edges_.bundle_of(first)).loop;
      defects.push_back({DefectKind::kCrossing, numbers_[loop],
                         (edges_.from(first) + edges_.to(first)) / 2.0});
    }
  }

 private:
  using EdgeTree = plane::EdgeTree;

  // Adds the edges of the two bundles that cross.
  void compare(const EdgeTree::Bundle& a, const EdgeTree::Bundle& b,
               std::vector<EdgePair>& crossing) const {
    for (std::uint32_t i = a.begin; i < a.end; ++i) {
      for (std::uint32_t k = &a == &b ? i + 1 : b.begin; k < b.end; ++k) {
        const auto [first, second] = std::minmax(i, k);
        if (cross(first, second)) crossing.emplace_back(first, second);
      }
    }
  }

  // Whether the loop of `at` passes, at the end of that edge, from one side of
  // the loop of `other` to the other side.
  bool passes_through(std::uint32_t at, std::uint32_t other) const {
    const Vec2 p = edges_.to(at);
    const Vec2 before = edges_.from(at);
    const Vec2 after = edges_.to(edges_.next_of(at));
    const Vec2 from = edges_.from(other);
    const Vec2 to = edges_.to(other);
    if (p == from) return false;  // the edge before `other` sees to it
    if (p == to) {
      const Vec2 other_after = edges_.to(edges_.next_of(other));
      return is_in_sector(p, from, other_after, before) !=
             is_in_sector(p, from, other_after, after);
    }
    if (orientation(from, to, p) != 0 || !is_within(from, to, p)) return false;
    return orientation(from, to, before) * orientation(from, to, after) < 0;
  }

  bool cross(std::uint32_t a, std::uint32_t b) const {
    const Vec2 from = edges_.from(a);
    const Vec2 to = edges_.to(a);
    const Vec2 other_from = edges_.from(b);
    const Vec2 other_to = edges_.to(b);
    if (std::max(from.x, to.x) < std::min(other_from.x, other_to.x) ||
        std::max(other_from.x, other_to.x) < std::min(from.x, to.x) ||
        std::max(from.y, to.y) < std::min(other_from.y, other_to.y) ||
        std::max(other_from.y, other_to.y) < std::min(from.y, to.y)) {
      return false;
    }
    const int begins = orientation(from, to, other_from);
    const int ends = orientation(from, to, other_to);
    if (begins * ends > 0) return false;
    if (begins == 0 && ends == 0) {
      // On one line: they may share a point but no length.
      const Vec2 along = to - from;
      const double begin = dot(along, other_from - from);
      const double end = dot(along, other_to - from);
      return std::min(std::max(begin, end), dot(along, along)) >
             std::max(std::min(begin, end), 0.0);
    }
    const int own_begins = orientation(other_from, other_to, from);
    const int own_ends = orientation(other_from, other_to, to);
    if (own_begins * own_ends > 0) return false;
    if (begins * ends < 0 && own_begins * own_ends < 0) return true;
    if (edges_.next_of(a) == b || edges_.next_of(b) == a) return false;
    return passes_through(a, b) || passes_through(b, a);
  }

  std::vector<Vec2> points_;
  std::vector<std::uint32_t> vertices_;  // all of them
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> numbers_;  // of the loops in the file
  EdgeTree edges_;
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
    // A loop near the ends of the numbers may have an area and no such edge.
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
  const std::size_t known = defects.size();
  Crossings(loops).find(defects);
  // Loops that cross have no nesting.
  if (defects.size() > known) return defects;
  find_turned(loops, enclosing, defects);
  return defects;
}

}  // namespace lamina::slicer
