#include "csg/eval/value/lookup_tables.h"

#include <algorithm>
#include <cmath>

namespace lamina::csg {
namespace {

// Shorter tables are read faster than they are found again.
constexpr std::size_t kLongTable = 64;
constexpr std::size_t kMostKnown = 8;

}  // namespace

std::optional<LookupTables::Pair> LookupTables::pair_of(const Value& row) {
  const std::span<const Value> pair = row.elements();
  if (pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) {
    return std::nullopt;
  }
  return Pair{pair[0].as_number(), pair[1].as_number()};
}

LookupTables::Neighbours LookupTables::read_all(Pair first,
                                                std::span<const Value> rows,
                                                double key) {
  Neighbours found{first, first};
  for (const Value& row : rows.subspan(1)) {
    const std::optional<Pair> pair = pair_of(row);
    if (!pair) continue;
    if (pair->key <= key &&
        (pair->key > found.low.key || found.low.key > key)) {
      found.low = *pair;
    }
    if (pair->key >= key &&
        (pair->key < found.high.key || found.high.key < key)) {
      found.high = *pair;
    }
  }
  return found;
}

std::vector<LookupTables::Pair> LookupTables::sort(
    std::span<const Value> rows) {
  std::vector<Pair> pairs;
  for (const Value& row : rows) {
    const std::optional<Pair> pair = pair_of(row);
    if (pair && !std::isnan(pair->key)) pairs.push_back(*pair);
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.key < b.key; });
  pairs.erase(
      std::unique(pairs.begin(), pairs.end(),
                  [](const Pair& a, const Pair& b) { return a.key == b.key; }),
      pairs.end());
  return pairs;
}

LookupTables::Neighbours LookupTables::search(Pair first,
                                              std::span<const Pair> sorted,
                                              double key) {
  const auto high = std::lower_bound(
      sorted.begin(), sorted.end(), key,
      [](const Pair& pair, double asked) { return pair.key < asked; });
  const bool is_hit = high != sorted.end() && high->key == key;
  Neighbours found{first, first};
  if (high != sorted.end()) found.high = *high;
  if (is_hit) {
    found.low = *high;
  } else if (high != sorted.begin()) {
    found.low = *(high - 1);
  }
  return found;
}

LookupTables::Neighbours LookupTables::neighbours(const Value& table,
                                                  Pair first, double key) {
  const std::span<const Value> rows = table.as_vector();
  // No comparison with a first key that is not a number ever holds.
  if (rows.size() < kLongTable || std::isnan(first.key)) {
    return read_all(first, rows, key);
  }
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const Known& other) {
        const std::span<const Value> others = other.table.as_vector();
        return others.data() == rows.data() && others.size() == rows.size();
      });
  if (known == known_.end()) {
    if (known_.size() == kMostKnown) known_.pop_back();
    known_.insert(known_.begin(), Known{table, {}});
    return read_all(first, rows, key);
  }
  std::rotate(known_.begin(), known, known + 1);
  std::vector<Pair>& sorted = known_.front().sorted;
  if (sorted.empty()) sorted = sort(rows);
  return search(first, sorted, key);
}

std::optional<double> LookupTables::find(const Value& table, double key) {
  const std::span<const Value> rows = table.as_vector();
  const std::optional<Pair> first =
      rows.empty() ? std::nullopt : pair_of(rows.front());
  if (!first) return std::nullopt;
  const auto [low, high] = neighbours(table, *first, key);
  if (key <= low.key) return high.value;
  if (key >= high.key) return low.value;
  const double f = (key - low.key) / (high.key - low.key);
  return high.value * f + low.value * (1 - f);
}

}  // namespace lamina::csg
