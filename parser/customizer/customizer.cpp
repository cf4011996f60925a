#include "parser/customizer/customizer.h"

#include <algorithm>
#include <string_view>
#include <variant>

#include "base/text.h"
#include "parser/ast_printer.h"
#include "parser/customizer/detail/customizer_value.h"
#include "parser/tree_facts.h"

namespace lamina {

namespace {

// The comment behind the first statement of a line; empty if a second statement
// follows.
std::string_view find_comment(std::string_view line) {
  bool is_in_string = false;
  int semicolons = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (is_in_string && line.substr(i, 2) == "\\\"") {
      ++i;
      continue;
    }
    if (line[i] == '"') is_in_string = !is_in_string;
    if (is_in_string) continue;
    if (line.substr(i, 2) == "//") return line.substr(i + 2);
    if (line[i] == ';' && semicolons++ > 0) return {};
  }
  return {};
}

// The text of a line that is a comment; further "//" in it become blanks.
std::string read_description(std::string_view line) {
  if (!line.starts_with("//")) return {};
  line.remove_prefix(2);
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  std::string description;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_slashes = line.substr(i, 2) == "//";
    description += is_slashes ? ' ' : line[i];
    if (is_slashes) ++i;
  }
  return description;
}

// "[a] x [b]" names the group "a-b".
std::string read_group(std::string_view comment) {
  std::string name;
  while (true) {
    const std::size_t begin = comment.find('[');
    if (begin == std::string_view::npos) return name;
    const std::size_t end = comment.find(']', begin);
    if (end == std::string_view::npos) return name;
    if (!name.empty()) name += '-';
    name += comment.substr(begin + 1, end - begin - 1);
    comment.remove_prefix(end + 1);
  }
}

}  // namespace

Customizer Customizer::read(const ast::Program& program) {
  Customizer customizer(*program.source);
  customizer.scan();
  return customizer;
}

// Finds the groups and the first '{'. Like OpenSCAD's scan it does not know the
// whole language: a '{' in a string counts.
void Customizer::scan() {
  const std::string& text = source_.text();
  bool is_in_string = false;
  std::uint32_t line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view pair = std::string_view(text).substr(i, 2);
    if (text[i] == '\n') {
      ++line;
    } else if (is_in_string && pair == "\\\"") {
      ++i;
    } else if (text[i] == '"') {
      is_in_string = !is_in_string;
    } else if (!is_in_string && pair == "//") {
      i = std::min(text.find('\n', i), text.size());
      ++line;
    } else if (!is_in_string && pair == "/*") {
      i = skip_comment(i + 2, line);
    } else if (text[i] == '{') {
      break;
    }
  }
  end_line_ = line;
}

// Skips a comment that begins before `place` and returns the place of the '*'
// that ends it. One on a single line is a group.
std::size_t Customizer::skip_comment(std::size_t place, std::uint32_t& line) {
  const std::string& text = source_.text();
  const std::size_t end = std::min(text.find("*/", place), text.size());
  const std::string_view comment =
      std::string_view(text).substr(place, end - place);
  const auto lines = std::count(comment.begin(), comment.end(), '\n');
  line += static_cast<std::uint32_t>(lines);
  if (lines == 0) groups_.push_back({read_group(comment), line});
  return end;
}

bool Customizer::is_parameter(const ast::Statement& assignment) const {
  const SourceRange range = assignment.range;
  const auto& node = std::get<ast::Assignment>(assignment.node);
  return range.source == &source_ && node.value->range.is_known() &&
         ast::is_literal(*node.value) &&
         source_.openscad_line(range.begin) < end_line_;
}

const ast::Expr* Customizer::values_of(const ast::Statement& assignment,
                                       Arena& arena) const {
  const std::uint32_t line = source_.openscad_line(assignment.range.begin);
  const std::string comment(find_comment(source_.line_text(line)));
  return detail::read_customizer_value(comment, arena);
}

const std::string* Customizer::group_of(
    const ast::Statement& assignment) const {
  const std::uint32_t line = source_.openscad_line(assignment.range.begin);
  const auto group =
      std::find_if(groups_.rbegin(), groups_.rend(),
                   [line](const Group& g) { return g.line < line; });
  return group == groups_.rend() ? nullptr : &group->name;
}

ParameterComment Customizer::comment_of(
    const ast::Statement& assignment) const {
  ParameterComment result;
  if (!is_parameter(assignment)) return result;
  const std::uint32_t line = source_.openscad_line(assignment.range.begin);
  result.is_parameter = true;
  result.description = read_description(source_.line_text(line - 1));
  Arena arena;
  if (const ast::Expr* values = values_of(assignment, arena)) {
    result.values.clear();
    ast::append_expression(*values, result.values);
  }
  const std::string* group = group_of(assignment);
  result.has_group = group != nullptr;
  if (result.has_group) result.group = *group;
  return result;
}

std::map<std::string, std::string> widgets_of(const ast::Program& program) {
  const Source& source = *program.source;
  std::map<std::string, std::string> widgets;
  for (const ast::Statement* statement : program.statements) {
    const auto* variable = std::get_if<ast::Assignment>(&statement->node);
    if (variable == nullptr || statement->range.source != &source) continue;
    const std::uint32_t line = source.openscad_line(statement->range.begin);
    const std::string_view word = trim(find_comment(source.line_text(line)));
    if (word != "color" && word != "font" && word != "hidden") continue;
    widgets[std::string(variable->name)] = word;
  }
  return widgets;
}

std::vector<CustomizerEntry> list_parameters(const ast::Program& program) {
  const Customizer customizer = Customizer::read(program);
  std::vector<CustomizerEntry> parameters;
  for (const ast::Statement* statement : program.statements) {
    const auto* variable = std::get_if<ast::Assignment>(&statement->node);
    if (variable == nullptr) continue;
    ParameterComment comment = customizer.comment_of(*statement);
    if (!comment.is_parameter) continue;
    auto place = std::find_if(
        parameters.begin(), parameters.end(),
        [&](const CustomizerEntry& p) { return p.name == variable->name; });
    if (place == parameters.end()) {
      place = parameters.insert(place, {std::string(variable->name), {}, {}});
    }
    place->value.clear();
    ast::append_expression(*variable->value, place->value);
    place->comment = std::move(comment);
  }
  return parameters;
}

}  // namespace lamina
