#include "slicer/check/print/touching_boxes.h"

#include <algorithm>
#include <numeric>

namespace lamina::slicer {
namespace {

constexpr std::uint32_t kNoBox = 0xffffffff;

}  // namespace

const std::vector<std::uint32_t>& TouchingBoxes::find(
    std::span<const Box2> boxes) {
  boxes_ = boxes;
  visits_ = 0;
  firsts_.resize(boxes.size());
  std::iota(firsts_.begin(), firsts_.end(), 0U);
  if (boxes.size() < 2) return firsts_;
  order_ = firsts_;
  std::ranges::sort(order_, {},
                    [&](std::uint32_t i) { return boxes[i].low.x; });
  levels_.clear();
  for (const Box2& box : boxes) {
    levels_.push_back(box.low.y);
    levels_.push_back(box.high.y);
  }
  std::ranges::sort(levels_);
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  covers_.assign(4 * levels_.size(), kNoBox);
  heads_.assign(4 * levels_.size(), kNoBox);
  entries_.clear();
  for (const std::uint32_t box : order_) add(box, 1, 0, levels_.size() - 1);
  for (std::uint32_t i = 0; i < boxes.size(); ++i) firsts_[i] = root_of(i);
  return firsts_;
}

// Adds a box below a node, whose levels it touches, and lets it meet all that
// share some of them.
void TouchingBoxes::add(std::uint32_t box, std::size_t node, std::size_t first,
                        std::size_t last) {
  const auto ends_later = [this](std::uint32_t a, std::uint32_t b) {
    return boxes_[a].high.x > boxes_[b].high.x;
  };
  std::uint32_t& cover = covers_[node];
  if (cover != kNoBox) meet(cover, box);
  std::uint32_t& head = heads_[node];
  if (levels_[first] < boxes_[box].low.y ||
      levels_[last] > boxes_[box].high.y) {
    entries_.push_back({box, head});
    head = static_cast<std::uint32_t>(entries_.size() - 1);
    const std::size_t middle = (first + last) / 2;
    if (boxes_[box].low.y <= levels_[middle]) {
      add(box, 2 * node, first, middle);
    }
    if (boxes_[box].high.y >= levels_[middle + 1]) {
      add(box, 2 * node + 1, middle + 1, last);
    }
    return;
  }
  if (cover == kNoBox || ends_later(box, cover)) cover = box;
  if (head == kNoBox) return;
  Entry& kept = entries_[head];
  for (std::uint32_t i = head; i != kNoBox; i = entries_[i].next) {
    meet(entries_[i].box, box);
    if (ends_later(entries_[i].box, kept.box)) kept.box = entries_[i].box;
  }
  kept.next = kNoBox;
}

// Joins two boxes that touch in y, of which b begins last.
void TouchingBoxes::meet(std::uint32_t a, std::uint32_t b) {
  ++visits_;
  if (boxes_[a].high.x < boxes_[b].low.x) return;
  const auto [first, second] = std::minmax({root_of(a), root_of(b)});
  firsts_[second] = first;
}

std::uint32_t TouchingBoxes::root_of(std::uint32_t box) {
  while (firsts_[box] != box) box = firsts_[box] = firsts_[firsts_[box]];
  return box;
}

}  // namespace lamina::slicer
