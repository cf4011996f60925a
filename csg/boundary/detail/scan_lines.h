#pragma once
// Areas of a plane Boolean by scan lines.
//
// An area needs no contours. Lines of constant v cross the edges of all
// operands; on a line the Boolean is counting, as on the moving ray, and gives
// lengths. Between two breakpoints, which are ends of edges and places where
// two cross, a length changes linearly, so that the one in the middle times the
// distance of the breakpoints is the area exactly. Nothing depends on how
// crossings are ordered that rounding makes one: between them there is no area.
// Where breakpoints are more than the caller pays for, a few lines are evenly
// spaced and the area is an estimate.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

class ScanLines {
 public:
  struct Edge {
    Vec2 begin;
    Vec2 end;
    std::uint32_t tag;  // whatever the caller wants to know of it

    // The point of the edge that is at this height, or nearest to it.
    Vec2 at(double v) const {
      const double share = (v - begin.y) / (end.y - begin.y);
      return begin + std::clamp(share, 0.0, 1.0) * (end - begin);
    }
    // Of a winding number where a point passes the edge in the direction +u.
    int step() const { return end.y > begin.y ? -1 : 1; }
  };
  struct Crossing {
    double u;
    const Edge* edge;
  };

  // Forgets all edges.
  void clear() {
    edges_.clear();
    level_.clear();
  }

  void add(Vec2 begin, Vec2 end, std::uint32_t tag) {
    if (begin.y == end.y) {
      level_.push_back(begin.y);
    } else {
      edges_.push_back({begin, end, tag});
    }
  }

  std::size_t size() const { return edges_.size(); }

  // Calls visit(from, to, crossings) for slabs from `low` to `high` in
  // ascending order, with the crossings of the line in its middle, ascending.
  // Returns whether they end at all breakpoints, which they do where these are
  // at most `most`.
  template <typename Visit>
  bool visit(double low, double high, std::size_t most, const Visit& visit) {
    const bool is_exact = find_slabs(low, high, most);
    begin();
    for (std::size_t i = 1; i < borders_.size(); ++i) {
      if (borders_[i] - borders_[i - 1] <= kLeastSlab) continue;
      const double middle = 0.5 * (borders_[i - 1] + borders_[i]);
      visit(borders_[i - 1], borders_[i], cross(middle));
    }
    return is_exact;
  }

 private:
  // A slab that is less high has no area [mm].
  static constexpr double kLeastSlab = 1e-9;

  bool find_slabs(double low, double high, std::size_t most);
  void add_crossings();
  void sort_edges();
  void begin();
  // The crossings of a line above all of those before.
  std::span<const Crossing> cross(double v);

  std::vector<Edge> edges_;
  std::vector<double> level_;          // v of edges that no line crosses
  std::vector<double> borders_;        // of slabs
  std::vector<std::uint32_t> order_;   // edges by their lower ends
  std::size_t next_ = 0;               // in order_
  std::vector<std::uint32_t> active_;  // edges that lines come to
  std::vector<Crossing> crossings_;
};

}  // namespace lamina::csg
