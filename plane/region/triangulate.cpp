// Ear clipping with bridges to the holes.
//
// The contours become one ring by walking from every hole to a visible vertex
// and back; then a walk around it cuts off convex corners without a vertex
// inside. Corners that could lie inside are looked for by place. The walk
// leaves out a corner that it found no ear until a neighbour is cut, or the
// vertex inside is no longer in the way: most corners are tested a few times,
// however many walks it takes. Quadratic at worst; of a ring that crosses
// itself corners are cut untested once that has taken long. What matters more:
// whatever the ring looks like, n - 2 triangles leave it with every edge
// matched, so a rounding error can misplace a triangle but never open a
// surface. Source: Meisters 1975 (ears), Eberly 2002 (bridges to holes).

#include "plane/region/triangulate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>

#include <glm/common.hpp>

#include "plane/loop_area.h"
#include "plane/point_grid.h"
#include "plane/predicates.h"

namespace lamina::plane {
namespace {

// A corner of the ring; a point that ends a bridge is there twice.
struct RingCorner {
  Vec2 point;
  std::uint32_t vertex = 0;  // of the region
  std::uint32_t previous = 0;
  std::uint32_t next = 0;
};

// Closed: the border counts as inside.
bool is_in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
         orientation(c, a, p) >= 0;
}

class EarClipper {
 public:
  explicit EarClipper(std::vector<std::array<std::uint32_t, 3>>& triangles)
      : triangles_(triangles) {}

  // Appends a contour as a ring of its own; returns its first corner.
  std::uint32_t add_ring(const Contour& contour, std::uint32_t first_vertex) {
    const auto begin = static_cast<std::uint32_t>(corners_.size());
    const auto count = static_cast<std::uint32_t>(contour.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      corners_.push_back({contour[i], first_vertex + i,
                          begin + (i + count - 1) % count,
                          begin + (i + 1) % count});
    }
    return begin;
  }

  // Joins the ring of a hole to the ring of `outer` by a bridge.
  void add_bridge(std::uint32_t outer, std::uint32_t hole) {
    const std::uint32_t from = rightmost(hole);
    const std::uint32_t to = choose_duplicate(
        outer, find_visible(outer, corners_[from].point), from);
    const std::uint32_t from_twin = add_twin(from);
    const std::uint32_t to_twin = add_twin(to);
    // … to → from … (around the hole) … from_twin → to_twin …
    const std::uint32_t last = corners_[from].previous;
    const std::uint32_t after = corners_[to].next;
    link(last, from_twin);
    link(from_twin, to_twin);
    link(to_twin, after);
    link(to, from);
  }

  void clip(std::uint32_t start) {
    begin_walk(start);
    std::size_t left = ring_.size();
    // A ring that crosses itself has few ears, and to look for each round the
    // whole ring would take the cube of its corners.
    constexpr std::size_t kTestsOfACorner = 16;
    std::size_t tests_left = kTestsOfACorner * left;
    bool was_stuck = false;
    while (left > 3 && tests_left > 0) {
      if (const auto corner = next_to_test()) {
        if (is_spike(*corner) || is_ear(*corner)) {
          cut(*corner);
          --left;
        } else if (was_stuck) {
          --tests_left;
        }
        continue;
      }
      was_stuck = true;
      tests_left -= std::min(tests_left, left);
      if (cut_flat_corners(left)) continue;
      cut(find_convex(corner_));
      --left;
    }
    for (; left > 2; --left) cut(corner_);
  }

 private:
  void link(std::uint32_t a, std::uint32_t b) {
    corners_[a].next = b;
    corners_[b].previous = a;
  }

  std::uint32_t add_twin(std::uint32_t corner) {
    corners_.push_back(corners_[corner]);
    return static_cast<std::uint32_t>(corners_.size() - 1);
  }

  std::uint32_t rightmost(std::uint32_t ring) const {
    std::uint32_t best = ring;
    for (auto c = corners_[ring].next; c != ring; c = corners_[c].next) {
      if (corners_[c].point.x > corners_[best].point.x) best = c;
    }
    return best;
  }

  // A corner of the ring `outer` that sees `p`, which lies inside of it: the
  // right end of the first edge that a ray towards +x meets, or the corner
  // closest in angle to the ray among those that stand between.
  std::uint32_t find_visible(std::uint32_t outer, Vec2 p) const {
    double least_x = std::numeric_limits<double>::infinity();
    std::uint32_t best = outer;
    for (std::uint32_t c = outer;;) {
      const std::uint32_t n = corners_[c].next;
      const Vec2 a = corners_[c].point;
      const Vec2 b = corners_[n].point;
      // The solid is left of its edges: only rising edges face the ray.
      if (a.y <= p.y && p.y <= b.y && is_right_of(p, a, b)) {
        const double x = std::max(p.x, x_at(p.y, a, b));
        if (x < least_x) {
          least_x = x;
          best = a.y == p.y ? c : b.y == p.y ? n : a.x > b.x ? c : n;
        }
      }
      c = n;
      if (c == outer) break;
    }
    return closest_between(outer, p, {least_x, p.y}, best);
  }

