#include "compiler/make_rule.h"

#include <algorithm>
#include <string_view>
#include <unordered_set>

#include <fmt/format.h>

#include "base/diagnostic.h"

namespace lamina::compiler {
namespace {

// What a backslash makes part of a name: ends of names, comments, colons, and
// patterns of either side.
constexpr std::string_view kMarkedInTarget = " #:%";
constexpr std::string_view kMarkedInFile = " #:|*?[";

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

// Nothing hides a ';' from make, a '~' in front that stands for a user's
// folder, a backslash or a blank before the end of a line, nor a ')' that ends
// the member of an archive, which may begin in a name before.
void require_name(const std::string& path) {
  constexpr std::string_view kUnhiddenEnds = "\\ )";
  const bool is_fine =
      std::none_of(path.begin(), path.end(), is_control) &&
      path.find(';') == std::string::npos && !path.starts_with('~') &&
      (path.empty() || kUnhiddenEnds.find(path.back()) == std::string::npos);
  if (is_fine) return;
  std::string shown = path;
  std::replace_if(shown.begin(), shown.end(), is_control, '?');
  throw FileError(
      fmt::format("Can't write a rule for make (-d): it cannot hold the name "
                  "'{}'",
                  shown));
}

std::string escaped(const std::string& path, std::string_view marked) {
  require_name(path);
  std::string text;
  for (const char c : path) {
    if (c == '$') {
      text += "$$";
    } else if (c == '=') {
      text += "$(or =)";  // else the rule could be read as that of a variable
    } else {
      if (marked.find(c) != std::string_view::npos) {
        // Backslashes are themselves but in front of these.
        const std::size_t end = text.find_last_not_of('\\') + 1;
        text.append(text.size() - end + 1, '\\');
      }
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string make_rule(const std::string& target,
                      std::span<const std::string> files) {
  std::unordered_set<std::string> names;
  for (const std::string& file : files) {
    names.insert(escaped(file, kMarkedInFile));
  }
  std::string rule =
      target == "-" ? "<stdout>" : escaped(target, kMarkedInTarget);
  // "&:" would stand behind grouped targets.
  rule += rule.ends_with('&') ? " :" : ":";
  for (const std::string& name : names) rule += " \\\n\t" + name;
  return rule + "\n";
}

}  // namespace lamina::compiler
