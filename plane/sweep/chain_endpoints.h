#pragma once
// The endpoints of a layer's chains, in the order in which the ray meets them.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"
#include "plane/sweep/lone_loops.h"

namespace lamina::plane {

// The left or right endpoint of a chain: a local extremum of x of its loop.
struct ChainEndpoint {
  double x = 0;
  std::uint32_t chain_and_side = 0;

  std::uint32_t chain() const { return chain_and_side >> 1; }
  bool is_right() const { return (chain_and_side & 1) != 0; }
};

class EndpointSorter {
 public:
  // Both endpoints of each chain, of a lone loop only the left one of its
  // first chain, ascending in x; equal x in the order of chains. Valid until
  // the next call. O(chains): a radix sort of rounded x, then insertion among
  // the few that rounding made equal.
  std::span<const ChainEndpoint> sort(std::span<const Chain> chains,
                                      std::span<const Vec2> points,
                                      const LoneLoops& lone_loops) {
    list(chains, points, &lone_loops);
    return sort_listed();
  }
  // Sorts both endpoints of each chain.
  std::span<const ChainEndpoint> sort(std::span<const Chain> chains,
                                      std::span<const Vec2> points) {
    list(chains, points, nullptr);
    return sort_listed();
  }

 private:
  struct Key {
    std::uint32_t rounded = 0;
    std::uint32_t endpoint = 0;
  };

  void list(std::span<const Chain> chains, std::span<const Vec2> points,
            const LoneLoops* lone_loops);
  std::span<const ChainEndpoint> sort_listed();
  template <int kDigitBits>
  void sort_keys();

  double low_ = 0;  // of the listed endpoints
  double high_ = 0;
  std::vector<ChainEndpoint> unsorted_;
  std::vector<ChainEndpoint> sorted_;
  std::vector<Key> keys_;
  std::vector<Key> other_keys_;
};

}  // namespace lamina::plane
