#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/pages/completions.h"

namespace lamina::cli {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') result += '\\';
    result += letter;
  }
  return result + "'";
}

std::string value_of(const OptionPage& option) {
  if (!option.has_value) return "";
  switch (option.completion) {
    case Completion::kWords:
      return fmt::format(" -xa '{}'", fmt::join(option.words, " "));
    case Completion::kFile:
      return " -rF";
    case Completion::kNothing:
      return " -x";
  }
  return "";
}

std::string line_of(const CommandPage& page, const OptionPage& option) {
  std::string text = fmt::format("complete -c lamina -n '__lamina_is {}'",
                                 page.name.empty() ? "slice" : page.name);
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2)
                                   : " -s " + name.substr(1);
  }
  text += value_of(option);
  return text + fmt::format(" -d {}\n", quoted(option.text));
}

}  // namespace

std::string fish_completion(std::span<const CommandPage> pages) {
  std::string lines;
  std::vector<std::string> names;
  for (const CommandPage& page : pages) {
    if (!page.name.empty()) {
      names.push_back(page.name);
      lines +=
          fmt::format("complete -c lamina -n '__lamina_is_first' -a {} -d {}\n",
                      page.name, quoted(page.text));
    }
    lines += fmt::format(
        "complete -c lamina -n '__lamina_is {}' -a "
        "'(__lamina_files {})'\n",
        page.name.empty() ? "slice" : page.name,
        fmt::join(page.extensions, " "));
    for (const OptionPage& option : page.options) {
      lines += line_of(page, option);
    }
  }
  return fmt::format(
      R"(# Completion of lamina's command line by fish. Made by lamina_pages.

function __lamina_is_first
    test (count (commandline -opc)) -eq 1
end

# Whether the words so far are those of this command.
function __lamina_is
    set -l words (commandline -opc)
    if set -q words[2]; and contains -- $words[2] {}
        test $words[2] = $argv[1]
    else
        test $argv[1] = slice
    end
end

# Files of these extensions, and folders.
function __lamina_files
    set -l extensions (string join '|' -- $argv)
    __fish_complete_path (commandline -ct) |
        string match -er -- "(?:/|\\.(?:$extensions))\\t"
end

complete -c lamina -f
{})",
      fmt::join(names, " "), lines);
}

}  // namespace lamina::cli
