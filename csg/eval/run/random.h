#pragma once
// The random numbers of rands(): MT19937, the same sequence as std::mt19937.
//
// Source: Matsumoto and Nishimura, "Mersenne Twister", ACM TOMACS 8 (1998),
// with the seeding of their 2002 version. Departure: state words are seeded and
// twisted as they are needed. Noise functions of libraries seed anew for every
// two numbers; all 624 words each time took most of the evaluation.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace lamina::csg {

class MersenneTwister {
 public:
  using result_type = std::uint32_t;
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return 0xffffffff; }

  explicit MersenneTwister(std::uint32_t value = 5489) { seed(value); }
  void seed(std::uint32_t value) {
    state_[0] = value;
    seeded_ = 1;
    next_ = 0;
  }

  result_type operator()() {
    if (seeded_ < kSize) seed_up_to(std::min(next_ + kShift, kSize - 1));
    std::uint32_t& word = state_[next_];
    const std::size_t following = next_ + 1 < kSize ? next_ + 1 : 0;
    const std::size_t shifted =
        next_ + kShift < kSize ? next_ + kShift : next_ + kShift - kSize;
    const std::uint32_t joined =
        (word & 0x80000000) | (state_[following] & 0x7fffffff);
    word =
        state_[shifted] ^ (joined >> 1) ^ ((joined & 1) != 0 ? 0x9908b0df : 0);
    next_ = following;
    return temper(word);
  }

 private:
  static constexpr std::size_t kSize = 624;
  static constexpr std::size_t kShift = 397;

  // The words before are not twisted yet: twisting stays kShift behind.
  void seed_up_to(std::size_t last) {
    for (; seeded_ <= last; ++seeded_) {
      const std::uint32_t before = state_[seeded_ - 1];
      state_[seeded_] = 1812433253 * (before ^ (before >> 30)) +
                        static_cast<std::uint32_t>(seeded_);
    }
  }
  static std::uint32_t temper(std::uint32_t word) {
    word ^= word >> 11;
    word ^= (word << 7) & 0x9d2c5680;
    word ^= (word << 15) & 0xefc60000;
    return word ^ (word >> 18);
  }

  std::array<std::uint32_t, kSize> state_;
  std::size_t seeded_ = 0;
  std::size_t next_ = 0;
};

}  // namespace lamina::csg
