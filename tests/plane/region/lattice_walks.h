#pragma once
// Polygons that touch themselves and each other in as many points as they can:
// random walks on a small lattice, along its rows, columns and diagonals. All
// crossings are lattice points then.

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "plane/region/region.h"

namespace lamina::plane {

inline constexpr int kLatticeSize = 8;  // even, as are the corners

class LatticeWalker {
 public:
  explicit LatticeWalker(unsigned seed) : random_(seed) {}

  Contour closed_walk(int steps) {
    Contour walk{{even(), even()}};
    for (int i = 0; i < steps; ++i) walk.push_back(step_from(walk.back()));
    // Home along a row and a column.
    walk.emplace_back(walk.front().x, walk.back().y);
    return walk;
  }

 private:
  int pick(int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random_);
  }
  double even() { return 2 * pick(kLatticeSize / 2 + 1); }

  Vec2 step_from(Vec2 p) {
    static constexpr std::pair<int, int> kSteps[] = {
        {2, 0}, {2, 2}, {0, 2}, {-2, 2}, {-2, 0}, {-2, -2}, {0, -2}, {2, -2}};
    const auto [dx, dy] = kSteps[pick(8)];
    for (int left = 1 + pick(kLatticeSize / 2); left > 0; --left) {
      const Vec2 next = p + Vec2(dx, dy);
      const bool is_within = std::min(next.x, next.y) >= 0 &&
                             std::max(next.x, next.y) <= kLatticeSize;
      if (!is_within) break;
      p = next;
    }
    return p;
  }

  std::mt19937 random_;
};

inline std::vector<Contour> lattice_walks(unsigned seed) {
  LatticeWalker walker(seed);
  std::vector<Contour> contours;
  for (int i = 0; i < 3; ++i) contours.push_back(walker.closed_walk(12));
  return contours;
}

}  // namespace lamina::plane
