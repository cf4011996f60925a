#include "parser/cell.h"

#include <algorithm>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/letter_case.h"
#include "base/text.h"
#include "parser/loader.h"
#include "parser/parser.h"
#include "parser/tree_facts.h"

namespace lamina {
namespace {

[[noreturn]] void refuse(std::string_view expected, std::string_view cell) {
  throw FileError(fmt::format(
      "{} was expected, not '{}' (text would stand in quotes: \"{}\")",
      expected, cell, cell));
}

// A number as OpenSCAD writes it; none if it is none.
std::optional<std::string> read_number(std::string_view cell,
                                       DecimalSign decimal) {
  std::string text(cell);
  if (decimal == DecimalSign::kPointOrComma &&
      std::count(text.begin(), text.end(), ',') == 1 &&
      text.find('.') == std::string::npos) {
    text[text.find(',')] = '.';
  }
  if (text.starts_with('+')) text.erase(0, 1);
  if (!parse_number(text)) return std::nullopt;
  return text;
}

// In any case of letters: spreadsheets turn true into TRUE.
std::optional<std::string> read_truth(std::string_view cell) {
  const std::string word = lower_case(cell);
  if (word == "true" || word == "false") return word;
  return std::nullopt;
}

// Whether the cell is a literal of OpenSCAD and no more: a definition of it
// then reaches to the semicolon behind it, where its only statement ends.
bool is_literal(std::string_view cell) {
  SourceStore sources;
  Diagnostics diagnostics;
  // A cell names no file, and none is opened to find that out.
  const FileAccess no_file = FileAccess::none();
  Loader loader(sources, diagnostics, {}, {}, no_file);
  const std::string definition = fmt::format("x={};", cell);
  const Source& source = sources.add("", definition + '\n');
  try {
    const ast::Program program = parse(source, nullptr, loader, diagnostics);
    if (program.statements.size() != 1) return false;
    const ast::Statement& statement = *program.statements[0];
    if (statement.range.text() != definition) return false;
    const auto* assignment = std::get_if<ast::Assignment>(&statement.node);
    return assignment != nullptr && ast::is_literal(*assignment->value);
  } catch (const SyntaxError&) {
    return false;
  } catch (const AccessError&) {
    return false;
  }
}

bool is_quoted(std::string_view cell) {
  return cell.size() > 1 && cell.starts_with('"') && cell.ends_with('"') &&
         is_literal(cell);
}

bool is_vector(std::string_view cell) {
  return cell.starts_with('[') && is_literal(cell);
}

}  // namespace

std::string value_of_cell(std::string_view cell, ast::ValueType type,
                          DecimalSign decimal) {
  if (is_quoted(cell)) return std::string(cell);
  if (type == ast::ValueType::kString) return in_quotes(cell);
  const bool is_any =
      type == ast::ValueType::kAny || type == ast::ValueType::kRange;
  if (is_any || type == ast::ValueType::kNumber) {
    if (auto number = read_number(cell, decimal)) return *number;
    if (!is_any) refuse("a number", cell);
  }
  if (is_any || type == ast::ValueType::kBool) {
    if (auto truth = read_truth(cell)) return *truth;
    if (!is_any) refuse("true or false", cell);
  }
  if (is_vector(cell)) return std::string(cell);
  if (!is_any || cell.starts_with('['))
    refuse("a vector such as [1, 2.5]", cell);
  return in_quotes(cell);
}

}  // namespace lamina
