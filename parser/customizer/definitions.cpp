#include "parser/customizer/definitions.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/similar.h"
#include "parser/customizer/customizer.h"

namespace lamina {
namespace {

// The statements by which files of the design assign variables, by name; of
// several the last of the first file.
using Assigned = std::map<std::string_view, const ast::Statement*>;

Assigned find_assigned(const ast::Program& program, const Loader& loader) {
  Assigned assigned;
  for (const ast::Program* file : loader.with_used(program)) {
    Assigned own;
    for (const ast::Statement* statement : file->statements) {
      const auto* assignment = std::get_if<ast::Assignment>(&statement->node);
      if (assignment != nullptr && !statement->range.is_defined_by_option()) {
        own[assignment->name] = statement;
      }
    }
    assigned.merge(own);
  }
  return assigned;
}

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool has_word(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_letter(text[at - 1])) &&
        (end == text.size() || !is_letter(text[end]))) {
      return true;
    }
  }
  return false;
}

// All texts of the design.
std::set<const Source*> find_sources(const ast::Program& program,
                                     const Loader& loader) {
  std::set<const Source*> sources;
  for (const ast::Program* file : loader.with_used(program)) {
    for (const ast::Statement* statement : file->statements) {
      sources.insert(statement->range.source);
    }
  }
  return sources;
}

// Whether a text has the name without assigning it: a design may ask
// is_undef(name). In a comment it counts, too.
bool is_read(std::string_view name, const std::set<const Source*>& sources) {
  return std::any_of(sources.begin(), sources.end(), [&](const Source* source) {
    const std::string_view text = source->text();
    return has_word(text.substr(0, source->definitions_begin()), name);
  });
}

}  // namespace

Variables find_variables(const ast::Program& program, const Loader& loader) {
  Variables variables;
  for (const ast::Program* file : loader.with_used(program)) {
    Variables own;
    for (const ast::Statement* statement : file->statements) {
      const auto* assignment = std::get_if<ast::Assignment>(&statement->node);
      if (assignment == nullptr) continue;
      own[std::string(assignment->name)] = ast::type_of(*assignment->value);
    }
    variables.merge(own);
  }
  return variables;
}

void check_definitions(const ast::Program& program, const Loader& loader,
                       Diagnostics& diagnostics) {
  if (program.source->definitions_begin() == std::string::npos) return;
  const Assigned assigned = find_assigned(program, loader);
  const std::set<const Source*> sources = find_sources(program, loader);
  std::vector<std::string_view> names;
  for (const auto& [name, statement] : assigned) names.push_back(name);
  const Customizer customizer = Customizer::read(program);
  Guesses guesses;
  for (const ast::Statement* statement : program.statements) {
    const auto* set = std::get_if<ast::Assignment>(&statement->node);
    if (set == nullptr || !statement->range.is_defined_by_option()) continue;
    const auto own = assigned.find(set->name);
    if (own == assigned.end()) {
      if (set->name.starts_with('$') || is_read(set->name, sources)) {
        continue;
      }
      diagnostics.own_warning(
          statement->range,
          fmt::format("the design has no variable '{}'", set->name),
          hint_of(guesses.did_you_mean(set->name, names)));
      continue;
    }
    const auto rule = customizer.rule_of(*own->second);
    if (!rule || keeps_rule(*set->value, *rule)) continue;
    diagnostics.own_warning(
        statement->range,
        fmt::format("the value does not keep to {}",
                    customizer.comment_of(*own->second).values),
        {{own->second->range, "the design says so here"}});
  }
}

}  // namespace lamina
