#include "slicer/check/print/layer_graph.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slicer/check/print/cell_layers.h"

namespace lamina::slicer {
namespace {

using Stack = std::vector<CellLayer>;

// The cells of a stack that hang together, by a flood from each.
class CellBodies {
 public:
  explicit CellBodies(const Stack& stack) : stack_(stack) {
    seen_.resize(stack.size() * CellLayer::kSize * CellLayer::kSize);
  }

  // Calls take(first layer, last layer, reaches the rim) for each body of solid
  // or of void.
  template <typename Take>
  void visit(bool is_solid, const Take& take) {
    std::fill(seen_.begin(), seen_.end(), false);
    const int height = static_cast<int>(stack_.size());
    for (int z = 0; z < height; ++z) {
      for (int y = 0; y < CellLayer::kSize; ++y) {
        for (int x = 0; x < CellLayer::kSize; ++x) {
          flood({x, y, z}, is_solid, take);
        }
      }
    }
  }

 private:
  struct Cell {
    int x;
    int y;
    int z;
  };

  bool is_open(const Cell& cell, bool is_solid) const {
    const auto is_in = [](int number, int size) {
      return number >= 0 && number < size;
    };
    return is_in(cell.x, CellLayer::kSize) && is_in(cell.y, CellLayer::kSize) &&
           is_in(cell.z, static_cast<int>(stack_.size())) &&
           !seen_[index(cell)] &&
           stack_[static_cast<std::size_t>(cell.z)].is_solid(cell.x, cell.y) ==
               is_solid;
  }
  static std::size_t index(const Cell& cell) {
    return static_cast<std::size_t>(
        (cell.z * CellLayer::kSize + cell.y) * CellLayer::kSize + cell.x);
  }

  template <typename Take>
  void flood(const Cell& from, bool is_solid, const Take& take) {
    if (!is_open(from, is_solid)) return;
    int last = from.z;
    bool reaches_rim = false;
    std::vector<Cell> open = {from};
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      if (!is_open(cell, is_solid)) continue;
      seen_[index(cell)] = true;
      last = std::max(last, cell.z);
      reaches_rim |= cell.x == 0 && cell.y == 0;
      const auto [x, y, z] = cell;
      open.insert(open.end(), {{x + 1, y, z},
                               {x - 1, y, z},
                               {x, y + 1, z},
                               {x, y - 1, z},
                               {x, y, z + 1},
                               {x, y, z - 1}});
    }
    take(from.z, last, reaches_rim);
  }

  const Stack& stack_;
  std::vector<bool> seen_;
};

std::size_t count(const PrintCheck& check, FindingKind kind) {
  return static_cast<std::size_t>(
      std::ranges::count(check.findings, kind, &Finding::kind));
}

// Solid regions that no solid cell is below.
std::size_t count_islands(const Stack& stack) {
  std::size_t islands = 0;
  for (std::size_t z = 1; z < stack.size(); ++z) {
    const auto regions = stack[z].regions();
    const auto around = stack[z].around();
    std::vector<bool> is_solid(around.size());
    std::vector<bool> is_held(around.size());
    for (int y = 0; y < CellLayer::kSize; ++y) {
      for (int x = 0; x < CellLayer::kSize; ++x) {
        if (!stack[z].is_solid(x, y)) continue;
        const std::uint32_t region =
            regions[static_cast<std::size_t>(y * CellLayer::kSize + x)];
        is_solid[region] = true;
        if (stack[z - 1].is_solid(x, y)) is_held[region] = true;
      }
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      islands += is_solid[i] && !is_held[i] ? 1 : 0;
    }
  }
  return islands;
}

TEST(LayerGraph, FindsWhatCellsSay) {
  std::mt19937 random(3);
  for (unsigned trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    Stack stack;
    for (unsigned z = 0; z < 2 + trial % 7; ++z) {
      stack.push_back(z == 0 || trial % 3 == 0
                          ? CellLayer::any(random, 45 + trial % 40)
                          : stack.back().changed(random, trial % 5 * 3));
    }
    LayerGraph graph({});
    for (std::size_t z = 0; z < stack.size(); ++z) {
      Layer layer;
      layer.bottom = static_cast<double>(z);
      layer.top = layer.bottom + 1;
      layer.section_z = layer.bottom + 0.5;
      layer.contours = stack[z].contours(1, trial % 2 == 0 ? 0 : 0.3);
      graph.take(layer, nullptr);
    }
    const PrintCheck check = graph.finish();
    std::size_t loose_parts = 0;
    CellBodies(stack).visit(
        true, [&](int first, int, bool) { loose_parts += first > 0 ? 1 : 0; });
    std::size_t traps = 0;
    const int top = static_cast<int>(stack.size()) - 1;
    CellBodies(stack).visit(false, [&](int first, int last, bool is_outside) {
      traps += first > 0 && last < top && !is_outside ? 1 : 0;
    });
    // A loose part begins as an island, and is none besides.
    EXPECT_EQ(count(check, FindingKind::kIsland) + loose_parts,
              count_islands(stack));
    EXPECT_EQ(count(check, FindingKind::kLoosePart), loose_parts);
    EXPECT_EQ(count(check, FindingKind::kResinTrap), traps);
  }
}

}  // namespace
}  // namespace lamina::slicer
