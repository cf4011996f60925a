#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/pages/completions.h"

namespace lamina::cli {
namespace {

// For single quotes, and for what _arguments reads between them.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\'') {
      result += "'\\''";
    } else if (letter == '[' || letter == ']' || letter == ':' ||
               letter == '\\') {
      result += '\\';
      result += letter;
    } else {
      result += letter;
    }
  }
  return result;
}

std::string action_of(const OptionPage& option) {
  switch (option.completion) {
    case Completion::kWords:
      return fmt::format("({})", fmt::join(option.words, " "));
    case Completion::kFile:
      return "_files";
    case Completion::kNothing:
      return " ";
  }
  return " ";
}

// A line for each name of an option.
std::string specifications(const OptionPage& option) {
  std::string text;
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    std::string spec = option.may_repeat
                           ? "*"
                           : fmt::format("({})", fmt::join(option.names, " "));
    spec += name;
    if (option.has_value) spec += is_long ? "=" : "+";
    spec += fmt::format("[{}]", escaped(option.text));
    if (option.has_value) {
      const std::string& value = option.value;
      spec += fmt::format(":{}:{}", value.empty() ? "value" : escaped(value),
                          action_of(option));
    }
    text += fmt::format("    '{}' \\\n", spec);
  }
  return text;
}

std::string files_of(const CommandPage& page) {
  // Alone in brackets, zsh would take it for qualifiers.
  if (page.extensions.size() == 1) {
    return fmt::format("_files -g \"*.{}\"", page.extensions.front());
  }
  return fmt::format("_files -g \"*.({})\"", fmt::join(page.extensions, "|"));
}

std::string function_of(const CommandPage& page) {
  std::string text = fmt::format("_lamina_{}() {{\n  _arguments -s \\\n",
                                 page.name.empty() ? "slice" : page.name);
  for (const OptionPage& option : page.options) text += specifications(option);
  return text + (page.name.empty()
                     ? "    '*: :_lamina_first'\n}\n\n"
                     : fmt::format("    '*:file:{}'\n}}\n\n", files_of(page)));
}

}  // namespace

std::string zsh_completion(std::span<const CommandPage> pages) {
  std::string functions;
  std::vector<std::string> names;
  std::vector<std::string> commands;
  for (const CommandPage& page : pages) {
    functions += function_of(page);
    if (page.name.empty()) continue;
    names.push_back(page.name);
    commands.push_back(fmt::format("'{}:{}'", page.name, escaped(page.text)));
  }
  return fmt::format(R"(#compdef lamina
# Completion of lamina's command line by zsh. Made by lamina_pages.

# The word that no option takes: a command, if it is the first, or a design.
_lamina_first() {{
  if (( CURRENT == 2 )); then
    local -a commands=({0})
    _describe command commands
  fi
  {1}
}}

{2}_lamina() {{
  if (( CURRENT > 2 )) && [[ $words[2] == ({3}) ]]; then
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    _lamina_$command
  else
    _lamina_slice
  fi
}}

_lamina "$@"
)",
                     fmt::join(commands, " "), files_of(pages.front()),
                     functions, fmt::join(names, "|"));
}

}  // namespace lamina::cli
