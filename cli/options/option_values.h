#pragma once
// What the values of options mean. A faulty one throws RequestError, which
// names the option.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "compiler/validate.h"
#include "slicer/slice/settings.h"

namespace lamina::cli {

// words  a format of fmt
template <typename... Args>
void require(bool holds, const std::string& option,
             fmt::format_string<Args...> words, Args&&... args) {
  if (holds) return;
  throw compiler::RequestError(fmt::format(
      "{}: {}", option, fmt::format(words, std::forward<Args>(args)...)));
}

// The file, if one is named, is a page or JSON by its extension.
//
// writer  what would write it: an option or a command
void require_page_or_json(std::string_view writer, std::string_view file);

// A finite number and nothing else.
double require_number(const std::string& option, std::string_view text);

// Numbers with commas between them.
std::vector<double> require_numbers(const std::string& option,
                                    std::string_view text);

// A whole number and nothing else, without a sign; no value for other texts.
std::optional<std::uint64_t> whole_number(std::string_view text);

// A number within these limits, or within those of the option.
double require_within(const compiler::NumberLimits& limits,
                      std::string_view text);
double require_within(const std::string& option, std::string_view text);

// "3:7", "3:", ":7" or "3".
slicer::LayerNumbers parse_layers(const std::string& text);

}  // namespace lamina::cli
