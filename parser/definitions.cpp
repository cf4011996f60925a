#include "parser/definitions.h"

#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/similar.h"
#include "parser/ast_printer.h"
#include "parser/customizer.h"

namespace lamina {
namespace {

// The statements by which files of the design assign variables, by name; of
// several the last.
using Assigned = std::map<std::string_view, const ast::Statement*>;

void collect(const ast::Program& program, const Loader& loader,
             std::set<const ast::Program*>& seen, Assigned& assigned) {
  if (!seen.insert(&program).second) return;
  Assigned own;
  for (const ast::Statement* statement : program.statements) {
    const auto* assignment = std::get_if<ast::Assignment>(&statement->node);
    if (assignment != nullptr && !statement->range.is_defined_by_option()) {
      own[assignment->name] = statement;
    }
  }
  assigned.merge(own);
  for (const ast::Use& use : program.uses) {
    if (const ast::Program* used = loader.used_program(use)) {
      collect(*used, loader, seen, assigned);
    }
  }
}

// OpenSCAD does not say any of this.
void warn(SourceRange range, std::string message, std::vector<Note> hints,
          Diagnostics& diagnostics) {
  Diagnostic warning{Severity::kWarning, range, std::move(message)};
  warning.hints = std::move(hints);
  warning.audience = Audience::kTerminal;
  diagnostics.report(std::move(warning));
}

}  // namespace

void check_definitions(const ast::Program& program, const Loader& loader,
                       Diagnostics& diagnostics) {
  Assigned assigned;
  std::set<const ast::Program*> seen;
  collect(program, loader, seen, assigned);
  std::vector<std::string_view> names;
  for (const auto& [name, statement] : assigned) names.push_back(name);
  const Customizer customizer = Customizer::read(program);
  for (const ast::Statement* statement : program.statements) {
    const auto* set = std::get_if<ast::Assignment>(&statement->node);
    if (set == nullptr || !statement->range.is_defined_by_option()) continue;
    const auto own = assigned.find(set->name);
    if (own == assigned.end()) {
      if (set->name.starts_with('$')) continue;
      std::vector<Note> hints;
      if (const std::string hint = did_you_mean(set->name, names);
          !hint.empty()) {
        hints.push_back({{}, hint});
      }
      warn(statement->range,
           fmt::format("the design has no variable '{}'", set->name),
           std::move(hints), diagnostics);
      continue;
    }
    const auto rule = customizer.rule_of(*own->second);
    if (!rule || keeps_rule(*set->value, *rule)) continue;
    warn(statement->range,
         fmt::format("the value does not keep to {}",
                     customizer.comment_of(*own->second).values),
         {{own->second->range, "the design says so here"}}, diagnostics);
  }
}

}  // namespace lamina
