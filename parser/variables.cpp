#include "parser/variables.h"

#include <variant>

namespace lamina {

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

}  // namespace lamina
