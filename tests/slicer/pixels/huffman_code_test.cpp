#include "slicer/pixels/detail/huffman_code.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::slicer {
namespace {

using Counts = std::vector<std::uint64_t>;

// The bits that all symbols take, by the definition: the two least are joined
// until one is left.
std::uint64_t least_bits(const Counts& counts) {
  std::priority_queue<std::uint64_t, Counts, std::greater<>> queue;
  for (const std::uint64_t count : counts) {
    if (count > 0) queue.push(count);
  }
  std::uint64_t bits = 0;
  while (queue.size() > 1) {
    std::uint64_t sum = queue.top();
    queue.pop();
    sum += queue.top();
    queue.pop();
    bits += sum;
    queue.push(sum);
  }
  return bits;
}

std::uint64_t bits_of(const Counts& counts,
                      const std::vector<std::uint8_t>& lengths) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    bits += counts[i] * lengths[i];
  return bits;
}

// Kraft's sum in units of 2^-40: a complete code fills 2^40.
std::uint64_t filled(const std::vector<std::uint8_t>& lengths) {
  std::uint64_t sum = 0;
  for (const std::uint8_t length : lengths) {
    if (length > 0) sum += std::uint64_t{1} << (40 - length);
  }
  return sum;
}

TEST(HuffmanCode, IsTheShortestAndComplete) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    Counts counts(2 + random() % 286);
    for (std::uint64_t& count : counts) count = random() % 3 * (random() % 900);
    counts[0] = 1;
    counts[1] = 5;
    const auto lengths = huffman_lengths(counts, 40);
    EXPECT_EQ(bits_of(counts, lengths), least_bits(counts));
    EXPECT_EQ(filled(lengths), std::uint64_t{1} << 40);
  }
}

TEST(HuffmanCode, IsNeverLongerThanAllowed) {
  // Fibonacci's numbers make the deepest tree.
  Counts counts = {1, 1};
  while (counts.size() < 60) {
    counts.push_back(counts[counts.size() - 1] + counts[counts.size() - 2]);
  }
  for (const int most : {6, 7, 9, 15}) {
    const auto lengths = huffman_lengths(counts, most);
    EXPECT_LE(*std::ranges::max_element(lengths), most);
    EXPECT_EQ(filled(lengths), std::uint64_t{1} << 40);
  }  // A limit that hardly bites costs hardly anything.
  EXPECT_LE(bits_of(counts, huffman_lengths(counts, 15)),
            least_bits(counts) * 101 / 100);
}

TEST(HuffmanCode, OneSymbolHasOneBitAndNoneNothing) {
  EXPECT_EQ(huffman_lengths(Counts{0, 7, 0}, 15),
            (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(huffman_lengths(Counts{0, 0}, 15),
            (std::vector<std::uint8_t>{0, 0}));
}

TEST(HuffmanCode, NoCodeBeginsAnother) {
  const Counts counts = {5, 0, 9, 12, 13, 16, 45, 1, 1, 2};
  const auto codes = huffman_codes(huffman_lengths(counts, 15));
  for (std::size_t a = 0; a < codes.size(); ++a) {
    for (std::size_t b = 0; b < codes.size(); ++b) {
      if (a == b || counts[a] == 0 || counts[b] == 0) continue;
      if (codes[a].count > codes[b].count) continue;
      EXPECT_NE(codes[b].bits & ((1U << codes[a].count) - 1), codes[a].bits)
          << a << " " << b;
    }
  }
}

}  // namespace
}  // namespace lamina::slicer
