#include "base/similar.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/letter_case.h"

namespace lamina {
namespace {

// Pairs of letters that Guesses compares, at most; a tenth of a second.
constexpr std::size_t kMostGuessWork = 30'000'000;

// The fewest letters to change, add, drop or swap with a neighbour: the
// "optimal string alignment" of Damerau and Levenshtein.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row.assign(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      const bool is_swapped =
          i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

enum class Letter { kNone, kDigit, kOther };

Letter kind_of(char c) {
  if (c >= '0' && c <= '9') return Letter::kDigit;
  const bool is_letter =
      (lower_case(c) >= 'a' && lower_case(c) <= 'z') || (c & 0x80) != 0;
  return is_letter ? Letter::kOther : Letter::kNone;
}

// A text without what separates its words, in small letters.
struct Squeezed {
  std::string letters;
  // Where a word begins, a number too.
  std::vector<bool> is_start;

  explicit Squeezed(std::string_view text) {
    Letter before = Letter::kNone;
    for (const char c : text) {
      const Letter kind = kind_of(c);
      if (kind != Letter::kNone) {
        letters += lower_case(c);
        is_start.push_back(kind != before);
      }
      before = kind;
    }
  }
  bool has(std::string_view word) const {
    std::size_t at = letters.find(word);
    while (at != std::string::npos && !is_start[at]) {
      at = letters.find(word, at + 1);
    }
    return at != std::string::npos;
  }
};

}  // namespace

bool is_same_name(std::string_view a, std::string_view b) {
  return Squeezed(a).letters == Squeezed(b).letters;
}

bool has_words(std::string_view text, std::string_view query) {
  if (Squeezed(query).letters.size() < 2) return false;
  const Squeezed squeezed(text);
  while (!query.empty()) {
    const std::size_t size = static_cast<std::size_t>(
        std::ranges::find(query, Letter::kNone, kind_of) - query.begin());
    if (!squeezed.has(Squeezed(query.substr(0, size)).letters)) return false;
    query.remove_prefix(std::min(size + 1, query.size()));
  }
  return true;
}

std::string_view most_similar(std::string_view name,
                              std::span<const std::string_view> candidates) {
  // Any letter is within one of another.
  const std::size_t most = name.size() < 2 ? 0 : (name.size() + 2) / 3;
  const std::string lower = lower_case(name);
  std::size_t least = most + 1;
  std::string_view best;
  for (const std::string_view candidate : candidates) {
    if (candidate == name) continue;
    const std::size_t gap = candidate.size() > name.size()
                                ? candidate.size() - name.size()
                                : name.size() - candidate.size();
    if (gap > most) continue;
    const std::size_t distance = edit_distance(lower, lower_case(candidate));
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name,
                         std::span<const std::string_view> candidates) {
  const std::string_view similar = most_similar(name, candidates);
  return similar.empty() ? "" : fmt::format("did you mean '{}'?", similar);
}

bool Guesses::are_over() const { return work_ > kMostGuessWork; }

std::string Guesses::did_you_mean(
    std::string_view name, std::span<const std::string_view> candidates) {
  if (are_over()) return "";
  for (const std::string_view candidate : candidates) {
    work_ += name.size() * candidate.size();
  }
  return are_over() ? "" : lamina::did_you_mean(name, candidates);
}

}  // namespace lamina
