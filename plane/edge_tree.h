#pragma once
// The edges of closed loops by place: which lie near each other, near a point
// or near a segment, and how often they wind around a point.
//
// A few successive edges make a bundle, two neighbours on a level the node
// above them; loops near each other are neighbours too. So a node holds
// successive edges, and its box says most of what a question needs:
//
// - What lies near what? Two nodes whose boxes are apart, at any level, are
//   done; and so are two that follow each other, or are one, where all their
//   edges advance along an axis to the same side: then their vertices lie one
//   behind the other. The caller gets what neither test separates, bundle by
//   bundle. On sections of rings this takes a third of the instructions of a
//   grid of the vertices.
// - Which edge is nearest? The nearer box is opened first, and none that is
//   farther than the nearest edge so far.
// - What winds around a point? Edges of one loop that follow each other beside
//   the point count by the ends of their run alone.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/lanes.h"
#include "base/vec.h"
#include "plane/contours.h"
#include "plane/predicates.h"

namespace lamina::plane {

// Whether the segment meets the square around `middle`, its rim included.
inline bool meets_square(Vec2 from, Vec2 to, Vec2 middle, double half_width) {
  const Vec2 low = middle - Vec2(half_width);
  const Vec2 high = middle + Vec2(half_width);
  // One branch for all sides: which one it is could not be predicted.
  const int sides_beyond = static_cast<int>(std::max(from.x, to.x) < low.x) +
                           static_cast<int>(std::min(from.x, to.x) > high.x) +
                           static_cast<int>(std::max(from.y, to.y) < low.y) +
                           static_cast<int>(std::min(from.y, to.y) > high.y);
  if (sides_beyond != 0) return false;
  // Corners on both sides of the line, or on it.
  const Vec2 along = to - from;
  const Vec2 aside = middle - from;
  const double reach = half_width * (std::abs(along.x) + std::abs(along.y));
  return std::abs(cross(along, aside)) <= reach;
}

class EdgeTree {
 public:
  // Three edges each, or up to 64 that all lead to the right, or all to the
  // left: these are filled in half the time, and a search in one takes the
  // edges above and below the place. For few questions about distances.
  enum class Bundles { kShort, kRuns };

  EdgeTree() = default;
  explicit EdgeTree(const Contours& contours) { fill(contours); }
  EdgeTree(EdgeTree&&) = default;
  EdgeTree& operator=(EdgeTree&&) = default;

  // Edges [begin, end): edge k runs from vertex k to vertex k + 1.
  struct Bundle {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t loop = 0;
  };

  // Replaces what the tree holds.
  //
  // points    of closed loops one after another
  // vertices  indices into points, loop by loop; the last of a loop is a copy
  //           of its first. An edge stands for all points from its first vertex
  //           to its second.
  // ends      loop l: vertices [ends[l-1], ends[l])
  //
  // All three must outlive the queries.
  void fill(std::span<const Vec2> points,
            std::span<const std::uint32_t> vertices,
            std::span<const std::uint32_t> ends);

  // Of contours, which it copies.
  void fill(const Contours& contours, Bundles bundles = Bundles::kShort);

  // Calls take(bundle, bundle), a bundle with itself too, for all pairs that
  // may hold an edge and a foreign vertex within `reach` [mm] in x and in y, or
  // edges that meet elsewhere than in a vertex of both. Stops and returns true
  // where take() does, and as `crowd` asks for also where so many bundles run
  // beside each other, hundreds of rings in rings, that a grid of the vertices
  // is faster.
  enum class Crowd { kStop, kVisit };
  template <typename Take>
  bool visit_near(double reach, const Take& take,
                  Crowd crowd = Crowd::kStop) const;

  std::size_t bundle_count() const { return bundles_.size(); }
  std::uint32_t index_of(const Bundle& bundle) const {
    return static_cast<std::uint32_t>(&bundle - bundles_.data());
  }
  const Bundle& bundle(std::uint32_t index) const { return bundles_[index]; }
  // The bundle of the edge that begins at vertex k, not a loop's last.
  std::uint32_t bundle_of(std::uint32_t k) const { return bundle_of_[k]; }
  bool is_empty() const { return bundles_.empty(); }

  // The ends of edge k, and the edge that follows it in its loop.
  const Vec2& from(std::size_t k) const { return points_[vertices_[k]]; }
  const Vec2& to(std::size_t k) const { return points_[vertices_[k + 1]]; }
  std::uint32_t next_of(std::uint32_t k) const {
    const std::uint32_t loop = bundles_[bundle_of_[k]].loop;
    return k + 2 < ends_[loop] ? k + 1 : loop_begin(loop);
  }
  double distance(std::size_t k, Vec2 point) const {
    return distance_to_segment(point, from(k), to(k));
  }