  // Whether the edge, which does not fall, is met by the ray from p.
  static bool is_right_of(Vec2 p, Vec2 a, Vec2 b) {
    return a.y < b.y ? orientation(a, b, p) >= 0 : std::min(a.x, b.x) >= p.x;
  }

  static double x_at(double y, Vec2 a, Vec2 b) {
    if (a.y == b.y) return std::min(a.x, b.x);
    if (y == b.y) return b.x;
    return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
  }

  std::uint32_t closest_between(std::uint32_t outer, Vec2 p, Vec2 hit,
                                std::uint32_t best) const {
    const Vec2 q = corners_[best].point;
    if (q.y == p.y) return best;
    const bool is_above = q.y > p.y;
    double least_slope = std::abs(q.y - p.y) / (q.x - p.x);
    double least_dx = q.x - p.x;
    for (auto c = corners_[outer].next;; c = corners_[c].next) {
      const Vec2 r = corners_[c].point;
      const bool is_between = is_above ? is_in_triangle(r, p, hit, q)
                                       : is_in_triangle(r, p, q, hit);
      if (c != best && r.x > p.x && is_between) {
        const double slope = std::abs(r.y - p.y) / (r.x - p.x);
        const bool is_closer = slope < least_slope ||
                               (slope == least_slope && r.x - p.x < least_dx);
        if (is_closer && sees_inside(c, p)) {
          least_slope = slope;
          least_dx = r.x - p.x;
          best = c;
        }
      }
      if (c == outer) break;
    }
    return best;
  }

  // Chooses among the corners at one place, where contours touch or an earlier
  // bridge ends, the one whose angle holds the bridge.
  std::uint32_t choose_duplicate(std::uint32_t outer, std::uint32_t best,
                                 std::uint32_t from) const {
    const Vec2 q = corners_[best].point;
    const RingCorner& tip = corners_[from];
    const bool is_touching = tip.point == q;
    for (std::uint32_t c = outer;;) {
      if (corners_[c].point == q) {
        const bool holds = is_touching
                               ? sees_inside(c, corners_[tip.previous].point) &&
                                     sees_inside(c, corners_[tip.next].point)
                               : sees_inside(c, tip.point);
        if (holds) return c;
      }
      c = corners_[c].next;
      if (c == outer) return best;
    }
  }

  // True where the direction to p lies inside the corner's angle.
  bool sees_inside(std::uint32_t corner, Vec2 p) const {
    const RingCorner& c = corners_[corner];
    const Vec2 before = corners_[c.previous].point;
    const Vec2 after = corners_[c.next].point;
    const bool left_of_in = orientation(before, c.point, p) >= 0;
    const bool left_of_out = orientation(c.point, after, p) >= 0;
    return is_reflex(corner) ? left_of_in || left_of_out
                             : left_of_in && left_of_out;
  }

  bool is_reflex(std::uint32_t corner) const {
    const RingCorner& c = corners_[corner];
    return orientation(corners_[c.previous].point, c.point,
                       corners_[c.next].point) < 0;
  }

  bool is_flat(std::uint32_t corner) const {
    const RingCorner& c = corners_[corner];
    return orientation(corners_[c.previous].point, c.point,
                       corners_[c.next].point) == 0;
  }

  void begin_walk(std::uint32_t start) {
    is_gone_.assign(corners_.size(), false);
    is_in_grid_.assign(corners_.size(), false);
    due_.assign(corners_.size(), kNever);
    place_.resize(corners_.size());
    behind_.resize(corners_.size());
    behind_at_tip_.resize(corners_.size());
    for (const RingCorner& corner : corners_) points_.push_back(corner.point);
    corner_ = start;
    std::uint32_t c = start;
    do {
      place_[c] = ring_.size();
      ring_.push_back(c);
      if (is_reflex(c)) {
        reflex_.push_back(c);
        is_in_grid_[c] = true;
      }
      c = corners_[c].next;
    } while (c != start);
    for (const std::uint32_t corner : ring_) plan_test(corner);
    reflex_count_ = reflex_.size();
    grid_.fill(points_, reflex_);
  }

