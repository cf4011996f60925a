#include "slicer/pixels/detail/run_deflater.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "slicer/pixels/detail/huffman_code.h"

namespace lamina::slicer {
namespace {

// Symbols of deflate's first alphabet: a byte as it is, the end of the block,
// and lengths of matches. Every match here repeats the byte before it.
constexpr std::size_t kEnd = 256;
constexpr std::size_t kFirstLength = 257;
constexpr std::size_t kSymbols = 286;
constexpr std::size_t kLongest = 258;  // match, of the last symbol
constexpr std::size_t kShortest = 3;

// Runs of a block: so few that memory stays small, so many that the lengths of
// their codes, some 100 bytes, do not matter.
constexpr std::size_t kBlockRuns = 1 << 17;

// Codes have at most so many bits; those of lengths of codes fewer.
constexpr int kMostBits = 15;
constexpr int kMostLengthBits = 7;

// The lengths of the codes stand in codes of their own: 0 to 15 as they are,
// and two for many zeros. The lengths of these codes stand in the header in
// this order.
constexpr std::size_t kLengthSymbols = 19;
constexpr std::array<std::uint8_t, kLengthSymbols> kLengthOrder = {
    16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

// The symbol of a match, and the bits that distinguish lengths of one symbol.
struct Match {
  std::uint16_t symbol = 0;
  std::uint8_t extra_bits = 0;
  std::uint8_t extra = 0;
};

constexpr std::array<Match, kLongest + 1> kMatches = [] {
  std::array<Match, kLongest + 1> matches = {};
  std::size_t length = kShortest;
  for (std::size_t symbol = kFirstLength; symbol + 1 < kSymbols; ++symbol) {
    const int group = static_cast<int>(symbol - kFirstLength) / 4;
    const int bits = group < 2 ? 0 : group - 1;
    for (int i = 0; i < (1 << bits); ++i, ++length) {
      matches[length] = {static_cast<std::uint16_t>(symbol),
                         static_cast<std::uint8_t>(bits),
                         static_cast<std::uint8_t>(i)};
    }
  }
  matches[kLongest] = {kSymbols - 1, 0, 0};
  return matches;
}();

// A length of a code in the header, or a number of zeros.
struct LengthWord {
  std::uint8_t symbol = 0;
  int extra_bits = 0;
  std::uint64_t extra = 0;
};

std::vector<LengthWord> words_of(std::span<const std::uint8_t> lengths) {
  std::vector<LengthWord> words;
  for (std::size_t i = 0; i < lengths.size();) {
    std::size_t zeros = 0;
    while (zeros < 138 && i + zeros < lengths.size() &&
           lengths[i + zeros] == 0) {
      ++zeros;
    }
    if (zeros >= 11) {
      words.push_back({18, 7, zeros - 11});
    } else if (zeros >= 3) {
      words.push_back({17, 3, zeros - 3});
    } else {
      words.push_back({lengths[i], 0, 0});
    }
    i += zeros >= 3 ? zeros : 1;
  }
  return words;
}

constexpr std::uint64_t kAdlerModulus = 65521;
// Parts of a run of this many bytes leave the sums below 2^64.
constexpr std::uint64_t kAdlerPart = 1 << 24;

}  // namespace

RunDeflater::RunDeflater() {
  put(0x0178, 16);  // deflate with a window of 32 KiB
}

void RunDeflater::add(std::uint8_t value, std::uint64_t count) {
  if (count == 0) return;
  if (value != value_) {
    end_run();
    value_ = value;
  }
  count_ += count;
}

void RunDeflater::end_run() {
  if (count_ == 0) return;
  for (std::uint64_t left = count_; left > 0;) {
    const std::uint64_t part = std::min(left, kAdlerPart);
    sum_of_sums_ =
        (sum_of_sums_ + part * sum_ + part * (part + 1) / 2 * value_) %
        kAdlerModulus;
    sum_ = (sum_ + part * value_) % kAdlerModulus;
    left -= part;
  }
  runs_.push_back({value_, count_ & ((std::uint64_t{1} << 56) - 1)});
  count_ = 0;
  if (runs_.size() == kBlockRuns) write_block(false);
}

void RunDeflater::write_block(bool is_last) {
  // A run is its byte, the longest matches, and one of what is left, or that
  // many bytes.
  std::array<std::uint64_t, kSymbols> counts = {};
  ++counts[kEnd];
  for (const Run& run : runs_) {
    const std::uint64_t rest = (run.count - 1) % kLongest;
    counts[kSymbols - 1] += (run.count - 1) / kLongest;
    counts[run.value] += rest < kShortest ? 1 + rest : 1;
    if (rest >= kShortest) ++counts[kMatches[rest].symbol];
  }
  std::vector<std::uint8_t> lengths = huffman_lengths(counts, kMostBits);
  const std::vector<HuffmanCode> codes = huffman_codes(lengths);
  lengths.push_back(1);  // of the only distance; its code is 0
  const std::vector<LengthWord> words = words_of(lengths);
  std::array<std::uint64_t, kLengthSymbols> word_counts = {};
  for (const LengthWord& word : words) ++word_counts[word.symbol];
  const auto word_lengths = huffman_lengths(word_counts, kMostLengthBits);
  const std::vector<HuffmanCode> word_codes = huffman_codes(word_lengths);
  put(is_last ? 0b101 : 0b100, 3);  // its own codes
  put(kSymbols - 257, 5);
  put(0, 5);  // one code of distances
  put(kLengthOrder.size() - 4, 4);
  for (const std::uint8_t symbol : kLengthOrder) put(word_lengths[symbol], 3);
  for (const LengthWord& word : words) {
    put(word_codes[word.symbol].bits, word_codes[word.symbol].count);
    put(word.extra, word.extra_bits);
  }
  // As many of the longest matches as fit 32 bits are written at once.
  const HuffmanCode longest = {codes[kSymbols - 1].bits,
                               codes[kSymbols - 1].count + 1};
  const int at_once = 32 / longest.count;
  std::uint64_t many = 0;
  for (int i = 0; i < at_once; ++i) {
    many |= std::uint64_t{longest.bits} << (i * longest.count);
  }
  for (const Run& run : runs_) {
    const HuffmanCode& byte = codes[run.value];
    put(byte.bits, byte.count);
    std::uint64_t matches = (run.count - 1) / kLongest;
    const auto step = static_cast<std::uint64_t>(at_once);
    for (; matches >= step; matches -= step) put(many, at_once * longest.count);
    for (; matches > 0; --matches) put(longest.bits, longest.count);
    std::uint64_t rest = (run.count - 1) % kLongest;
    if (rest >= kShortest) {
      const Match& match = kMatches[rest];
      const HuffmanCode& code = codes[match.symbol];
      put(code.bits | std::uint64_t{match.extra} << code.count,
          code.count + match.extra_bits + 1);
    } else {
      for (; rest > 0; --rest) put(byte.bits, byte.count);
    }
  }
  put(codes[kEnd].bits, codes[kEnd].count);
  runs_.clear();
}

void RunDeflater::put(std::uint64_t bits, int count) {
  bits_ |= bits << bit_count_;
  bit_count_ += count;
  if (bit_count_ < 32) return;
  char word[4];
  for (int i = 0; i < 4; ++i) word[i] = static_cast<char>(bits_ >> (8 * i));
  bytes_.append(word, 4);
  bits_ >>= 32;
  bit_count_ -= 32;
}

std::string RunDeflater::finish() {
  end_run();
  write_block(true);
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
