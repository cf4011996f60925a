// What lies below a place: by the order, and by a look at all edges.

#include "slicer/contour/edge_order.h"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

using Edge = EdgeOrder::Edge;

// Edges that do not cross: triangles, each in a cell of its own, in which they
// end at one x here and there and touch the cells beside theirs.
EdgeOrder make_order(std::mt19937& random, int side) {
  EdgeOrder order;
  std::uniform_int_distribution<int> step(0, 4);
  std::uint32_t loop = 0;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      std::vector<Vec2> corners(3);
      for (Vec2& corner : corners) {
        corner = Vec2(x, y) + 0.25 * Vec2(step(random), step(random));
      }
      if (orientation(corners[0], corners[1], corners[2]) == 0) continue;
      // Edges along a side of the cell could lie on those of another.
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 from = corners[k];
        const Vec2 to = corners[(k + 1) % 3];
        if (from.x != to.x && from.y != to.y) order.add(from, to, loop);
      }
      ++loop;
    }
  }
  order.build();
  return order;
}

TEST(EdgeOrder, KnowsWhatLiesBelowPointsAndEdges) {
  std::mt19937 random(1);
  for (int side = 1; side < 12; ++side) {
    const EdgeOrder order = make_order(random, side);
    std::uniform_int_distribution<int> place(-2, 8 * side + 2);
    for (int i = 0; i < 500; ++i) {
      const Vec2 point = 0.125 * Vec2(place(random), place(random));
      const EdgeOrder::Below below = order.below(point);
      int winding = 0;
      const Edge* nearest = nullptr;
      for (const Edge& edge : order.edges()) {
        if (edge.left.x > point.x || edge.right.x <= point.x) continue;
        if (orientation(edge.left, edge.right, point) <= 0) continue;
        winding += edge.winding;
        if (nearest == nullptr || EdgeOrder::is_below(*nearest, edge)) {
          nearest = &edge;
        }
      }
      EXPECT_EQ(below.winding, winding);
      EXPECT_EQ(below.nearest, nearest);
    }
    for (const Edge& edge : order.edges()) {
      int winding = 0;
      for (const Edge& other : order.edges()) {
        if (other.left.x <= edge.left.x && edge.left.x < other.right.x &&
            EdgeOrder::is_below(other, edge)) {
          winding += other.winding;
        }
      }
      EXPECT_EQ(order.below(edge).winding, winding);
    }
  }
}

TEST(EdgeOrder, NothingLiesBelowNothing) {
  EdgeOrder order;
  order.build();
  EXPECT_EQ(order.below(Vec2(1, 2)).nearest, nullptr);
}

}  // namespace
}  // namespace lamina::slicer
