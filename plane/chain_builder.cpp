#include "plane/chain_builder.h"

#include <algorithm>
#include <cmath>

namespace lamina::plane {
namespace {

// A loop narrower than this [mm] is dropped whole, which no parity notices: it
// is far below the distance at which faces tie (kTieDistance), and its few
// edges could all count as vertical.
constexpr double kLeastWidth = 1e-8;

// The direction of an edge in x; 0 where it is no wider than that.
int direction_of(const Vec2& from, const Vec2& to, double vertical_width) {
  const double width = to.x - from.x;
  return (width > vertical_width) - (width < -vertical_width);
}

// Returns the end of the run of edges that go right or left, from `point` on.
Vec2* end_of_run(Vec2* point, const Vec2* last, int direction,
                 double vertical_width) {
  ++point;
  if (direction > 0) {
    while (point != last && point[1].x - point[0].x > vertical_width) ++point;
  } else {
    while (point != last && point[0].x - point[1].x > vertical_width) ++point;
  }
  return point;
}

// Gives the ends of an upright edge one x. Not where that could make another
// edge upright, or where the edge is a repeated point: false.
bool snap_alone(const Vec2& before, Vec2* edge, const Vec2& after) {
  constexpr double kStaysWide = 2 * kClusterWidth;
  if (std::abs(edge[0].x - before.x) < kStaysWide ||
      std::abs(edge[1].x - after.x) < kStaysWide ||
      std::abs(edge[1].y - edge[0].y) < kClusterWidth) {
    return false;
  }
  edge[1].x = edge[0].x;
  return true;
}

// Sorts items by layer, keeping their order there: counts, then deals out.
// ends[i] becomes the end of layer i.
template <typename Item>
void bucket(const std::vector<Item>& items,
            const std::vector<std::uint32_t>& layers, std::uint32_t layer_count,
            std::vector<Item>& bucketed, std::vector<std::uint32_t>& ends) {
  ends.assign(layer_count, 0);
  for (const std::uint32_t layer : layers) ++ends[layer];
  // First the begins, which dealing out moves to the ends.
  std::uint32_t sum = 0;
  for (std::uint32_t& end : ends) {
    const std::uint32_t size = end;
    end = sum;
    sum += size;
  }
  bucketed.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    bucketed[ends[layers[i]]++] = items[i];
  }
}

}  // namespace

void ChainBuilder::begin(ChainBlock& block) {
  block_ = &block;
  block.points.clear();
  chains_.clear();
  layers_.clear();
  loops_.clear();
  loop_layers_.clear();
  loop_.clear();
}

