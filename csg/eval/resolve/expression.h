#pragma once
// Resolving expressions (see resolver.h).

#include <string_view>

#include "csg/eval/code/code.h"
#include "csg/eval/resolve/resolver.h"
#include "parser/ast.h"

namespace lamina::csg {

// Whether evaluating an expression certainly has no effect that shows. That
// holds for simple literals; `-"a"` and `[2 : 1]` are literals of which
// OpenSCAD warns.
bool is_silent(const ast::Expr& expr);

// Resolves the expressions of one scope. Cheap to make.
class ExpressionResolver {
 public:
  ExpressionResolver(Resolver& resolver, Scope& scope)
      : resolver_(resolver), scope_(&scope) {}

  enum class Position : std::uint8_t { kInner, kTail };
  const Expression* resolve(const ast::Expr& expr,
                            Position position = Position::kInner);

  // Resolves a variable by name. Where there is none, the code warns or is
  // silently undef.
  enum class Unknown : std::uint8_t { kWarn, kSilent };
  const Expression* variable(std::string_view name, SourceRange range,
                             Unknown unknown);

  std::span<const WrittenArgument> arguments(ast::Arguments written);
  const AssertCode* assertion(ast::Arguments written, const ast::Expr* body,
                              SourceRange range, Position position);

  // Resolves bindings that take effect one after the other. The variables are
  // those of the scope at hand; it gets those that it lacks.
  Bindings sequential_bindings(ast::Arguments written, SourceRange range,
                               bool is_statement_level);
  // Declares a variable of the scope at hand (a slot of its activation).
  Variable* declare(std::string_view name, bool is_statement_level);
  Target target(std::string_view name, Variable* variable);
  // Where the value of a name goes that has one from here on: a variable that
  // is declared, or a `$` variable.
  Target declare_set(std::string_view name, bool is_statement_level,
                     bool is_repeated);

  Scope& scope() { return *scope_; }

 private:
  friend struct ExpressionVisitor;
  friend struct ElementVisitor;

  const Element* element(const ast::Expr& expr);
  const Element* for_element(ast::Arguments bindings, std::size_t first,
                             const ast::Expr& body, SourceRange range);
  const Element* for_c_element(const ast::ForCElements& loop,
                               SourceRange range);
  const Expression* constant(Value value, SourceRange range);
  const Expression* prefixed_literal(std::string_view name, SourceRange range);
  const Expression* binary(const ast::Binary& binary, SourceRange range);
  const Expression* call(const ast::Call& call, SourceRange range,
                         Position position);
  void make_tail_call(CallCode& code, const ast::Call& call);
  const Expression* function_literal(const ast::FunctionLiteral& literal,
                                     SourceRange range);
  const Expression* let(const ast::Let& let, SourceRange range,
                        Position position);
  std::uint32_t capture(Activation& literal, Variable& variable);
  const Expression* load(Variable& variable, SourceRange range,
                         bool* is_certain);

  // Nodes of code, by the function that runs them.
  template <typename T>
  T* make(Expression::Runner run, SourceRange range) {
    T* code = resolver_.make<T>();
    code->run = run;
    code->range = range;
    return code;
  }
  template <typename T>
  T* make(Element::Emit emit, SourceRange range) {
    T* code = resolver_.make<T>();
    code->emit = emit;
    code->range = range;
    return code;
  }

  Resolver& resolver_;
  Scope* scope_;
};

}  // namespace lamina::csg
