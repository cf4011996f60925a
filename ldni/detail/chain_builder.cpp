#include "ldni/detail/chain_builder.h"

#include <algorithm>
#include <cmath>

namespace lamina::ldni::detail {
namespace {

// A loop narrower than this [mm] is dropped whole, which no parity notices: it
// is far below the distance at which faces tie (kTieDistance), and its few
// edges could all count as vertical.
constexpr double kLeastWidth = 1e-8;

int direction_of(const Vec2& from, const Vec2& to) {
  return (from.x < to.x) - (to.x < from.x);
}

}  // namespace

void ChainBuilder::begin(ChainBlock& block) {
  block_ = &block;
  block.points.clear();
  chains_.clear();
  layers_.clear();
  loop_.clear();
}

// Copies loop_ to snapped_ with one x for the ends of every vertical edge and
// without repeated points. False where nothing worth a chain is left.
bool ChainBuilder::snap_verticals() {
  snapped_.clear();
  const std::size_t count = loop_.size();
  if (count < 3) return false;
  // Begin behind an edge that stays wide enough whatever is snapped before
  // it, so that closing the loop meets no vertical edge.
  const auto [low, high] = std::minmax_element(
      loop_.begin(), loop_.end(),
      [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
  if (high->x - low->x < kLeastWidth) return false;
  std::size_t start = 0;
  double widest = 0;
  for (std::size_t i = 0; i < count && widest < 2 * kColumnWidth; ++i) {
    const Vec2& before = loop_[i == 0 ? count - 1 : i - 1];
    const double width = std::abs(loop_[i].x - before.x);
    if (width > widest) {
      widest = width;
      start = i;
    }
  }
  const auto take = [this](Vec2 point) {
    if (!snapped_.empty()) {
      const Vec2& last = snapped_.back();
      if (std::abs(point.x - last.x) < kColumnWidth) {
        point.x = last.x;
        if (std::abs(point.y - last.y) < kColumnWidth) return;
      }
    }
    snapped_.push_back(point);
  };
  for (std::size_t i = start; i < count; ++i) take(loop_[i]);
  for (std::size_t i = 0; i < start; ++i) take(loop_[i]);
  return snapped_.size() >= 3;
}

void ChainBuilder::close_loop(std::uint32_t layer, std::uint32_t instance,
                              std::int32_t orientation) {
  const bool is_worth_it = snap_verticals();
  loop_.clear();
  if (!is_worth_it) return;

  // Find a vertex where the direction changes, and begin there.
  const std::size_t count = snapped_.size();
  const int first_direction = direction_of(snapped_[0], snapped_[1]);
  std::size_t start = 1;
  while (direction_of(snapped_[start],
                      snapped_[start + 1 == count ? 0 : start + 1]) ==
         first_direction) {
    ++start;
  }
  std::rotate(snapped_.begin(),
              snapped_.begin() + static_cast<std::ptrdiff_t>(start),
              snapped_.end());
  snapped_.push_back(snapped_.front());

  // Every maximal run of one direction is a chain.
  Chain chain;
  chain.instance = instance;
  for (std::size_t first = 0; first < count;) {
    const int direction = direction_of(snapped_[first], snapped_[first + 1]);
    std::size_t last = first + 1;
    while (last < count &&
           direction_of(snapped_[last], snapped_[last + 1]) == direction) {
      ++last;
    }
    if (direction != 0) {
      chain.winding = direction * orientation;
      add_chain(first, last, direction > 0, chain, layer);
    }
    first = last;
  }
}

void ChainBuilder::add_chain(std::size_t first, std::size_t last,
                             bool is_forward, Chain chain,
                             std::uint32_t layer) {
  std::vector<Vec2>& points = block_->points;
  chain.first_point = static_cast<std::uint32_t>(points.size());
  chain.point_count = static_cast<std::uint32_t>(last - first + 1);
  const auto begin = snapped_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = snapped_.begin() + static_cast<std::ptrdiff_t>(last) + 1;
  if (is_forward) {
    points.insert(points.end(), begin, end);
  } else {
    points.insert(points.end(), std::make_reverse_iterator(end),
                  std::make_reverse_iterator(begin));
  }
  chains_.push_back(chain);
  layers_.push_back(layer);
}

void ChainBuilder::finish(ChainBlock& block) {
  // Sort by counting: layer_ends first holds begins, then moves to the ends.
  block.layer_ends.assign(block.layer_count, 0);
  for (const std::uint32_t layer : layers_) ++block.layer_ends[layer];
  std::uint32_t sum = 0;
  for (std::uint32_t& end : block.layer_ends) {
    const std::uint32_t size = end;
    end = sum;
    sum += size;
  }
  block.chains.resize(chains_.size());
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    block.chains[block.layer_ends[layers_[i]]++] = chains_[i];
  }
  block_ = nullptr;
}

}  // namespace lamina::ldni::detail