bool ChainBuilder::is_wide() const {
  const auto [low, high] = std::minmax_element(
      loop_.begin(), loop_.end(),
      [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
  return high->x - low->x >= kLeastWidth;
}

// Copies loop_ to snapped_ with one x for the ends of every vertical edge and
// without repeated points.
void ChainBuilder::snap_verticals() {
  snapped_.clear();
  const std::size_t count = loop_.size();
  // Begin behind an edge that stays wide enough whatever is snapped before
  // it, so that closing the loop meets no vertical edge.
  std::size_t start = 0;
  double widest = 0;
  for (std::size_t i = 0; i < count && widest < 2 * kClusterWidth; ++i) {
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
      if (std::abs(point.x - last.x) < kClusterWidth) {
        point.x = last.x;
        if (std::abs(point.y - last.y) < kClusterWidth) return;
      }
    }
    snapped_.push_back(point);
  };
  for (std::size_t i = start; i < count; ++i) take(loop_[i]);
  for (std::size_t i = 0; i < start; ++i) take(loop_[i]);
}

void ChainBuilder::close_loop(std::uint32_t layer, std::uint32_t operand,
                              std::int32_t orientation) {
  Chain chain;
  chain.operand = operand;
  const std::size_t chains_before = chains_.size();
  const std::size_t size = loop_.size();
  // Most vertical edges have none beside them.
  if (size >= 3 && !cut(loop_, kClusterWidth, layer, chain, orientation)) {
    loop_.resize(size);
    if (is_wide()) {
      snap_verticals();
      if (snapped_.size() >= 3) {
        cut(snapped_, 0, layer, chain, orientation);
      }
    }
  }
  loop_.clear();
  last_chain_count_ =
      static_cast<std::uint32_t>(chains_.size() - chains_before);
  if (last_chain_count_ > 0) {
    loops_.push_back({last_chain_count_, orientation});
    loop_layers_.push_back(layer);
  }
}

void ChainBuilder::repeat_loop(std::uint32_t layer) {
  if (last_chain_count_ == 0) return;
  for (std::uint32_t i = 0; i < last_chain_count_; ++i) {
    chains_.push_back(chains_[chains_.size() - last_chain_count_]);
    layers_.push_back(layer);
  }
  loops_.push_back(loops_.back());
  loop_layers_.push_back(layer);
}

// Makes a chain of every maximal run of one direction; extends the loop. Edges
// no wider than `vertical_width` belong to no chain. Where that is not 0 they
// are snapped; one with a vertical neighbour, or a loop that may be too narrow,
// ends the work with nothing done: false.
bool ChainBuilder::cut(std::vector<Vec2>& loop, double vertical_width,
                       std::uint32_t layer, Chain chain,
                       std::int32_t orientation) {
  // Find a vertex where the direction changes, begin there, and repeat what
  // is before it at the end.
  loop.push_back(loop.front());
  const Vec2* first = loop.data();
  const Vec2* last = &loop.back();
  const int first_direction = direction_of(first[0], first[1], vertical_width);
  while (++first != last &&
         direction_of(first[0], first[1], vertical_width) == first_direction) {
  }
  const auto start = static_cast<std::size_t>(first - loop.data());
  // The edge that leads there comes last below: it is snapped before the
  // chains.
  if (first_direction == 0 && vertical_width > 0 &&
      !(start == 1 &&
        snap_alone(loop[loop.size() - 2], loop.data(), loop[2]))) {
    return false;
  }
  const std::size_t count = loop.size();
  loop.resize(count + start);
  std::copy_n(loop.begin() + 1, start,
              loop.begin() + static_cast<std::ptrdiff_t>(count));

  const std::size_t points_before = block_->points.size();
  const std::size_t chains_before = chains_.size();
  double widest = 0;  // of the chains
  last = &loop.back();
  for (Vec2* point = &loop[start]; point != last;) {
    const int direction = direction_of(point[0], point[1], vertical_width);
    if (direction == 0) {
      if (vertical_width > 0 && point + 1 != last &&
          !snap_alone(point[-1], point, point[2])) {
        widest = 0;
        break;
      }
      ++point;
      continue;
    }
    Vec2* end = end_of_run(point, last, direction, vertical_width);
    chain.winding = direction * orientation;
    add_chain({point, end + 1}, direction > 0, chain, layer);
    widest = std::max(widest, std::abs(end->x - point->x));
    point = end;
  }
  if (vertical_width == 0 || widest >= kLeastWidth) return true;
  block_->points.resize(points_before);
  chains_.resize(chains_before);
  layers_.resize(chains_before);
  return false;
}

void ChainBuilder::add_chain(std::span<const Vec2> run, bool is_forward,
                             Chain chain, std::uint32_t layer) {
  std::vector<Vec2>& points = block_->points;
  chain.first_point = static_cast<std::uint32_t>(points.size());
  chain.point_count = static_cast<std::uint32_t>(run.size());
  if (is_forward) {
    points.insert(points.end(), run.begin(), run.end());
  } else {
    points.insert(points.end(), run.rbegin(), run.rend());
  }
  chains_.push_back(chain);
  layers_.push_back(layer);
}

void ChainBuilder::finish(ChainBlock& block) {
  bucket(chains_, layers_, block.layer_count, block.chains, block.layer_ends);
  bucket(loops_, loop_layers_, block.layer_count, block.loops, block.loop_ends);
  block_ = nullptr;
}

}  // namespace lamina::plane
