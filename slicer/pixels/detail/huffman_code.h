#pragma once
// Huffman codes as deflate has them: known by their lengths alone, of at most a
// given number of bits (RFC 1951, 3.2.2).

#include <cstdint>
#include <span>
#include <vector>

namespace lamina::slicer {

// A code with its first bit lowest.
struct HuffmanCode {
  std::uint32_t bits = 0;
  int count = 0;
};

// The lengths of the shortest codes, 0 for symbols that do not occur; where
// some would be longer than `most_bits`, nearly the shortest. A symbol that is
// alone has a code of 1 bit. There are at most 2^most_bits symbols.
//
// counts  how often each symbol occurs
std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint64_t> counts,
                                          int most_bits);

// The codes that these lengths, 15 at most, stand for.
std::vector<HuffmanCode> huffman_codes(std::span<const std::uint8_t> lengths);

}  // namespace lamina::slicer
