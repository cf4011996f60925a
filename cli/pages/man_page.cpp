#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/version.h"
#include "cli/pages/command_pages.h"

namespace lamina::cli {
namespace {

// Text as troff prints it: dashes that can be copied, and no requests.
std::string escaped(std::string_view text) {
  std::string result(text);
  replace(result, "\\", "\\e");
  replace(result, "-", "\\-");
  replace(result, "'", "\\(aq");
  replace(result, "^", "\\(ha");
  replace(result, "~", "\\(ti");
  return text.starts_with('.') || text.starts_with('\'') ? "\\&" + result
                                                         : result;
}

// Names in bold, values in italics.
std::string head_of(const HelpEntry& entry) {
  std::string text;
  for (const NamedValue& option : entry.options) {
    if (!text.empty())
      text += entry.head.find(',') < entry.head.size() ? ", " : " ";
    text += fmt::format("\\fB{}\\fR", escaped(option.name));
    if (!option.value.empty()) {
      text += fmt::format(" \\fI{}\\fR", escaped(option.value));
    }
  }
  return text;
}

// Lines that are indented further are a table, which keeps its shape.
std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  bool is_table = false;
  for (const std::string& line : lines) {
    const bool is_row = line.starts_with(' ');
    if (is_row != is_table) text += is_row ? ".EX\n" : ".EE\n";
    is_table = is_row;
    text += escaped(line) + "\n";
  }
  return text + (is_table ? ".EE\n" : "");
}

std::string entries_of(const HelpBlock& block) {
  std::string text;
  for (const HelpEntry& entry : block.entries) {
    text += fmt::format(".TP\n{}\n{}", head_of(entry), text_of(entry.text));
  }
  return text;
}

// "  lamina inspect FILE.slc [OPTION]...     check a layer file"
std::string synopsis_of(const std::vector<HelpBlock>& help) {
  std::string text;
  for (const std::string& line : lines_below(help, "Usage")) {
    if (!line.starts_with("  lamina ")) continue;
    const std::string usage = line.substr(9, line.find("  ", 9) - 9);
    text += fmt::format("{}.B lamina\n{}\n", text.empty() ? "" : ".br\n",
                        escaped(usage));
  }
  return text;
}

std::string options_of(const CommandPage& page) {
  std::string text;
  for (const HelpBlock& block : page.help) {
    if (block.entries.empty()) continue;
    text += fmt::format(".SS \"{}\"\n{}", escaped(block.heading),
                        entries_of(block));
  }
  return text;
}

// "Usage: lamina compare A B", and further ways set in below it.
bool is_usage(const HelpBlock& block) {
  return !block.lines.empty() && block.lines.front().starts_with("Usage: ");
}

std::string usage_of(const HelpBlock& block) {
  std::string text;
  for (const std::string& line : block.lines) {
    text += fmt::format(
        "{}.B {}\n", text.empty() ? "" : ".br\n",
        escaped(line.substr(std::min(line.find("lamina"), line.size()))));
  }
  return text;
}

std::string section_of(const CommandPage& page) {
  std::string text = fmt::format(".SS lamina {}\n", page.name);
  for (const HelpBlock& block : page.help) {
    if (is_usage(block)) {
      text += usage_of(block);
      continue;
    }
    if (!block.heading.empty()) {
      text += fmt::format(".PP\n{}:\n", escaped(block.heading));
    }
    if (!block.lines.empty()) text += ".PP\n" + text_of(block.lines);
    text += entries_of(block);
  }
  return text;
}

}  // namespace

std::string man_page(std::span<const CommandPage> pages, std::string frame) {
  std::string commands;
  for (const CommandPage& page : pages) {
    if (!page.name.empty()) commands += section_of(page);
  }
  replace(frame, "@VERSION@", version());
  replace(frame, "@SYNOPSIS@\n", synopsis_of(pages.front().help));
  replace(frame, "@OPTIONS@\n", options_of(pages.front()));
  replace(frame, "@COMMANDS@\n", commands);
  replace(frame, "@EXAMPLES@\n",
          text_of(lines_below(pages.front().help, "Examples")));
  return frame;
}

}  // namespace lamina::cli
