#include "slicer/pixels/detail/run_deflater.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace lamina::slicer {
namespace {

// Symbols of deflate's first alphabet: a byte as it is, the end of the block,
// and lengths of matches. Every match here repeats the byte before it.
constexpr std::size_t kEnd = 256;
constexpr std::size_t kFirstLength = 257;
constexpr std::size_t kSymbols = 286;
constexpr std::size_t kLongest = 258;  // match, of the last symbol
constexpr std::size_t kShortest = 3;

// A Huffman code with its first bit lowest, as deflate wants it.
struct Code {
  std::uint32_t bits = 0;
  int count = 0;
};

// The codes that these lengths stand for (RFC 1951, 3.2.2).
template <std::size_t Size>
constexpr std::array<Code, Size> codes_of(
    const std::array<std::uint8_t, Size>& lengths) {
  std::array<Code, Size> codes = {};
  std::uint32_t next = 0;
  for (int length = 1; length <= 15; ++length) {
    next <<= 1;
    for (std::size_t symbol = 0; symbol < Size; ++symbol) {
      if (lengths[symbol] != length) continue;
      std::uint32_t reversed = 0;
      for (int bit = 0; bit < length; ++bit) {
        reversed |= (next >> bit & 1) << (length - 1 - bit);
      }
      codes[symbol] = {reversed, length};
      ++next;
    }
  }
  return codes;
}

// Symbols that images of layers need more often get shorter codes: first long
// matches in black and white, then black and white themselves, then lengths of
// runs; greys are rare and equally so. The lengths fill the code exactly.
constexpr int kGreyBits = 11;
constexpr std::size_t kLastShorterGrey = 65;  // 1 bit less, to fill the code

constexpr std::array<std::uint8_t, kSymbols> kLengths = [] {
  std::array<std::uint8_t, kSymbols> lengths = {};
  for (std::size_t symbol = 0; symbol < kSymbols; ++symbol) {
    lengths[symbol] = symbol >= kFirstLength ? 7 : kGreyBits;
    if (symbol >= 1 && symbol <= kLastShorterGrey) --lengths[symbol];
  }
  lengths[0x00] = lengths[0xFF] = 4;
  lengths[kSymbols - 1] = 1;
  return lengths;
}();
constexpr std::array<Code, kSymbols> kCodes = codes_of(kLengths);

// The header holds those lengths in codes of their own; the lengths of these
// codes stand in the header in this order.
constexpr std::array<std::uint8_t, 18> kLengthOrder = {
    16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1};
constexpr std::array<std::uint8_t, 19> kLengthLengths = [] {
  std::array<std::uint8_t, 19> lengths = {};
  lengths[kGreyBits] = 1;
  lengths[kGreyBits - 1] = 2;
  lengths[7] = 3;
  lengths[4] = lengths[1] = 4;
  return lengths;
}();
constexpr std::array<Code, 19> kLengthCodes = codes_of(kLengthLengths);

// Whole codes of matches by their lengths: the symbol, the bits that
// distinguish lengths of one symbol, and the distance, whose only code is 0.
constexpr std::array<Code, kLongest + 1> kMatches = [] {
  std::array<Code, kLongest + 1> matches = {};
  std::size_t length = kShortest;
  for (std::size_t symbol = kFirstLength; symbol + 1 < kSymbols; ++symbol) {
    const int group = static_cast<int>(symbol - kFirstLength) / 4;
    const int extra = group < 2 ? 0 : group - 1;
    for (std::uint32_t i = 0; i < (1U << extra); ++i, ++length) {
      const Code code = kCodes[symbol];
      matches[length] = {code.bits | (i << code.count), code.count + extra + 1};
    }
  }
  const Code longest = kCodes[kSymbols - 1];
  matches[kLongest] = {longest.bits, longest.count + 1};
  return matches;
}();

// How many of the longest matches are written at once.
constexpr int kAtOnce = 16;
constexpr Code kManyMatches = [] {
  Code many;
  for (int i = 0; i < kAtOnce; ++i) {
    many.bits |= kMatches[kLongest].bits << many.count;
    many.count += kMatches[kLongest].count;
  }
  return many;
}();

constexpr std::uint64_t kAdlerModulus = 65521;
// Parts of a run of this many bytes leave the sums below 2^64.
constexpr std::uint64_t kAdlerPart = 1 << 24;

}  // namespace

RunDeflater::RunDeflater() {
  put(0x0178, 16);  // deflate with a window of 32 KiB
  put_header();
}

void RunDeflater::put_header() {
  put(0b101, 3);  // the last block; its own codes
  put(kSymbols - 257, 5);
  put(0, 5);  // one code of distances
  put(kLengthOrder.size() - 4, 4);
  for (const std::uint8_t length : kLengthOrder) {
    put(kLengthLengths[length], 3);
  }
  for (const std::uint8_t length : kLengths) {
    put(kLengthCodes[length].bits, kLengthCodes[length].count);
  }
  put(kLengthCodes[1].bits, kLengthCodes[1].count);  // of the distance
}

void RunDeflater::add(std::uint8_t value, std::uint64_t count) {
  if (count == 0) return;
  if (value != value_) {
    write_run();
    value_ = value;
  }
  count_ += count;
}

void RunDeflater::write_run() {
  for (std::uint64_t left = count_; left > 0;) {
    const std::uint64_t part = std::min(left, kAdlerPart);
    sum_of_sums_ =
        (sum_of_sums_ + part * sum_ + part * (part + 1) / 2 * value_) %
        kAdlerModulus;
    sum_ = (sum_ + part * value_) % kAdlerModulus;
    left -= part;
  }
  if (count_ > 0) {
    put(kCodes[value_].bits, kCodes[value_].count);
    write_matches(count_ - 1);
  }
  count_ = 0;
}

void RunDeflater::write_matches(std::uint64_t count) {
  for (; count >= kAtOnce * kLongest; count -= kAtOnce * kLongest) {
    put(kManyMatches.bits, kManyMatches.count);
  }
  for (; count >= kLongest; count -= kLongest) {
    put(kMatches[kLongest].bits, kMatches[kLongest].count);
  }
  if (count >= kShortest) {
    put(kMatches[count].bits, kMatches[count].count);
    return;
  }
  for (; count > 0; --count) put(kCodes[value_].bits, kCodes[value_].count);
}

void RunDeflater::put(std::uint64_t bits, int count) {
  bits_ |= bits << bit_count_;
  bit_count_ += count;
  if (bit_count_ < 32) return;
  for (int shift = 0; shift < 32; shift += 8) {
    bytes_.push_back(static_cast<char>(bits_ >> shift));
  }
  bits_ >>= 32;
  bit_count_ -= 32;
}

std::string RunDeflater::finish() {
  write_run();
  put(kCodes[kEnd].bits, kCodes[kEnd].count);
  put(0, (8 - bit_count_ % 8) % 8);
  for (const std::uint64_t sum : {sum_of_sums_, sum_}) {
    put(sum >> 8, 8);
    put(sum & 0xFF, 8);
  }
  for (; bit_count_ > 0; bit_count_ -= 8, bits_ >>= 8) {
    bytes_.push_back(static_cast<char>(bits_));
  }
  return std::move(bytes_);
}

}  // namespace lamina::slicer
