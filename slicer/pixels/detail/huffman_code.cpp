#include "slicer/pixels/detail/huffman_code.h"

#include <algorithm>
#include <cstddef>

namespace lamina::slicer {
namespace {

struct Node {
  std::uint64_t count = 0;
  std::size_t parent = 0;
};

// The lengths without a limit. Two queues, as by van Leeuwen 1976: symbols in
// ascending order of their counts, and the trees that were made of the two
// least ones, which come in ascending order, too.
std::vector<int> free_lengths(const std::vector<std::uint64_t>& sorted) {
  const std::size_t symbols = sorted.size();
  std::vector<Node> nodes(2 * symbols - 1);
  for (std::size_t i = 0; i < symbols; ++i) nodes[i].count = sorted[i];
  std::size_t symbol = 0;
  std::size_t tree = symbols;
  for (std::size_t next = symbols; next < nodes.size(); ++next) {
    for (int i = 0; i < 2; ++i) {
      const bool takes_symbol =
          tree == next ||
          (symbol < symbols && nodes[symbol].count <= nodes[tree].count);
      const std::size_t least = takes_symbol ? symbol++ : tree++;
      nodes[next].count += nodes[least].count;
      nodes[least].parent = next;
    }
  }
  std::vector<int> depths(nodes.size(), 0);
  for (std::size_t i = nodes.size() - 1; i-- > 0;) {
    depths[i] = depths[nodes[i].parent] + 1;
  }
  depths.resize(symbols);
  return depths;
}

}  // namespace

std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint64_t> counts,
                                          int most_bits) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return counts[i]; });
  std::vector<std::uint8_t> lengths(counts.size(), 0);
  if (order.empty()) return lengths;
  std::vector<std::uint64_t> sorted;
  for (const std::size_t i : order) sorted.push_back(counts[i]);
  // Counts that are nearer to each other make a tree that is less deep; equal
  // ones make the least deep one.
  std::vector<int> depths = free_lengths(sorted);
  while (std::ranges::max(depths) > most_bits) {
    for (std::uint64_t& count : sorted) count = (count + 1) / 2;
    depths = free_lengths(sorted);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    lengths[order[i]] = static_cast<std::uint8_t>(std::max(depths[i], 1));
  }
  return lengths;
}

std::vector<HuffmanCode> huffman_codes(std::span<const std::uint8_t> lengths) {
  std::vector<HuffmanCode> codes(lengths.size());
  std::uint32_t next = 0;
  for (int length = 1; length <= 15; ++length) {
    next <<= 1;
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
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

}  // namespace lamina::slicer
