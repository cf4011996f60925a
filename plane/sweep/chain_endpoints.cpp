#include "plane/sweep/chain_endpoints.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace lamina::plane {
namespace {

constexpr double kLargestKey = 4294967040.0;  // safely below 2^32
// Up to kSmall endpoints comparing is faster; up to kMedium four digits of 8
// bits are faster than three of 11, whose counts outnumber the endpoints.
constexpr std::size_t kSmall = 128;
constexpr std::size_t kMedium = 4096;

bool precedes(const ChainEndpoint& a, const ChainEndpoint& b) {
  return a.x < b.x || (a.x == b.x && a.chain_and_side < b.chain_and_side);
}

}  // namespace

// A radix sort, the lowest digit first.
template <int kDigitBits>
void EndpointSorter::sort_keys() {
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  other_keys_.resize(keys_.size());
  for (int shift = 0; shift < 32; shift += kDigitBits) {
    std::array<std::uint32_t, kDigits> begins{};
    for (const Key& key : keys_) {
      ++begins[key.rounded >> shift & (kDigits - 1)];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& begin : begins) {
      const std::uint32_t size = begin;
      begin = sum;
      sum += size;
    }
    for (const Key& key : keys_) {
      other_keys_[begins[key.rounded >> shift & (kDigits - 1)]++] = key;
    }
    std::swap(keys_, other_keys_);
  }
}

void EndpointSorter::list(std::span<const Chain> chains,
                          std::span<const Vec2> points,
                          const LoneLoops* lone_loops) {
  unsorted_.clear();
  low_ = 1e300;
  high_ = -1e300;
  for (std::uint32_t i = 0; i < chains.size(); ++i) {
    const std::span<const Vec2> chain = chains[i].points_in(points);
    const double start = chain.front().x;
    const double end = chain.back().x;
    unsorted_.push_back({start, 2 * i});
    if (lone_loops != nullptr && lone_loops->is_lone(i)) {
      ++i;  // the loop's other chain
    } else {
      unsorted_.push_back({end, 2 * i + 1});
    }
    low_ = std::min(low_, start);
    high_ = std::max(high_, end);
  }
}

std::span<const ChainEndpoint> EndpointSorter::sort_listed() {
  if (unsorted_.size() <= kSmall) {
    std::sort(unsorted_.begin(), unsorted_.end(), precedes);
    return unsorted_;
  }

  // Sort by x rounded to 32 bits, which keeps the order of equal keys.
  keys_.resize(unsorted_.size());
  const double scale = high_ > low_ ? kLargestKey / (high_ - low_) : 0;
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    keys_[i].rounded =
        static_cast<std::uint32_t>((unsorted_[i].x - low_) * scale);
    keys_[i].endpoint = i;
  }
  if (keys_.size() <= kMedium) {
    sort_keys<8>();
  } else {
    sort_keys<11>();
  }
  sorted_.resize(unsorted_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    sorted_[i] = unsorted_[keys_[i].endpoint];
  }
  // Repair the order of what rounding made equal.
  for (std::size_t i = 1; i < sorted_.size(); ++i) {
    const ChainEndpoint endpoint = sorted_[i];
    std::size_t k = i;
    for (; k > 0 && precedes(endpoint, sorted_[k - 1]); --k) {
      sorted_[k] = sorted_[k - 1];
    }
    sorted_[k] = endpoint;
  }
  return sorted_;
}

}  // namespace lamina::plane
