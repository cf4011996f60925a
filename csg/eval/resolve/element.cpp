// Resolving elements of vectors (see expression.h).

#include <variant>

#include "csg/eval/resolve/expression.h"
#include "csg/eval/run/runners.h"

namespace lamina::csg {

struct ElementVisitor {
  ExpressionResolver& self;
  const ast::Expr& expr;

  const Element* operator()(const ast::ForElements& loop) const {
    return self.for_element(loop.bindings, 0, *loop.body, expr.range);
  }
  const Element* operator()(const ast::ForCElements& loop) const {
    return self.for_c_element(loop, expr.range);
  }
  const Element* operator()(const ast::IfElements& written) const {
    auto* code = self.make<IfElement>(emit_if, expr.range);
    code->condition = self.resolve(*written.condition);
    code->if_true = self.element(*written.if_true);
    if (written.if_false != nullptr) {
      code->if_false = self.element(*written.if_false);
    }
    return code;
  }
  const Element* operator()(const ast::EachElements& each) const {
    auto* code = self.make<EachElement>(emit_each, expr.range);
    code->body = self.element(*each.body);
    return code;
  }
  const Element* operator()(const ast::LetElements& let) const {
    const NestedScope nested(self.resolver_, self.scope_);
    auto* code = self.make<LetElement>(emit_let, expr.range);
    code->bindings = self.sequential_bindings(let.bindings, expr.range, false);
    code->body = self.element(*let.body);
    return code;
  }
  template <typename T>
  const Element* operator()(const T&) const {
    auto* code = self.make<Element>(emit_value, expr.range);
    code->value = self.resolve(expr);
    return code;
  }
};

const Element* ExpressionResolver::element(const ast::Expr& expr) {
  return std::visit(ElementVisitor{*this, expr}, expr.node);
}

const Element* ExpressionResolver::for_element(ast::Arguments bindings,
                                               std::size_t first,
                                               const ast::Expr& body,
                                               SourceRange range) {
  if (first == bindings.size()) return element(body);
  const ast::Argument& written = bindings[first];
  auto* code = make<ForElement>(emit_for, range);
  code->binding = {
      .name = written.name, .value = resolve(*written.value), .range = range};
  const NestedScope nested(resolver_, scope_);
  code->binding.target = declare_set(written.name, false, true);
  code->body = for_element(bindings, first + 1, body, range);
  return code;
}

const Element* ExpressionResolver::for_c_element(const ast::ForCElements& loop,
                                                 SourceRange range) {
  const NestedScope nested(resolver_, scope_);
  auto* code = make<ForCElement>(emit_for_c, range);
  std::vector<Variable*> updated;
  for (const ast::Argument& update : loop.head->update) {
    if (update.name.empty() || is_dynamic_name(update.name)) continue;
    if (scope_->variables.contains(update.name)) continue;
    updated.push_back(declare(update.name, false));
    updated.back()->is_repeated = true;
  }
  code->init = sequential_bindings(loop.head->init, range, false);
  // A variable that only the update names has a value from the second round on.
  for (Variable* variable : updated) {
    if (!variable->is_set) variable->may_be_unset = true;
  }
  code->condition = resolve(*loop.head->condition);
  code->body = element(*loop.body);
  Scope& loop_scope = *scope_;
  const NestedScope update_scope(resolver_, scope_);
  code->update = sequential_bindings(loop.head->update, range, false);
  std::vector<ForCElement::Copy> copies;
  for (const Binding& binding : code->update) {
    if (binding.target.kind != Target::Kind::kSlot) continue;
    copies.push_back(
        {binding.target,
         target(binding.name, loop_scope.variables.at(binding.name))});
  }
  code->copies = resolver_.keep(copies);
  return code;
}

}  // namespace lamina::csg
