#include "ldni/sweep/detail/agenda.h"

#include <algorithm>

namespace lamina::ldni::detail {

void Agenda::begin(double low, double high, std::uint32_t slab_count) {
  low_ = low;
  width_ = (high - low) / slab_count;
  slabs_per_mm_ = slab_count / (high - low);
  slab_count_ = slab_count;
  slab_ = 0;
  changes_.clear();
  lists_.assign(slab_count, kNone);
  renewals_.clear();
}

void Agenda::note(PairRef pair, const Outlook& outlook) {
  if (outlook.change < kNever) {
    changes_.push_back({outlook.change, pair});
    std::push_heap(changes_.begin(), changes_.end(), comes_later);
    return;
  }
  // Up to the end of a chain, or past the last slab: the turns will tell.
  if (outlook.horizon == kNever || is_last_slab()) return;
  // The slab must begin before the outlook ends: what changes right there has
  // to be seen as a change.
  const double slabs = (outlook.horizon - low_) * slabs_per_mm_;
  auto when = std::min(static_cast<std::uint32_t>(slabs), slab_count_ - 1);
  while (when > 0 && start_of(when) >= outlook.horizon) --when;
  when = std::max(when, slab_ + 1);
  renewals_.push_back({pair, lists_[when]});
  lists_[when] = static_cast<std::uint32_t>(renewals_.size() - 1);
}

PairRef Agenda::take_change() {
  const PairRef pair = changes_.front().pair;
  std::pop_heap(changes_.begin(), changes_.end(), comes_later);
  changes_.pop_back();
  return pair;
}

}  // namespace lamina::ldni::detail
