#include "parser/variables.h"

#include <set>
#include <variant>

namespace lamina {
namespace {

void add_variables(const ast::Program& program, const Loader& loader,
                   std::set<const ast::Program*>& seen, Variables& variables) {
  if (!seen.insert(&program).second) return;
  Variables own;
  for (const ast::Statement* statement : program.statements) {
    const auto* assignment = std::get_if<ast::Assignment>(&statement->node);
    if (assignment == nullptr) continue;
    own[std::string(assignment->name)] = ast::type_of(*assignment->value);
  }
  variables.merge(own);
  for (const ast::Use& use : program.uses) {
    if (const ast::Program* used = loader.used_program(use)) {
      add_variables(*used, loader, seen, variables);
    }
  }
}

}  // namespace

Variables find_variables(const ast::Program& program, const Loader& loader) {
  Variables variables;
  std::set<const ast::Program*> seen;
  add_variables(program, loader, seen, variables);
  return variables;
}

}  // namespace lamina
