#pragma once
// Every command with its options: what the reader of options knows of them
// joined with what the help says; and the pages made from that: the manual, and
// the completions of the three usual shells.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/pages/help_text.h"

namespace lamina::cli {

struct OptionPage {
  std::vector<std::string> names;  // "-q", "--quiet"
  std::string text;                // of the help, in one line
  bool has_value = false;
  bool may_repeat = false;
  std::string value;               // what the help calls it: "MM"
  std::vector<std::string> words;  // those that it can be; empty: any text
  bool is_file = false;
};

struct CommandPage {
  std::string name;  // empty: slicing a design, which has no word of its own
  std::string text;  // in a few words
  // Extensions of the files that it takes, without dots.
  std::vector<std::string> extensions;
  std::vector<OptionPage> options;
  std::vector<HelpBlock> help;
};

// All commands, slicing first. An option that neither the help of its command
// nor that of slicing has an entry for has no text.
std::vector<CommandPage> command_pages();

// Each of these fills a frame, which holds what no option changes:
// docs/man/lamina.1.in, or cli/pages/*.in.
std::string man_page(std::span<const CommandPage> pages, std::string frame);
// Commands, options, the words that options take, files by their extensions.
std::string bash_completion(std::span<const CommandPage> pages,
                            std::string frame);
std::string zsh_completion(std::span<const CommandPage> pages,
                           std::string frame);
std::string fish_completion(std::span<const CommandPage> pages,
                            std::string frame);

// Replaces every `mark` in a frame by `content`.
void replace(std::string& frame, std::string_view mark,
             std::string_view content);

}  // namespace lamina::cli
