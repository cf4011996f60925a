#include "cli/options/option_values.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>

#include "base/text.h"

namespace lamina::cli {
void require_page_or_json(std::string_view writer, std::string_view file) {
  compiler::refuse_if(
      !file.empty() && !file.ends_with(".html") && !file.ends_with(".json"),
      "{} writes .html or .json; '{}' is neither", writer, file);
}

double require_number(const std::string& option, std::string_view text) {
  const std::optional<double> value = parse_number(text);
  require(value.has_value(), option,
          "a number was expected, such as 0.05, without a unit, not '{}'",
          text);
  return *value;
}

std::vector<double> require_numbers(const std::string& option,
                                    std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = text.find(',');
    numbers.push_back(require_number(option, text.substr(0, comma)));
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

double require_within(const compiler::NumberLimits& limits,
                      std::string_view text) {
  const std::string option(limits.option);
  const double value = require_number(option, text);
  require(limits.hold(value), option, "{}", limits.fault_of(text));
  return value;
}

double require_within(const std::string& option, std::string_view text) {
  return require_within(compiler::limits_of(option), text);
}

slicer::LayerNumbers parse_layers(const std::string& text) {
  const auto number = [&](std::string_view word, std::uint32_t otherwise) {
    if (word.empty()) return otherwise;
    std::uint32_t value = 0;
    const auto [end, fault] =
        std::from_chars(word.data(), word.data() + word.size(), value);
    require(
        fault == std::errc() && end == word.data() + word.size() && value > 0,
        "--layers",
        "layers from 1 were expected, such as 3:7, 3: or :7, not '{}'", text);
    return value;
  };
  const std::string_view all = text;
  const std::size_t colon = all.find(':');
  slicer::LayerNumbers range;
  range.first = number(all.substr(0, colon), range.first);
  range.last = colon == std::string_view::npos
                   ? range.first
                   : number(all.substr(colon + 1), range.last);
  require(!all.empty() && range.first <= range.last, "--layers",
          "'{}' has no layers", text);
  return range;
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end) return std::nullopt;
  return number;
}

}  // namespace lamina::cli