  // The first step of the walk, from now on, that comes to the corner.
  std::uint64_t next_step_at(std::uint32_t corner) const {
    const std::size_t size = ring_.size();
    return step_ + (place_[corner] + size - step_ % size) % size;
  }

  void plan_test(std::uint32_t corner) {
    const std::uint64_t step = next_step_at(corner);
    if (is_gone_[corner] || due_[corner] == step) return;
    due_[corner] = step;
    steps_.push(step);
  }

  void plan_tests(std::vector<std::uint32_t>& corners) {
    for (const std::uint32_t corner : corners) plan_test(corner);
    corners.clear();
  }

  // Walks on to the next corner that may have become an ear, if there is one.
  std::optional<std::uint32_t> next_to_test() {
    while (!steps_.empty()) {
      const std::uint64_t step = steps_.top();
      steps_.pop();
      const std::uint32_t corner = ring_[step % ring_.size()];
      if (is_gone_[corner] || due_[corner] != step) continue;
      due_[corner] = kNever;
      step_ = step;
      return corner;
    }
    return std::nullopt;
  }

  // The ring runs back on itself here, as at bridges whose hole is gone.
  bool is_spike(std::uint32_t corner) const {
    const RingCorner& c = corners_[corner];
    const Vec2 a = corners_[c.previous].point;
    const Vec2 b = corners_[c.next].point;
    if (a == c.point || b == c.point) return true;
    return orientation(a, c.point, b) == 0 && dot(a - c.point, b - c.point) > 0;
  }

  // Only reflex corners can lie inside another corner's triangle first; a
  // corner that was convex stays so. One that is not an ear is kept behind the
  // corner that is in its way.
  bool is_ear(std::uint32_t corner) {
    const RingCorner& c = corners_[corner];
    const Vec2 a = corners_[c.previous].point;
    const Vec2 b = corners_[c.next].point;
    if (orientation(a, c.point, b) <= 0) return false;
    const Vec2 low = glm::min(glm::min(a, b), c.point);
    const Vec2 high = glm::max(glm::max(a, b), c.point);
    const auto is_in_the_way = [&](std::uint32_t r) {
      const Vec2 p = corners_[r].point;
      if (p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y ||
          !is_in_grid_[r] || r == corner) {
        return false;
      }
      if (p == c.point) {
        if (!opens_within(r, a, c.point, b)) return false;
        behind_at_tip_[r].push_back(corner);
        return true;
      }
      if (p == a || p == b || !is_in_triangle(p, a, c.point, b)) return false;
      behind_[r].push_back(corner);
      return true;
    };
    // All that is in the box is within half its height of its middle line, but
    // for rounding.
    const double middle = (low.y + high.y) / 2;
    const double reach = std::max(high.y - middle, middle - low.y);
    return !grid_.has_near({low.x, middle}, {high.x, middle}, reach,
                           is_in_the_way);
  }

  // True where the outside at a reflex corner, which lies at the tip of the
  // angle a, tip, b, reaches into that angle.
  bool opens_within(std::uint32_t reflex, Vec2 a, Vec2 tip, Vec2 b) const {
    const Vec2 before = corners_[corners_[reflex].previous].point;
    const Vec2 after = corners_[corners_[reflex].next].point;
    return is_in_angle(before, a, tip, b) || is_in_angle(after, a, tip, b) ||
           is_in_angle((a + b) / 2.0, after, tip, before);
  }

  // The corner a, tip, b is convex.
  static bool is_in_angle(Vec2 p, Vec2 a, Vec2 tip, Vec2 b) {
    return orientation(a, tip, p) > 0 && orientation(tip, b, p) > 0;
  }

  // Cuts off all corners that are flat, which costs no area, in one walk around
  // the ring but down to a triangle. Returns whether there was one.
  //
  // left  of the ring
  bool cut_flat_corners(std::size_t& left) {
    const std::size_t before = left;
    std::uint32_t corner = corner_;
    for (std::size_t i = 0; i < before && left > 3; ++i) {
      const std::uint32_t next = corners_[corner].next;
      if (is_flat(corner)) {
        cut(corner);
        --left;
      }
      corner = next;
    }
    return left < before;
  }

  // The first one; `start` where none is.
  std::uint32_t find_convex(std::uint32_t start) const {
    std::uint32_t c = start;
    do {
      if (!is_flat(c) && !is_reflex(c)) return c;
      c = corners_[c].next;
    } while (c != start);
    return start;
  }

