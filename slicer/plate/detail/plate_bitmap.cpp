#include "slicer/plate/detail/plate_bitmap.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace lamina::slicer {
namespace {

constexpr std::int32_t kBits = 64;

// The bits of word `word` that belong to cells [begin, end).
std::uint64_t mask_of(std::int32_t word, std::int32_t begin, std::int32_t end) {
  std::uint64_t mask = ~std::uint64_t{0};
  const std::int32_t low = word * kBits;
  if (begin > low) mask <<= begin - low;
  if (end < low + kBits) mask &= ~std::uint64_t{0} >> (low + kBits - end);
  return mask;
}

// Columns beside each other meet the same pieces. So the next one to try is
// about 0.38 of the width away, which reaches all columns and spreads them
// evenly.
std::int32_t stride_of(std::int32_t count) {
  std::int32_t stride = std::max(1, static_cast<std::int32_t>(0.382 * count));
  while (std::gcd(stride, count) > 1) ++stride;
  return stride;
}

}  // namespace

PlateBitmap::PlateBitmap(std::int32_t columns, std::int32_t rows)
    // One word more ends every run of taken cells.
    : words_per_column_(static_cast<std::size_t>(rows / kBits + 2)),
      words_(static_cast<std::size_t>(columns) * words_per_column_) {}

std::int32_t PlateBitmap::blocked_until(std::int32_t column, std::int32_t begin,
                                        std::int32_t end) const {
  const std::uint64_t* words =
      &words_[static_cast<std::size_t>(column) * words_per_column_];
  std::int32_t word = (end - 1) / kBits;
  for (; word >= begin / kBits; --word) {
    const std::uint64_t met = words[word] & mask_of(word, begin, end);
    if (met == 0) continue;
    const std::int32_t highest = kBits - 1 - std::countl_zero(met);
    // Go up from the highest cell that both have.
    std::uint64_t free = ~words[word] & ~((std::uint64_t{2} << highest) - 1);
    while (free == 0) free = ~words[++word];
    return word * kBits + std::countr_zero(free);
  }
  return -1;
}

std::int32_t PlateBitmap::next_row(const CellShape& shape, std::int32_t i,
                                   CellPlace place) const {
  for (const CellRun& run : shape.column(i)) {
    const std::int32_t until = blocked_until(
        place.column + i, place.row + run.begin, place.row + run.end);
    if (until >= 0) return until - run.begin;
  }
  return -1;
}

std::optional<CellPlace> PlateBitmap::find_place(const CellShape& shape,
                                                 std::int32_t first_column,
                                                 CellPlace last) const {
  const std::int32_t count = shape.column_count();
  const std::int32_t stride = stride_of(count);
  std::int32_t tried = 0;  // begin with the column that met something before
  CellPlace place;
  for (place.column = first_column; place.column <= last.column;
       ++place.column) {
    place.row = 0;
    std::int32_t free_columns = 0;
    while (place.row <= last.row && free_columns < count) {
      const std::int32_t next = next_row(shape, tried, place);
      if (next < 0) {
        ++free_columns;
        tried = (tried + stride) % count;
      } else {
        place.row = next;
        free_columns = 0;
      }
    }
    if (place.row <= last.row) return place;
  }
  return std::nullopt;
}

void PlateBitmap::add(const CellShape& shape, CellPlace place) {
  for (std::int32_t i = 0; i < shape.column_count(); ++i) {
    std::uint64_t* words =
        &words_[static_cast<std::size_t>(place.column + i) * words_per_column_];
    for (const CellRun& run : shape.column(i)) {
      const std::int32_t begin = place.row + run.begin;
      const std::int32_t end = place.row + run.end;
      for (std::int32_t word = begin / kBits; word <= (end - 1) / kBits;
           ++word) {
        words[word] |= mask_of(word, begin, end);
      }
    }
  }
}

}  // namespace lamina::slicer
