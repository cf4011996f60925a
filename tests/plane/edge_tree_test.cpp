#include "plane/edge_tree.h"

#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::plane {
namespace {

using Meetings = std::set<std::pair<std::uint32_t, std::uint32_t>>;

// Loops as the tree takes them, each with a copy of its first point.
struct Loops {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> ends;

  void add(const std::vector<Vec2>& loop) {
    points.insert(points.end(), loop.begin(), loop.end());
    points.push_back(loop.front());
    ends.push_back(static_cast<std::uint32_t>(points.size()));
    vertices.resize(points.size());
    std::iota(vertices.begin(), vertices.end(), 0U);
  }
};

// Loops that wander, cross and touch: nothing that a layer would hold.
Loops random_loops(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 10);
  std::uniform_real_distribution<double> step(-0.5, 0.5);
  std::uniform_int_distribution<int> count(3, 60);
  Loops loops;
  for (int l = 0; l < 1 + static_cast<int>(seed % 12); ++l) {
    std::vector<Vec2> loop{{place(random), place(random)}};
    for (int i = count(random); i > 0; --i) {
      // Runs that advance, and turns.
      const Vec2 drift(0.3 * ((i / 8) % 3 - 1), 0.2);
      loop.push_back(loop.back() + drift + Vec2(step(random), step(random)));
    }
    loops.add(loop);
  }
  return loops;
}

Meetings all_meetings(const Loops& loops, double reach) {
  Meetings meetings;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : loops.ends) {
    for (std::uint32_t edge = begin; edge + 1 < end; ++edge) {
      const std::uint32_t to = edge + 2 == end ? begin : edge + 1;
      std::uint32_t first = 0;
      for (const std::uint32_t last : loops.ends) {
        for (std::uint32_t i = first; i + 1 < last; ++i) {
          if (i != edge && i != to &&
              meets_square(loops.points[edge], loops.points[edge + 1],
                           loops.points[i], reach)) {
            meetings.insert({i, edge});
          }
        }
        first = last;
      }
    }
    begin = end;
  }
  return meetings;
}

Meetings meetings_of_tree(const Loops& loops, double reach) {
  EdgeTree tree;
  tree.fill(loops.points, loops.vertices, loops.ends);
  Meetings meetings;
  const auto take = [&](std::uint32_t vertex, std::uint32_t edge) {
    EXPECT_TRUE(meetings.insert({vertex, edge}).second) << "reported twice";
    return false;
  };
  tree.visit_near(reach * 1.001, [&](const auto& a, const auto& b) {
    tree.visit_meetings(a, b, reach, take);
    if (&a != &b) tree.visit_meetings(b, a, reach, take);
    return false;
  });
  return meetings;
}

TEST(EdgeTree, FindsEveryVertexNearAForeignEdgeOnce) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Loops loops = random_loops(seed);
    for (const double reach : {1e-6, 0.01, 0.3}) {
      EXPECT_EQ(meetings_of_tree(loops, reach), all_meetings(loops, reach))
          << "seed " << seed << ", reach " << reach;
    }
  }
}

TEST(EdgeTree, FindsEveryVertexNearASegment) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Loops loops = random_loops(seed);
    EdgeTree tree;
    tree.fill(loops.points, loops.vertices, loops.ends);
    const Vec2 a = loops.points[seed % loops.points.size()];
    const Vec2 b = loops.points[7 * seed % loops.points.size()];
    const double reach = 0.1;
    std::set<std::uint32_t> found;
    tree.has_near(a, b, reach, [&](std::uint32_t i) {
      found.insert(i);
      return false;
    });
    for (const std::uint32_t i : loops.vertices) {
      // Near in x and y is less than near in length.
      if (!meets_square(a, b, loops.points[i], reach / 2)) continue;
      const bool closes = std::find(loops.ends.begin(), loops.ends.end(),
                                    i + 1) != loops.ends.end();
      EXPECT_TRUE(closes || found.count(i) == 1) << "seed " << seed;
    }
  }
}

// A circle is told apart from itself without a look at its edges, but for the
// few stretches that turn back along both axes and the seam.
TEST(EdgeTree, HandsOnLittleOfASmoothLoop) {
  Loops loops;
  std::vector<Vec2> circle;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 6.283185307179586 * i / 1000;
    circle.push_back({std::cos(angle), std::sin(angle)});
  }
  loops.add(circle);
  EdgeTree tree;
  tree.fill(loops.points, loops.vertices, loops.ends);
  int visits = 0;
  tree.visit_near(1e-6, [&](const auto&, const auto&) {
    ++visits;
    return false;
  });
  EXPECT_LE(visits, 5);
}

TEST(EdgeTree, GivesUpOnHundredsOfRingsInRings) {
  Loops loops;
  for (int ring = 1; ring <= 300; ++ring) {
    std::vector<Vec2> circle;
    for (int i = 0; i < 40; ++i) {
      const double angle = 0.15707963267948966 * i;
      circle.push_back(Vec2(std::cos(angle), std::sin(angle)) * (0.05 * ring));
    }
    loops.add(circle);
  }
  EdgeTree tree;
  tree.fill(loops.points, loops.vertices, loops.ends);
  EXPECT_TRUE(
      tree.visit_near(1e-6, [](const auto&, const auto&) { return false; }));
}

}  // namespace
}  // namespace lamina::plane
