#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/pages/command_pages.h"

namespace lamina::cli {
namespace {

// The words that begin a command line, joined.
std::string commands(std::span<const CommandPage> pages,
                     std::string_view separator) {
  std::vector<std::string> names;
  for (const CommandPage& page : pages) {
    if (!page.name.empty()) names.push_back(page.name);
  }
  return fmt::format("{}", fmt::join(names, separator));
}

// Slicing has no word of its own, its functions in scripts have one.
std::string name_of(const CommandPage& page) {
  return page.name.empty() ? "slice" : page.name;
}

std::string escaped(const std::string& text, std::string_view marked) {
  std::string result;
  for (const char letter : text) {
    if (marked.find(letter) != std::string_view::npos) result += '\\';
    result += letter;
  }
  return result;
}

// --- bash -------------------------------------------------------------------

// What follows an option: a line of the script.
std::string bash_action(const OptionPage& option) {
  if (!option.words.empty()) {
    return fmt::format("_lamina_words {}", fmt::join(option.words, " "));
  }
  return option.is_file ? "_lamina_files" : ":";
}

// The cases of all options that take a value, those of one action together.
std::string bash_values(std::span<const CommandPage> pages) {
  std::map<std::string, std::vector<std::string>> patterns;
  for (const CommandPage& page : pages) {
    for (const OptionPage& option : page.options) {
      if (!option.has_value) continue;
      for (const std::string& name : option.names) {
        patterns[bash_action(option)].push_back(page.name + ":" + name);
      }
    }
  }
  std::string text;
  for (const auto& [action, names] : patterns) {
    text += fmt::format("    {})\n      {}; return ;;\n",
                        fmt::join(names, " | "), action);
  }
  return text;
}

// --- zsh --------------------------------------------------------------------

// For single quotes, and for what _arguments reads between them.
std::string zsh_escaped(const std::string& text) {
  std::string result = escaped(text, "[]:\\");
  replace(result, "'", "'\\''");
  return result;
}

std::string zsh_action(const OptionPage& option) {
  if (!option.words.empty()) {
    return fmt::format("({})", fmt::join(option.words, " "));
  }
  return option.is_file ? "_files" : " ";
}

// A line for each name of an option.
std::string zsh_specifications(const OptionPage& option) {
  std::string text;
  for (const std::string& name : option.names) {
    std::string spec = option.may_repeat
                           ? "*"
                           : fmt::format("({})", fmt::join(option.names, " "));
    spec += name;
    if (option.has_value) spec += name.starts_with("--") ? "=" : "+";
    spec += fmt::format("[{}]", zsh_escaped(option.text));
    if (option.has_value) {
      spec += fmt::format(
          ":{}:{}", option.value.empty() ? "value" : zsh_escaped(option.value),
          zsh_action(option));
    }
    text += fmt::format("    '{}' \\\n", spec);
  }
  return text;
}

std::string zsh_files(const CommandPage& page) {
  // Alone in brackets, zsh would take it for qualifiers.
  if (page.extensions.size() == 1) {
    return fmt::format("_files -g \"*.{}\"", page.extensions.front());
  }
  return fmt::format("_files -g \"*.({})\"", fmt::join(page.extensions, "|"));
}

std::string zsh_function(const CommandPage& page) {
  std::string text =
      fmt::format("_lamina_{}() {{\n  _arguments -s \\\n", name_of(page));
  for (const OptionPage& option : page.options) {
    text += zsh_specifications(option);
  }
  return text + (page.name.empty()
                     ? "    '*: :_lamina_first'\n}\n\n"
                     : fmt::format("    '*:file:{}'\n}}\n\n", zsh_files(page)));
}

// --- fish -------------------------------------------------------------------

std::string fish_quoted(const std::string& text) {
  return fmt::format("'{}'", escaped(text, "'\\"));
}

std::string fish_value(const OptionPage& option) {
  if (!option.has_value) return "";
  if (!option.words.empty()) {
    return fmt::format(" -xa '{}'", fmt::join(option.words, " "));
  }
  return option.is_file ? " -rF" : " -x";
}

std::string fish_line(const CommandPage& page, const OptionPage& option) {
  std::string text =
      fmt::format("complete -c lamina -n '__lamina_is {}'", name_of(page));
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2)
                                   : " -s " + name.substr(1);
  }
  return text + fmt::format("{} -d {}\n", fish_value(option),
                            fish_quoted(option.text));
}

}  // namespace

std::string bash_completion(std::span<const CommandPage> pages,
                            std::string frame) {
  std::string options;
  std::string files;
  for (const CommandPage& page : pages) {
    std::vector<std::string> names;
    for (const OptionPage& option : page.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
    }
    options += fmt::format("      \"{}\") _lamina_words {} ;;\n", page.name,
                           fmt::join(names, " "));
    files += fmt::format("    \"{}\") _lamina_files {} ;;\n", page.name,
                         fmt::join(page.extensions, " "));
  }
  replace(frame, "@COMMAND_PATTERN@", commands(pages, " | "));
  replace(frame, "@COMMANDS@", commands(pages, " "));
  replace(frame, "@VALUES@", bash_values(pages));
  replace(frame, "@OPTIONS@", options);
  replace(frame, "@FILES@", files);
  return frame;
}

std::string zsh_completion(std::span<const CommandPage> pages,
                           std::string frame) {
  std::string functions;
  std::vector<std::string> described;
  for (const CommandPage& page : pages) {
    functions += zsh_function(page);
    if (page.name.empty()) continue;
    described.push_back(
        fmt::format("'{}:{}'", page.name, zsh_escaped(page.text)));
  }
  replace(frame, "@COMMAND_PATTERN@", commands(pages, "|"));
  replace(frame, "@COMMANDS@", fmt::format("{}", fmt::join(described, " ")));
  replace(frame, "@FILES@", zsh_files(pages.front()));
  replace(frame, "@FUNCTIONS@", functions);
  return frame;
}

std::string fish_completion(std::span<const CommandPage> pages,
                            std::string frame) {
  std::string lines;
  for (const CommandPage& page : pages) {
    if (!page.name.empty()) {
      lines +=
          fmt::format("complete -c lamina -n '__lamina_is_first' -a {} -d {}\n",
                      page.name, fish_quoted(page.text));
    }
    lines += fmt::format(
        "complete -c lamina -n '__lamina_is {}' -a '(__lamina_files {})'\n",
        name_of(page), fmt::join(page.extensions, " "));
    for (const OptionPage& option : page.options) {
      lines += fish_line(page, option);
    }
  }
  replace(frame, "@COMMANDS@", commands(pages, " "));
  replace(frame, "@LINES@\n", lines);
  return frame;
}

}  // namespace lamina::cli
