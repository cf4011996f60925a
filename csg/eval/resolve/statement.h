#pragma once
// Resolving statements: bodies of files and modules, and instantiations (see
// resolver.h).

#include "csg/eval/code/code.h"
#include "csg/eval/resolve/expression.h"
#include "csg/eval/resolve/resolver.h"
#include "parser/ast.h"

namespace lamina::csg {

class StatementResolver {
 public:
  StatementResolver(Resolver& resolver, Scope& scope)
      : resolver_(resolver), scope_(&scope) {}

  // Statements of a file, in its scope.
  Block body(ast::Statements statements);
  // Statements of a used file, whose instantiations make nothing.
  Block assignments_only(ast::Statements statements);
  // Parameters and body of a module, in its own scope.
  void module(Module& module);

 private:
  Bindings assignments(ast::Statements statements, Module* module);
  std::span<const InstantiationCode* const> instantiations(
      ast::Statements statements);
  // A `{ … }` in a scope of its own.
  Block* block(ast::Statements statements);

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
