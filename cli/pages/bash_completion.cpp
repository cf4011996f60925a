#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/pages/completions.h"

namespace lamina::cli {
namespace {

// What follows an option: a line of the script.
std::string action_of(const OptionPage& option) {
  switch (option.completion) {
    case Completion::kWords:
      return fmt::format("_lamina_words {}", fmt::join(option.words, " "));
    case Completion::kFile:
      return "_lamina_files";
    case Completion::kNothing:
      return ":";
  }
  return ":";
}

// The cases of all options that take a value, those of one action together.
std::string value_cases(std::span<const CommandPage> pages) {
  std::map<std::string, std::vector<std::string>> patterns;
  for (const CommandPage& page : pages) {
    for (const OptionPage& option : page.options) {
      if (!option.has_value) continue;
      for (const std::string& name : option.names) {
        patterns[action_of(option)].push_back(page.name + ":" + name);
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

std::string option_cases(std::span<const CommandPage> pages) {
  std::string text;
  for (const CommandPage& page : pages) {
    std::vector<std::string> names;
    for (const OptionPage& option : page.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
    }
    text += fmt::format("      \"{}\") _lamina_words {} ;;\n", page.name,
                        fmt::join(names, " "));
  }
  return text;
}

std::string file_cases(std::span<const CommandPage> pages) {
  std::string text;
  for (const CommandPage& page : pages) {
    text += fmt::format("    \"{}\") _lamina_files {} ;;\n", page.name,
                        fmt::join(page.extensions, " "));
  }
  return text;
}

std::vector<std::string> names_of(std::span<const CommandPage> pages) {
  std::vector<std::string> names;
  for (const CommandPage& page : pages) {
    if (!page.name.empty()) names.push_back(page.name);
  }
  return names;
}

}  // namespace

std::string bash_completion(std::span<const CommandPage> pages) {
  const std::vector<std::string> names = names_of(pages);
  return fmt::format(
      R"(# Completion of lamina's command line by bash. Made by lamina_pages.

_lamina_words() {{
  local IFS=$' \t\n'
  COMPREPLY+=($(compgen -W "$*" -- "$cur"))
}}

# Files, of these extensions if there are any, and folders.
_lamina_files() {{
  local IFS=$'\n' extension
  compopt -o filenames
  if [ $# -eq 0 ]; then
    COMPREPLY+=($(compgen -f -- "$cur"))
    return
  fi
  COMPREPLY+=($(compgen -d -- "$cur"))
  for extension; do
    COMPREPLY+=($(compgen -f -X "!*.$extension" -- "$cur"))
  done
}}

_lamina() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD - 1]}}
  # --axis=x are three words to bash.
  if [ "$cur" = = ]; then
    cur=
  elif [ "$prev" = = ]; then
    prev=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  local command=
  if [ "$COMP_CWORD" -gt 1 ]; then
    case ${{COMP_WORDS[1]}} in
      {0}) command=${{COMP_WORDS[1]}} ;;
    esac
  fi
  COMPREPLY=()
  case $command:$prev in
{1}  esac
  if [[ $cur == -* ]]; then
    case $command in
{2}    esac
    return
  fi
  if [ "$COMP_CWORD" -eq 1 ]; then
    _lamina_words {3}
  fi
  case $command in
{4}  esac
}}

complete -F _lamina lamina
)",
      fmt::join(names, " | "), value_cases(pages), option_cases(pages),
      fmt::join(names, " "), file_cases(pages));
}

}  // namespace lamina::cli
