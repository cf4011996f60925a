#include "cli/make_rule.h"

#include <unordered_set>

namespace lamina::cli {
namespace {

// A blank ends a name for make.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == ' ') text += '\\';
    text += c;
  }
  return text;
}

}  // namespace

std::string make_rule(const std::string& target,
                      std::span<const std::string> files) {
  std::unordered_set<std::string> names;
  for (const std::string& file : files) names.insert(escaped(file));
  std::string rule = (target == "-" ? "<stdout>" : target) + ":";
  for (const std::string& name : names) rule += " \\\n\t" + name;
  return rule + "\n";
}

}  // namespace lamina::cli
