#pragma once
// A help text taken apart, so that the manual and the completions of shells say
// what --help says.
//
//   Usage:                              a heading
//     lamina DESIGN [OPTION]...         lines of its block
//
//   Slicing (lengths in millimetres):
//     --layer MM          thickness     an entry: two blanks and a dash;
//                         of a layer    its text two blanks later, or below

#include <string>
#include <string_view>
#include <vector>

namespace lamina::cli {

struct NamedValue {
  std::string name;   // "-o"
  std::string value;  // "FILE"; empty: it takes none
};

struct HelpEntry {
  std::string head;  // "-q, --quiet", "-p FILE -P SET"
  std::vector<NamedValue> options;
  // Blanks at the beginning of a line are those beyond the first line's.
  std::vector<std::string> text;
};

// What stands between empty lines, or below a heading. Lines come before
// entries.
struct HelpBlock {
  std::string heading;  // without its colon; may be empty
  std::vector<std::string> lines;
  std::vector<HelpEntry> entries;
};

std::vector<HelpBlock> read_help(std::string_view help);

// The lines below a heading; none where there is no such heading.
std::vector<std::string> lines_below(const std::vector<HelpBlock>& help,
                                     std::string_view heading);

}  // namespace lamina::cli