  // The nearest edge, or any that is no farther than `enough` [mm]. There must
  // be one.
  //
  // guess  any edge; the search is the faster the nearer it is
  std::size_t nearest(Vec2 point, std::size_t guess, double enough) const;

  // Lowers `best` [mm], the distance of some edge or a limit, to that of the
  // nearest edge, which becomes the guess; or to that of any that is no farther
  // than `enough`.
  void lower(Vec2 point, double enough, double& best, std::size_t& guess) const;

  // How often the loops go around the point together, as winding_number() of
  // each by itself.
  int winding_number(Vec2 point) const;

  // Calls take(vertex, edge) for each vertex of `vertices`, but those that
  // close a loop, and each foreign edge of `edges` within `reach` [mm] of it in
  // x and in y. Stops and returns true where take() does.
  template <typename Take>
  bool visit_meetings(const Bundle& vertices, const Bundle& edges, double reach,
                      const Take& take) const;

  // Calls is_hit(point) for all vertices within `reach` [mm] of the segment,
  // but those that close a loop, and for some beyond. Stops and returns true
  // where is_hit() does.
  template <typename IsHit>
  bool has_near(Vec2 a, Vec2 b, double reach, const IsHit& is_hit) const;

 private:
  static constexpr std::uint32_t kEdgesPerBundle = 3;
  static constexpr std::uint32_t kEdgesPerRun = 64;
  static constexpr std::uint32_t kNone = 0xffffffff;
  // Pairs of nodes to look at for each bundle in a crowd; 14 are usual.
  static constexpr std::size_t kCrowdLooks = 32;
  // Levels of as many bundles as 32 bits can count.
  static constexpr std::size_t kMostLevels = 33;

  struct Node {
    Lanes low = both_lanes(1e300);
    Lanes high = both_lanes(-1e300);
    Lanes least_step = both_lanes(1e300);  // of the edges between points
    Lanes greatest_step = both_lanes(-1e300);
    std::uint32_t loop = kNone;  // kNone where it is of several

    void add(const Node& other);
    double squared_distance(Lanes point) const {
      const Lanes gap =
          greatest(greatest(low - point, point - high), both_lanes(0));
      return gap[0] * gap[0] + gap[1] * gap[1];
    }
    bool is_near(Vec2 point, double reach) const {
      const Lanes at = lanes_of(point);
      const Lanes margin = both_lanes(reach);
      return !holds_for_any((at < low - margin) | (at > high + margin));
    }
    // Whether all edges advance by more than `reach` along an axis.
    bool advances(double reach) const {
      const Lanes least_advance = both_lanes(reach);
      return holds_for_any((least_step > least_advance) |
                           (greatest_step < -least_advance));
    }
  };

  void fill(Bundles bundles);
  void sort_loops();
  void add_bundles(std::uint32_t loop);
  void add_runs(std::uint32_t loop);
  void add_bundle(const Bundle& bundle);
  Node measure(const Bundle& bundle) const;
  void build_levels();

  std::uint32_t loop_begin(std::uint32_t loop) const {
    return loop == 0 ? 0 : ends_[loop - 1];
  }
  const Node& node(std::size_t level, std::uint32_t i) const {
    return nodes_[level_begins_[level] + i];
  }
  std::uint32_t node_count(std::size_t level) const {
    return level_begins_[level + 1] - level_begins_[level];
  }
  std::size_t top() const { return level_begins_.size() - 2; }

  static bool are_apart(const Node& a, const Node& b, double reach) {
    const Lanes margin = both_lanes(reach);
    return holds_for_any((a.low > b.high + margin) | (b.low > a.high + margin));
  }
  bool follow_apart(const Node& a, const Node& b, double reach) const;
  void follow(Vec2 point, double enough, std::size_t& edge,
              double& its_distance) const;
  void lower(const Bundle& bundle, Vec2 point, double& best,
             std::size_t& guess) const;
  int crossings_of(std::size_t level, std::uint32_t i, Vec2 point) const;

  // The state of a visit.
  template <typename Take>
  struct Visit {
    double reach;
    const Take& take;
    std::size_t looks_left;
  };
  template <typename Take>
  bool visit_within(std::size_t level, std::uint32_t i,
                    Visit<Take>& visit) const;
  template <typename Take>
  bool visit_between(std::size_t level, std::uint32_t i, std::uint32_t j,
                     Visit<Take>& visit) const;

  // A segment and all within reach of it.
  struct Strip {
    Lanes low;
    Lanes high;
    Lanes middle;
    Vec2 along;
    double reach;  // across, times the length of `along`

