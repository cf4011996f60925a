#include "csg/mesh/box_tree.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace lamina::csg {
namespace {

// So few boxes are looked at one by one.
constexpr std::uint32_t kItemsOfALeaf = 4;

int longest_axis(const Box3& box) {
  const Vec3 size = box.size();
  const int axis = size.y > size.x ? 1 : 0;
  return size.z > size[axis] ? 2 : axis;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box3> boxes)
    : items_(boxes.size()), boxes_(boxes.begin(), boxes.end()) {
  std::iota(items_.begin(), items_.end(), 0u);
  if (!boxes.empty()) build(0, static_cast<std::uint32_t>(boxes.size()));
}

void BoxTree::build(std::uint32_t first, std::uint32_t count) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({{}, first, count, 1});
  Box3 box;
  for (std::uint32_t i = first; i < first + count; ++i) {
    box.add(boxes_[items_[i]]);
  }
  nodes_[self].box = box;
  if (count <= kItemsOfALeaf) return;

  // Halve them where their middles lie along the longest side.
  const int axis = longest_axis(box);
  const auto begin = items_.begin() + first;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return boxes_[a].low[axis] + boxes_[a].high[axis] <
                            boxes_[b].low[axis] + boxes_[b].high[axis];
                   });
  build(first, half);
  build(first + half, count - half);
  nodes_[self].size = static_cast<std::uint32_t>(nodes_.size() - self);
}

}  // namespace lamina::csg