  // Cuts the corner off and walks past its neighbour.
  void cut(std::uint32_t corner) {
    const RingCorner c = corners_[corner];
    triangles_.push_back(
        {corners_[c.previous].vertex, c.vertex, corners_[c.next].vertex});
    is_gone_[corner] = true;
    link(c.previous, c.next);
    step_ = next_step_at(c.next) + 1;
    corner_ = corners_[c.next].next;
    plan_test(c.previous);
    plan_test(c.next);
    for (const std::uint32_t changed : {corner, c.previous, c.next}) {
      if (is_in_grid_[changed]) note_change(changed);
    }
  }

  // Lets those behind a corner of the grid be tested again where it may no
  // longer be in their way.
  void note_change(std::uint32_t reflex) {
    plan_tests(behind_at_tip_[reflex]);
    if (!is_gone_[reflex] && is_reflex(reflex)) return;
    plan_tests(behind_[reflex]);
    is_in_grid_[reflex] = false;
    --reflex_count_;
    // A grid of corners that are no longer in it is soon slow.
    if (2 * reflex_count_ > reflex_.size()) return;
    std::erase_if(reflex_, [&](std::uint32_t r) { return !is_in_grid_[r]; });
    grid_.fill(points_, reflex_);
  }

  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  std::vector<RingCorner> corners_;
  std::vector<Vec2> points_;  // of the corners
  std::vector<bool> is_gone_;
  std::vector<std::array<std::uint32_t, 3>>& triangles_;

  // The walk: each step goes on by one place of the ring as it first was.
  std::vector<std::uint32_t> ring_;
  std::vector<std::size_t> place_;  // in the ring
  std::uint64_t step_ = 0;
  std::uint32_t corner_ = 0;  // the first that is left from the last cut on
  std::vector<std::uint64_t> due_;  // when the corner shall be tested
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>,
                      std::greater<>>
      steps_;  // that test a corner; some are no longer due

  // Corners that have been reflex since clipping began.
  PointGrid grid_;
  std::vector<std::uint32_t> reflex_;  // in the grid, some no longer reflex
  std::vector<bool> is_in_grid_;
  std::size_t reflex_count_ = 0;
  // By such a corner: those in whose triangle it lay when they were tested,
  // within it or at its tip.
  std::vector<std::vector<std::uint32_t>> behind_;
  std::vector<std::vector<std::uint32_t>> behind_at_tip_;
};

// The middle of an edge: unlike a vertex it does not lie on a contour that
// only touches this one.
Vec2 typical_point(const Contour& contour) {
  return (contour[0] + contour[1]) / 2.0;
}

// Which outer contour each hole belongs to: the smallest around it. Outer
// contours (and stray holes) name themselves.
std::vector<std::size_t> find_owners(const Region& region) {
  const auto& contours = region.contours;
  std::vector<double> areas;
  areas.reserve(contours.size());
  for (const Contour& contour : contours) {
    areas.push_back(sliver_area(contour));
  }
  std::vector<std::size_t> owners(contours.size());
  std::iota(owners.begin(), owners.end(), std::size_t{0});
  for (std::size_t hole = 0; hole < contours.size(); ++hole) {
    if (areas[hole] >= 0) continue;
    const Vec2 p = typical_point(contours[hole]);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t outer = 0; outer < contours.size(); ++outer) {
      if (areas[outer] > 0 && areas[outer] < least &&
          winding_number(contours[outer], p) != 0) {
        least = areas[outer];
        owners[hole] = outer;
      }
    }
  }
  return owners;
}

double greatest_x(const Contour& contour) {
  double x = contour[0].x;
  for (const Vec2 point : contour) x = std::max(x, point.x);
  return x;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const Region& region) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const std::vector<std::size_t> owners = find_owners(region);
  std::vector<std::uint32_t> first_vertex{0};
  for (const Contour& contour : region.contours) {
    first_vertex.push_back(first_vertex.back() +
                           static_cast<std::uint32_t>(contour.size()));
  }

  for (std::size_t outer = 0; outer < region.contours.size(); ++outer) {
    if (owners[outer] != outer) continue;
    EarClipper clipper(triangles);
    const std::uint32_t ring =
        clipper.add_ring(region.contours[outer], first_vertex[outer]);

    // Bridge the rightmost hole first: nothing lies between it and the ring.
    std::vector<std::size_t> holes;
    for (std::size_t i = 0; i < owners.size(); ++i) {
      if (owners[i] == outer && i != outer) holes.push_back(i);
    }
    std::sort(holes.begin(), holes.end(), [&](std::size_t a, std::size_t b) {
      return greatest_x(region.contours[a]) > greatest_x(region.contours[b]);
    });
    for (const std::size_t hole : holes) {
      clipper.add_bridge(
          ring, clipper.add_ring(region.contours[hole], first_vertex[hole]));
    }
    clipper.clip(ring);
  }
  return triangles;
}

}  // namespace lamina::plane
