#pragma once
// Options of the command line whose values are checked as they are read. A
// faulty value throws CLI::ValidationError, which names the option.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "compiler/validate.h"
#include "slicer/slice/settings.h"

namespace lamina::cli {

// Throws CLI::ValidationError unless `holds`.
//
// words  a format of fmt
template <typename... Args>
void require(bool holds, const std::string& option,
             fmt::format_string<Args...> words, Args&&... args) {
  if (holds) return;
  throw CLI::ValidationError(option,
                             fmt::format(words, std::forward<Args>(args)...));
}

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

// Adds an option whose text `use` reads, which may throw CLI::ValidationError.
// `value` is what messages call its value.
CLI::Option* add_text(CLI::App& app, const std::string& name,
                      const std::string& value,
                      const std::function<void(const std::string&)>& use);

// Adds an option that sets a number within the limits that it has in
// compiler/validate.h. `value` is what messages call it.
void add_number(CLI::App& app, const std::string& name,
                const std::string& value, double& target);
// The number is a whole one.
void add_count(CLI::App& app, const std::string& name, std::uint32_t& target);

// Adds an option that names something, such as a file; `what` is what messages
// call it. An empty name, as of a variable that is not set, must not mean that
// none was given.
CLI::Option* add_name(CLI::App& app, const std::string& name,
                      const std::string& what, std::string& target);
// The same of names that follow each other.
CLI::Option* add_name(CLI::App& app, const std::string& name,
                      const std::string& what,
                      std::vector<std::string>& targets);

// Lets an option be given more than once, each time with one value.
void make_repeatable(CLI::Option* option);

// Adds an option that takes one of a few words.
void add_choice(CLI::App& app, const std::string& name,
                const std::vector<std::string>& words,
                const std::function<void(const std::string&)>& use);

// Adds an option that takes the words which openscad takes for true and false.
void add_switch(CLI::App& app, const std::string& name, bool& target);

// Adds --layers: which layers are written.
void add_layer_range(CLI::App& app, slicer::LayerNumbers& range);

}  // namespace lamina::cli
