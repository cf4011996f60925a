#include "ldni/sweep/detail/status.h"

namespace lamina::ldni::detail {

void Status::begin(std::size_t chain_count) {
  sentinel_ = static_cast<std::uint32_t>(chain_count);
  if (entries_.size() <= chain_count) entries_.resize(chain_count + 1);
  is_alive_.assign(chain_count + 1, 0);
  entries_[sentinel_] = {};
  entries_[sentinel_].below = sentinel_;
  entries_[sentinel_].above = sentinel_;
  size_ = 0;
  order_.clear();
  changes_ = 0;
  long_walks_ = 0;
}

void Status::insert_above(std::uint32_t below, std::uint32_t entry) {
  const std::uint32_t above = entries_[below].above;
  entries_[entry].below = below;
  entries_[entry].above = above;
  entries_[below].above = entry;
  entries_[above].below = entry;
  is_alive_[entry] = 1;
  ++size_;
  ++changes_;
}

void Status::remove(std::uint32_t entry) {
  const Entry& removed = entries_[entry];
  entries_[removed.below].above = removed.above;
  entries_[removed.above].below = removed.below;
  is_alive_[entry] = 0;
  --size_;
  ++changes_;
}

void Status::swap_with_above(std::uint32_t entry) {
  const std::uint32_t other = entries_[entry].above;
  const std::uint32_t below = entries_[entry].below;
  const std::uint32_t above = entries_[other].above;
  entries_[below].above = other;
  entries_[other].below = below;
  entries_[other].above = entry;
  entries_[entry].below = other;
  entries_[entry].above = above;
  entries_[above].below = entry;
}

std::uint32_t Status::find_near(double y, double x) {
  if (size_ == 0) return sentinel_;
  // As many changes as a quarter of the entries leave the search a few steps
  // off; renewing then costs a few steps a change.
  if (order_.empty() || changes_ > 8 + size_ / 4) renew_order();
  std::size_t low = 0;  // what stands before is below y
  std::size_t high = order_.size();
  std::uint32_t best = first();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    std::size_t probe = middle;
    while (probe < high && !is_alive(order_[probe])) ++probe;
    if (probe < high && y_at(order_[probe], x) <= y) {
      best = order_[probe];
      low = probe + 1;
    } else {
      high = middle;
    }
  }
  return best;
}

std::uint32_t Status::find_below(double y, double x) {
  std::uint32_t below = find_near(y, x);
  while (below != sentinel_ && y_at(below, x) > y) {
    below = entries_[below].below;
  }
  for (std::uint32_t above = entries_[below].above;
       above != sentinel_ && y_at(above, x) <= y;
       above = entries_[below].above) {
    below = above;
  }
  return below;
}

void Status::renew_order() {
  order_.clear();
  for (std::uint32_t e = first(); e != sentinel_; e = entries_[e].above) {
    order_.push_back(e);
  }
  changes_ = 0;
}

}  // namespace lamina::ldni::detail
