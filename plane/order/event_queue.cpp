#include "plane/order/event_queue.h"

#include <algorithm>

namespace lamina::plane {

void EventQueue::begin(double low, double high, std::uint32_t slab_count) {
  low_ = low;
  width_ = (high - low) / slab_count;
  slabs_per_mm_ = slab_count / (high - low);
  slab_count_ = slab_count;
  slab_ = 0;
  failures_.clear();
  lists_.assign(slab_count, kNone);
  renewals_.clear();
}

void EventQueue::schedule(PairRef pair, const Certificate& certificate) {
  if (certificate.failure < kNever) {
    failures_.push_back({certificate.failure, pair});
    std::push_heap(failures_.begin(), failures_.end(), comes_later);
    return;
  }
  // Valid to the end of a chain, or beyond the last slab: an endpoint is next.
  if (certificate.valid_until == kNever || is_last_slab()) return;
  // The slab must begin before the certificate ends: what fails right there
  // has to be seen as a failure.
  const double slabs = (certificate.valid_until - low_) * slabs_per_mm_;
  auto when = std::min(static_cast<std::uint32_t>(slabs), slab_count_ - 1);
  while (when > 0 && start_of(when) >= certificate.valid_until) --when;
  when = std::max(when, slab_ + 1);
  renewals_.push_back({pair, lists_[when]});
  lists_[when] = static_cast<std::uint32_t>(renewals_.size() - 1);
}

PairRef EventQueue::take_failure() {
  const PairRef pair = failures_.front().pair;
  std::pop_heap(failures_.begin(), failures_.end(), comes_later);
  failures_.pop_back();
  return pair;
}

}  // namespace lamina::plane
