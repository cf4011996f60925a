#pragma once
// Numbers in SVG attributes, which need no blanks between them: "1-.5.5e3" are
// three.

#include <cctype>
#include <cstddef>
#include <optional>
#include <string_view>

#include "csg/import/detail/text_lines.h"

namespace lamina::csg {

class SvgNumbers {
 public:
  explicit SvgNumbers(std::string_view text) : rest_(text) {}

  // Passes over blanks and commas; returns the next character, 0 at the end.
  char peek() {
    while (!rest_.empty() &&
           (is_blank(rest_.front()) || rest_.front() == ',')) {
      rest_.remove_prefix(1);
    }
    return rest_.empty() ? '\0' : rest_.front();
  }
  void skip(std::size_t count) { rest_.remove_prefix(count); }
  std::string_view rest() const { return rest_; }

  // Takes the next number; nothing where something else comes next.
  std::optional<double> next() {
    peek();
    const std::size_t length = number_length();
    const auto number = to_number<double>(rest_.substr(0, length));
    if (number) skip(length);
    return number;
  }

  // Takes a flag. It is one character: "00.5" are two flags and .5.
  std::optional<bool> next_flag() {
    const char c = peek();
    if (c != '0' && c != '1') return std::nullopt;
    skip(1);
    return c == '1';
  }

 private:
  std::size_t count_digits(std::size_t from) const {
    std::size_t end = from;
    while (end < rest_.size() &&
           std::isdigit(static_cast<unsigned char>(rest_[end])) != 0) {
      ++end;
    }
    return end - from;
  }
  bool has_at(std::size_t i, std::string_view any) const {
    return i < rest_.size() && any.find(rest_[i]) != std::string_view::npos;
  }

  std::size_t number_length() const {
    std::size_t end = has_at(0, "+-") ? 1 : 0;
    end += count_digits(end);
    if (has_at(end, ".")) end += 1 + count_digits(end + 1);
    if (!has_at(end, "eE")) return end;
    const std::size_t sign = has_at(end + 1, "+-") ? 1 : 0;
    const std::size_t digits = count_digits(end + 1 + sign);
    return digits > 0 ? end + 1 + sign + digits : end;
  }

  std::string_view rest_;
};

}  // namespace lamina::csg
