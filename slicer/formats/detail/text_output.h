#pragma once
// Formatted text straight into an output's buffer.

#include <cstddef>
#include <string>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "base/file/output_file.h"

namespace lamina {

// Prints `values`, which must take 512 bytes at most; `format` is compiled
// (FMT_COMPILE).
template <typename Format, typename... Values>
void print(OutputFile& output, const Format& format, const Values&... values) {
  constexpr std::size_t kLongest = 512;
  char* const begin = output.reserve(kLongest);
  const char* const end = fmt::format_to(begin, format, values...);
  output.advance(static_cast<std::size_t>(end - begin));
}

// `value` in 13 characters, as any other, filled up with decimals: for numbers
// that are written over when they are known.
std::string fixed_width(double value);

}  // namespace lamina
