#pragma once
// Resolving statements: bodies of files and modules, and instantiations (see
// resolver.h).

#include <functional>

#include "csg/eval/code/code.h"
#include "csg/eval/resolve/expression.h"
#include "csg/eval/resolve/resolver.h"
#include "parser/ast.h"

namespace lamina::csg {

class StatementResolver {
 public:
  StatementResolver(Resolver& resolver, Scope& scope)
      : resolver_(resolver), scope_(&scope) {}

  // Statements of a file, in its scope: of a used file the assignments only,
  // for its instantiations make nothing.
  Block body(ast::Statements statements, bool is_used);
  // Parameters and body of a module, in its own scope.
  void module(Module& module);

 private:
  Bindings assignments(ast::Statements statements, Module* module);
  std::span<const InstantiationCode* const> instantiations(
      ast::Statements statements);
  // A `{ … }` in a scope of its own. `resolve_between` resolves what sees its
  // assignments and stands before its instantiations.
  Block* block(ast::Statements statements,
               const std::function<void()>& resolve_between = nullptr);

  const InstantiationCode* instantiation(const ast::Statement& statement);
  const InstantiationCode* call(const ast::Instantiation& written,
                                SourceRange range);
  InstantiationCode* user_module(const ast::Instantiation& written,
                                 SourceRange range,
                                 const Resolver::Callee<Module>& callee);
  InstantiationCode* if_else(const ast::IfElse& written, SourceRange range);
  InstantiationCode* loop(const ast::Instantiation& written, SourceRange range);
  InstantiationCode* let(const ast::Instantiation& written, SourceRange range);
  InstantiationCode* assign(const ast::Instantiation& written,
                            SourceRange range);
  InstantiationCode* builtin(const ast::Instantiation& written,
                             SourceRange range);
  ExpressionResolver expressions() { return {resolver_, *scope_}; }

  template <typename T>
  T* make(InstantiationCode::Runner run, SourceRange range);

  Resolver& resolver_;
  Scope* scope_;
};

}  // namespace lamina::csg
