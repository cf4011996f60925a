#include "tests/slicer/check/print/cell_layers.h"

#include <cmath>
#include <utility>

namespace lamina::slicer {

CellLayer CellLayer::any(std::mt19937& random, unsigned percent) {
  CellLayer layer;
  for (int y = 1; y + 1 < kSize; ++y) {
    for (int x = 1; x + 1 < kSize; ++x) {
      layer.set(x, y, random() % 100 < percent);
    }
  }
  layer.mend_corners();
  return layer;
}

CellLayer CellLayer::changed(std::mt19937& random, int cells) const {
  CellLayer layer = *this;
  const auto number = [&] {
    return 1 + static_cast<int>(random() % (kSize - 2));
  };
  for (int i = 0; i < cells; ++i) {
    const int x = number();
    const int y = number();
    layer.set(x, y, !layer.is_solid(x, y));
  }
  layer.mend_corners();
  return layer;
}

// Fills one of the cells beside a corner in which two solid ones touch.
void CellLayer::mend_corners() {
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (int y = 0; y + 1 < kSize; ++y) {
      for (int x = 0; x + 1 < kSize; ++x) {
        if (is_solid(x, y) != is_solid(x + 1, y + 1) ||
            is_solid(x + 1, y) != is_solid(x, y + 1) ||
            is_solid(x, y) == is_solid(x + 1, y)) {
          continue;
        }
        set(is_solid(x, y) ? x + 1 : x, y, true);
        is_changed = true;
      }
    }
  }
}

// Each from its first edge, with the solid on the left.
std::vector<std::vector<CellLayer::Corner>> CellLayer::loops() const {
  // By corner, the direction in which a boundary leaves it.
  constexpr int kCorners = kSize + 1;
  std::vector<int> leaves(static_cast<std::size_t>(kCorners * kCorners), -1);
  const auto leave = [&](int x, int y) -> int& {
    return leaves[static_cast<std::size_t>(y * kCorners + x)];
  };
  for (int y = 1; y + 1 < kSize; ++y) {
    for (int x = 1; x + 1 < kSize; ++x) {
      if (!is_solid(x, y)) continue;
      if (!is_solid(x, y - 1)) leave(x, y) = 0;
      if (!is_solid(x + 1, y)) leave(x + 1, y) = 1;
      if (!is_solid(x, y + 1)) leave(x + 1, y + 1) = 2;
      if (!is_solid(x - 1, y)) leave(x, y + 1) = 3;
    }
  }
  std::vector<std::vector<Corner>> loops;
  for (int y = 0; y < kCorners; ++y) {
    for (int x = 0; x < kCorners; ++x) {
      if (leave(x, y) < 0) continue;
      std::vector<Corner>& loop = loops.emplace_back();
      for (Corner at = {x, y}; leave(at.x, at.y) >= 0;) {
        loop.push_back(at);
        const int direction = std::exchange(leave(at.x, at.y), -1);
        at.x += direction == 0 ? 1 : direction == 2 ? -1 : 0;
        at.y += direction == 1 ? 1 : direction == 3 ? -1 : 0;
      }
    }
  }
  return loops;
}

plane::Contours CellLayer::contours(double width, double angle) const {
  const Vec2 along = width * Vec2(std::cos(angle), std::sin(angle));
  plane::Contours contours;
  for (const std::vector<Corner>& loop : loops()) {
    for (const Corner& corner : loop) {
      contours.points.push_back(double(corner.x) * along +
                                double(corner.y) * Vec2(-along.y, along.x));
    }
    contours.ends.push_back(static_cast<std::uint32_t>(contours.points.size()));
  }
  return contours;
}

std::vector<std::uint32_t> CellLayer::regions() const {
  constexpr std::uint32_t kNone = 0xfffffff0;
  std::vector<std::uint32_t> regions(cells_.size(), kNone);
  const auto flood = [&](int first_x, int first_y, std::uint32_t region) {
    std::vector<Corner> open = {{first_x, first_y}};
    const bool solid = is_solid(first_x, first_y);
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      if (x < 0 || y < 0 || x >= kSize || y >= kSize) continue;
      std::uint32_t& cell = regions[static_cast<std::size_t>(y * kSize + x)];
      if (cell != kNone || is_solid(x, y) != solid) continue;
      cell = region;
      open.insert(open.end(), {{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}});
    }
  };
  flood(0, 0, kOutside);
  // The first corner of a loop is its lowest one on the left: the cell beyond
  // it is solid if that is an outer loop, else the first void cell.
  const auto all = loops();
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const auto [x, y] = all[i].front();
    flood(x, y, i);
  }
  return regions;
}

std::vector<std::uint32_t> CellLayer::around() const {
  const std::vector<std::uint32_t> all = regions();
  std::vector<std::uint32_t> around;
  for (const std::vector<Corner>& loop : loops()) {
    const auto [x, y] = loop.front();
    around.push_back(all[static_cast<std::size_t>((y - 1) * kSize + x)]);
  }
  return around;
}

}  // namespace lamina::slicer
