#pragma once
// Texts that grow line by line, such as those of inspect and compare.

#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"

namespace lamina::cli {

// For writers to derive from. Lines end where a format says so, never within a
// value: names and words of files cannot pass for lines of their own.
class PrintedText {
 protected:
  template <typename Value>
  static decltype(auto) on_its_line(const Value& value) {
    if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
      return on_one_line(value);
    } else {
      return (value);
    }
  }

  template <typename... Values>
  void print(fmt::format_string<
                 decltype(on_its_line(std::declval<const Values&>()))...>
                 format,
             const Values&... values) {
    fmt::format_to(std::back_inserter(text_), format, on_its_line(values)...);
  }

  std::string text_;
};

}  // namespace lamina::cli
