#include "serve/studio/source_text.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/fingerprint.h"
#include "parser/ast_printer.h"
#include "parser/tree_facts.h"

namespace lamina::studio {
namespace {

// Bytes of a text that others replace.
struct Replacement {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::string text;
};

// The text of the file, without what options append to it.
std::string_view file_text(const Source& source) {
  const std::string_view text = source.text();
  return text.substr(0, text.find(kEndOfFile));
}

const ast::Expr& value_of(const ast::Statement& statement) {
  return *std::get<ast::Assignment>(statement.node).value;
}

// Numbers in full: `.ast` has six digits of them.
std::string text_of(const ast::Expr& value) {
  if (const auto number = ast::number_of(value)) {
    return fmt::format("{}", *number);
  }
  if (const auto numbers = ast::numbers_of(value)) {
    return fmt::format("[{}]", fmt::join(*numbers, ", "));
  }
  std::string text;
  ast::append_expression(value, text);
  return text;
}

// In the order of the text.
std::vector<Replacement> replacements(const ast::Program& program,
                                      const ast::Program& changed) {
  const std::size_t end = file_text(*program.source).size();
  std::vector<Replacement> all;
  for (std::size_t i = 0; i < program.statements.size(); ++i) {
    if (program.statements[i] == changed.statements[i]) continue;
    const SourceRange range = value_of(*program.statements[i]).range;
    if (range.source != program.source || range.end > end) continue;
    const std::string before = text_of(value_of(*program.statements[i]));
    const std::string text = text_of(value_of(*changed.statements[i]));
    if (before != text) all.push_back({range.begin, range.end, text});
  }
  std::ranges::sort(all, {}, &Replacement::begin);
  return all;
}

std::string replaced(std::string_view text, const std::vector<Replacement>& all,
                     std::size_t offset) {
  std::string result;
  std::size_t place = 0;
  for (const Replacement& one : all) {
    result += text.substr(place, one.begin - offset - place);
    result += one.text;
    place = one.end - offset;
  }
  return result += text.substr(place);
}

// A text's lines, each behind a sign.
std::string signed_lines(char sign, std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    result += sign;
    result += text.substr(0, end);
    if (text[end - 1] != '\n') result += '\n';
    text.remove_prefix(end);
  }
  return result;
}

// Whole lines around replacements that share lines.
std::string hunk(const Source& source, std::string_view text,
                 const std::vector<Replacement>& all) {
  const std::size_t begin = text.rfind('\n', all.front().begin) + 1;
  const std::size_t end =
      std::min(text.find('\n', all.back().end), text.size());
  const std::string_view lines = text.substr(begin, end - begin);
  const std::string changed = replaced(lines, all, begin);
  const auto count = [](std::string_view some) {
    return 1 + std::ranges::count(some, '\n');
  };
  const std::uint32_t line =
      source.line_column(static_cast<std::uint32_t>(begin)).line;
  return fmt::format("@@ -{0},{1} +{0},{2} @@\n", line, count(lines),
                     count(changed)) +
         signed_lines('-', lines) + signed_lines('+', changed);
}

std::string diff_of(const Source& source, std::string_view text,
                    const std::vector<Replacement>& all) {
  if (all.empty()) return {};
  const std::string name = std::filesystem::path(source.path()).filename();
  std::string diff = fmt::format("--- {0}\n+++ {0}\n", name);
  std::vector<Replacement> together;
  for (const Replacement& one : all) {
    const auto line = [&](std::uint32_t place) {
      return source.line_column(place).line;
    };
    if (!together.empty() && line(together.back().end) != line(one.begin)) {
      diff += hunk(source, text, together);
      together.clear();
    }
    together.push_back(one);
  }
  return diff + hunk(source, text, together);
}

}  // namespace

SourceEdit edit_source(const ast::Program& program, const ParameterSet& values,
                       Language language, Diagnostics& diagnostics) {
  ast::Program changed = program;
  apply_parameter_set(values, changed, language, diagnostics);
  const std::vector<Replacement> all = replacements(program, changed);
  const std::string_view before = file_text(*program.source);
  SourceEdit edit;
  edit.before = before;
  edit.text = replaced(before, all, 0);
  edit.diff = diff_of(*program.source, before, all);
  edit.key = digest(edit.before + edit.text);
  return edit;
}

}  // namespace lamina::studio
