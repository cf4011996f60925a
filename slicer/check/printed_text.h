#pragma once
// Texts that grow line by line, such as those of inspect and compare.

#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace lamina::slicer {

// For writers to derive from.
class PrintedText {
 protected:
  template <typename... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format,
                   std::forward<Values>(values)...);
  }

  std::string text_;
};

}  // namespace lamina::slicer
