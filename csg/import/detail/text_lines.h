#pragma once
// Reads text formats line by line and word by word, without copies.

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/text.h"

namespace lamina::csg {

// Takes the first word off `text`; empty at the end.
inline std::string_view take_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

// The whole word as a number; "nan" and "inf" are numbers here.
template <typename Number>
std::optional<Number> to_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  Number number{};
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

class TextLines {
 public:
  // Lines end with LF or CRLF; in a text without any LF with CR, as on old
  // Macintoshes.
  explicit TextLines(std::string_view text)
      : rest_(text),
        end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {}

  // The next line, trimmed; nothing at the end.
  std::optional<std::string_view> next() {
    if (rest_.data() == nullptr || is_done_) return std::nullopt;
    ++number_;
    const std::size_t end = rest_.find(end_);
    const std::string_view line = rest_.substr(0, end);
    is_done_ = end == std::string_view::npos;
    if (!is_done_) rest_.remove_prefix(end + 1);
    return trim(line);
  }

  // Whether next() gave the last line.
  bool is_done() const { return is_done_; }

  // Number of the line that next() gave, from 1.
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  char end_;
  std::size_t number_ = 0;
  bool is_done_ = false;
};

}  // namespace lamina::csg
