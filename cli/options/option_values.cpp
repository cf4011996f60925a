#include "cli/options/option_values.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <system_error>

#include "base/text.h"

namespace lamina::cli {
namespace {

// "3:7", "3:", ":7" or "3".
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

// Lets the option have no empty value.
CLI::Option* refuse_empty(CLI::Option* option, const std::string& what) {
  option->type_name(what);
  return option->check([what](const std::string& text) {
    return text.empty() ? fmt::format("a {} was expected, not ''", what) : "";
  });
}

}  // namespace

double require_number(const std::string& option, std::string_view text) {
  const std::optional<double> value = parse_number(text);
  require(value.has_value(), option, "a number was expected, not '{}'", text);
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

CLI::Option* add_text(CLI::App& app, const std::string& name,
                      const std::string& value,
                      const std::function<void(const std::string&)>& use) {
  return app.add_option_function<std::string>(name, use)->type_name(value);
}

void add_number(CLI::App& app, const std::string& name,
                const std::string& value, double& target) {
  const std::string option = name.substr(0, name.find(','));
  add_text(app, name, value, [option, &target](const std::string& text) {
    target = require_within(option, text);
  });
}

void add_count(CLI::App& app, const std::string& name, std::uint32_t& target) {
  add_text(app, name, "number", [name, &target](const std::string& text) {
    const double count = require_within(name, text);
    require(count == std::floor(count), name,
            "a whole number was expected, not '{}'", text);
    target = static_cast<std::uint32_t>(count);
  });
}

CLI::Option* add_name(CLI::App& app, const std::string& name,
                      const std::string& what, std::string& target) {
  return refuse_empty(app.add_option(name, target), what);
}

CLI::Option* add_name(CLI::App& app, const std::string& name,
                      const std::string& what,
                      std::vector<std::string>& targets) {
  return refuse_empty(app.add_option(name, targets), what);
}

void make_repeatable(CLI::Option* option) {
  option->expected(1)->allow_extra_args(false)->multi_option_policy(
      CLI::MultiOptionPolicy::TakeAll);
}

void add_choice(CLI::App& app, const std::string& name,
                const std::vector<std::string>& words,
                const std::function<void(const std::string&)>& use) {
  add_text(app, name, "word", use)->check(CLI::IsMember(words));
}

void add_switch(CLI::App& app, const std::string& name, bool& target) {
  const std::vector<std::string> words = {"true", "false", "on",
                                          "off",  "1",     "0"};
  add_text(app, name, "word", [&target](const std::string& word) {
    target = word == "true" || word == "on" || word == "1";
  })->transform(CLI::IsMember(words, CLI::ignore_case));
}

void add_layer_range(CLI::App& app, slicer::LayerNumbers& range) {
  add_text(app, "--layers", "range",
           [&range](const std::string& text) { range = parse_layers(text); });
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end) return std::nullopt;
  return number;
}

}  // namespace lamina::cli
