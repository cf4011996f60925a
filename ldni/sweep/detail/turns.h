#pragma once
// The turns of a layer in the order in which the ray meets them.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "ldni/section/leaf_section.h"
#include "ldni/sweep/detail/lone_loops.h"

namespace lamina::ldni::detail {

// One end of a chain.
struct Turn {
  double x = 0;
  std::uint32_t chain_and_end = 0;

  std::uint32_t chain() const { return chain_and_end >> 1; }
  bool is_end() const { return (chain_and_end & 1) != 0; }
};

class TurnSorter {
 public:
  // Both turns of each chain, of a lone loop only the start of the first one,
  // ascending in x; equal x in the order of chains.
  // Valid until the next call. O(chains): a radix sort of rounded x, then
  // insertion among the few that rounding made equal.
  std::span<const Turn> sort(std::span<const Chain> chains,
                             std::span<const Vec2> points,
                             const LoneLoops& lone_loops);

 private:
  struct Key {
    std::uint32_t rounded = 0;
    std::uint32_t turn = 0;
  };

  template <int kDigitBits>
  void sort_keys();

  std::vector<Turn> unsorted_;
  std::vector<Turn> sorted_;
  std::vector<Key> keys_;
  std::vector<Key> other_keys_;
};

}  // namespace lamina::ldni::detail
