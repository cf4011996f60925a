#pragma once
// "Did you mean": the name among others that a misspelt one most likely is, and
// names of which only a part is given.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lamina {

// Empty where none is near: within one letter in three that is wrong, missing,
// too much, or swapped with its neighbour; of a single letter none may. Letter
// case does not count. Of equally near ones the first.
std::string_view most_similar(std::string_view name,
                              std::span<const std::string_view> candidates);

// "did you mean 'sphere'?", empty where none is near.
std::string did_you_mean(std::string_view name,
                         std::span<const std::string_view> candidates);

// Whether two names have the same letters and digits, in any letter case.
bool is_same_name(std::string_view a, std::string_view b);

// Whether each word of a query begins a word of the text, letter case and what
// stands between its words aside: "elegoo-mars-3" has "mars 3", "Mars3" and
// "elegoo", not "ars". A query of less than two letters has no words.
bool has_words(std::string_view text, std::string_view query);

// Guesses for any number of names, in bounded time: the names that come when
// many letters have been compared get no guess. A usual design has 150 names of
// 10 letters, so thousands of names get one.
class Guesses {
 public:
  // Without a guess from now on.
  bool are_over() const;
  std::string did_you_mean(std::string_view name,
                           std::span<const std::string_view> candidates);

 private:
  std::size_t work_ = 0;  // pairs of letters that were to be compared
};

}  // namespace lamina