    bool meets(const Node& node) const;
  };
  template <typename IsHit>
  bool has_hit(std::size_t level, std::uint32_t i, const Strip& strip,
               const IsHit& is_hit) const;

  std::vector<Vec2> own_points_;  // of contours
  std::vector<std::uint32_t> own_vertices_;
  std::vector<std::uint32_t> own_ends_;
  std::span<const Vec2> points_;
  std::span<const std::uint32_t> vertices_;
  std::span<const std::uint32_t> ends_;
  std::vector<Bundle> bundles_;
  std::vector<std::uint32_t> bundle_of_;  // of each vertex
  std::vector<Node> nodes_;               // level by level, the bundles first
  std::vector<std::uint32_t> level_begins_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order_;  // of loops
};

template <typename Take>
bool EdgeTree::visit_near(double reach, const Take& take, Crowd crowd) const {
  if (bundles_.empty()) return false;
  Visit<Take> visit{reach, take,
                    crowd == Crowd::kVisit
                        ? std::numeric_limits<std::size_t>::max()
                        : kCrowdLooks * (bundles_.size() + kCrowdLooks)};
  return visit_within(top(), 0, visit);
}

template <typename Take>
bool EdgeTree::visit_within(std::size_t level, std::uint32_t i,
                            Visit<Take>& visit) const {
  if (node(level, i).advances(visit.reach)) return false;
  if (level == 0) return visit.take(bundles_[i], bundles_[i]);
  const std::uint32_t first = 2 * i;
  if (visit_within(level - 1, first, visit)) return true;
  if (first + 1 == node_count(level - 1)) return false;
  return visit_within(level - 1, first + 1, visit) ||
         visit_between(level - 1, first, first + 1, visit);
}

template <typename Take>
bool EdgeTree::visit_between(std::size_t level, std::uint32_t i,
                             std::uint32_t j, Visit<Take>& visit) const {
  if (visit.looks_left-- == 0) return true;
  const Node& a = node(level, i);
  const Node& b = node(level, j);
  if (are_apart(a, b, visit.reach)) return false;
  if (i + 1 == j && follow_apart(a, b, visit.reach)) return false;
  if (level == 0) return visit.take(bundles_[i], bundles_[j]);
  const std::uint32_t count = node_count(level - 1);
  for (std::uint32_t k = 2 * i; k < std::min(2 * i + 2, count); ++k) {
    for (std::uint32_t l = 2 * j; l < std::min(2 * j + 2, count); ++l) {
      if (visit_between(level - 1, k, l, visit)) return true;
    }
  }
  return false;
}

template <typename Take>
bool EdgeTree::visit_meetings(const Bundle& vertices, const Bundle& edges,
                              double reach, const Take& take) const {
  const Node& box = nodes_[index_of(edges)];
  const std::uint32_t last = ends_[edges.loop] - 1;
  for (std::uint32_t k = vertices.begin; k < vertices.end; ++k) {
    const Vec2& point = from(k);
    if (!box.is_near(point, reach)) continue;
    for (std::uint32_t edge = edges.begin; edge < edges.end; ++edge) {
      const std::uint32_t next =
          edge + 1 == last ? loop_begin(edges.loop) : edge + 1;
      if (k == edge || k == next) continue;
      if (meets_square(from(edge), to(edge), point, reach) && take(k, edge)) {
        return true;
      }
    }
  }
  return false;
}

template <typename IsHit>
bool EdgeTree::has_near(Vec2 a, Vec2 b, double reach,
                        const IsHit& is_hit) const {
  if (bundles_.empty()) return false;
  Strip strip;
  strip.low = least(lanes_of(a), lanes_of(b)) - both_lanes(reach);
  strip.high = greatest(lanes_of(a), lanes_of(b)) + both_lanes(reach);
  strip.middle = lanes_of(a);
  strip.along = b - a;
  strip.reach = reach * (std::abs(strip.along.x) + std::abs(strip.along.y));
  return has_hit(top(), 0, strip, is_hit);
}

template <typename IsHit>
bool EdgeTree::has_hit(std::size_t level, std::uint32_t i, const Strip& strip,
                       const IsHit& is_hit) const {
  if (!strip.meets(node(level, i))) return false;
  if (level > 0) {
    const std::uint32_t end = std::min(2 * i + 2, node_count(level - 1));
    for (std::uint32_t k = 2 * i; k < end; ++k) {
      if (has_hit(level - 1, k, strip, is_hit)) return true;
    }
    return false;
  }
  for (std::uint32_t k = bundles_[i].begin; k < bundles_[i].end; ++k) {
    if (is_hit(vertices_[k])) return true;
  }
  return false;
}

}  // namespace lamina::plane
