#include "slicer/check/print/touching_boxes.h"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::slicer {
namespace {

bool do_touch(const Box2& a, const Box2& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
         b.low.y <= a.high.y;
}

// All pairs, until nothing changes any more.
std::vector<std::uint32_t> first_of_each(const std::vector<Box2>& boxes) {
  std::vector<std::uint32_t> firsts(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) firsts[i] = i;
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (firsts[k] >= firsts[i] || !do_touch(boxes[i], boxes[k])) continue;
        firsts[i] = firsts[k];
        is_changed = true;
      }
    }
  }
  return firsts;
}

TEST(TouchingBoxes, AreThoseOfAllPairs) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 400; ++trial) {
    // Whole numbers, so that many touch in a line or a point, or are points.
    const auto number = [&](int most) {
      return static_cast<double>(random() % static_cast<unsigned>(most));
    };
    const int size = 2 + trial % 20;
    std::vector<Box2> boxes;
    for (int i = 0; i < trial % 60; ++i) {
      const Vec2 low(number(40), number(40));
      boxes.push_back({low, low + Vec2(number(size), number(size))});
    }
    EXPECT_EQ(TouchingBoxes().find(boxes), first_of_each(boxes)) << trial;
  }
}

TEST(TouchingBoxes, LooksAtFewPairsWhereAllTouch) {
  constexpr std::uint32_t kBoxes = 4000;
  TouchingBoxes touching;
  // Rows, columns, boxes in each other and boxes that climb: each pair of a
  // kind, or of two, touches or is passed at the same time.
  for (const int kind : {0, 1, 2, 3}) {
    std::vector<Box2> boxes;
    for (std::uint32_t i = 0; i < kBoxes; ++i) {
      const double at = 2.0 * i;
      const double far = 3.0 * kBoxes;
      if (kind == 0) boxes.push_back({Vec2(0, at), Vec2(far, at + 1)});
      if (kind == 1) {
        boxes.push_back(i % 2 == 0 ? Box2{Vec2(0, at), Vec2(far, at + 1)}
                                   : Box2{Vec2(at, 0), Vec2(at + 1, far)});
      }
      if (kind == 2) boxes.push_back({Vec2(at), Vec2(2 * far - at)});
      if (kind == 3) boxes.push_back({Vec2(at), Vec2(at + far)});
    }
    const auto& firsts = touching.find(boxes);
    EXPECT_EQ(firsts.back(), kind == 0 ? kBoxes - 1 : 0U);
    EXPECT_LT(touching.visits(), 40 * kBoxes) << kind;
  }
}

}  // namespace
}  // namespace lamina::slicer
