#include "plane/order/status.h"

namespace lamina::plane {

void Status::begin(std::size_t chain_count) {
  sentinel_ = static_cast<std::uint32_t>(chain_count);
  if (entries_.size() <= chain_count) entries_.resize(chain_count + 1);
  tree_.begin(chain_count + 1);
  entries_[sentinel_] = {};
  entries_[sentinel_].below = sentinel_;
  entries_[sentinel_].above = sentinel_;
  long_walks_ = 0;
}

void Status::insert_above(std::uint32_t below, std::uint32_t entry) {
  const std::uint32_t above = entries_[below].above;
  entries_[entry].below = below;
  entries_[entry].above = above;
  entries_[below].above = entry;
  entries_[above].below = entry;
  tree_.insert(below, above, entry);
}

void Status::remove(std::uint32_t entry) {
  const Entry& removed = entries_[entry];
  entries_[removed.below].above = removed.above;
  entries_[removed.above].below = removed.below;
  tree_.remove(entry, removed.above);
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
  tree_.swap(entry, other);
}

std::uint32_t Status::find_below(double y, double x) {
  return tree_.find_last(
      [&](std::uint32_t entry) { return y_at(entry, x) <= y; }, sentinel_);
}

}  // namespace lamina::plane
