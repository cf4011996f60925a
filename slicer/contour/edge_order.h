#pragma once
// Which edges of a layer lie below a place, by a segment tree over x (Bentley
// 1977).
//
// The ends of the edges part the x axis into intervals; a node of the tree
// stands for some neighbouring ones, and an edge is listed in the few nodes
// that together are the stretch of x that it reaches over. All edges of a node
// reach over all of it without crossing, so they have an order, from below; a
// search in the nodes above one interval finds what lies below a place there.
// All comparisons are exact: edges may touch.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::slicer {

class EdgeOrder {
 public:
  struct Edge {
    Vec2 left;
    Vec2 right;
    std::uint32_t loop = 0;
    int winding = 0;  // +1 where the edge runs to the right; added above it
  };
  struct Below {
    const Edge* nearest = nullptr;  // null: nothing lies below
    int winding = 0;                // of all edges below together
  };

  // Takes an edge that is not upright.
  void add(Vec2 from, Vec2 to, std::uint32_t loop);
  // Makes the order, once all edges are there; they do not cross.
  void build();

  std::span<const Edge> edges() const { return edges_; }
  // What lies below the point: not through it, and to the right of it where
  // something begins or ends at its x.
  Below below(Vec2 point) const;
  // What lies below the edge, at its left end.
  Below below(const Edge& edge) const;

  // Whether `a` lies below `b` where both reach.
  static bool is_below(const Edge& a, const Edge& b);

 private:
  struct Entry {
    std::uint32_t node = 0;
    std::uint32_t edge = 0;
    int winding = 0;  // of the edges of this node up to here
  };

  std::size_t interval_of(double x) const;
  // Calls visit(node) for the nodes that are the edge's stretch of x.
  template <typename Visit>
  void visit_nodes(const Edge& edge, const Visit& visit) const;
  template <typename IsAbove>
  Below find(double x, const IsAbove& is_above) const;

  std::vector<Edge> edges_;
  std::vector<double> ends_;  // x of all ends, ascending
  // Node i has the children 2 i and 2 i + 1; the last half are the intervals.
  std::vector<std::size_t> starts_;  // of each node, in entries_
  std::vector<Entry> entries_;       // node by node, from below
};

}  // namespace lamina::slicer
