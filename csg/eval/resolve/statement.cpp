#include "csg/eval/resolve/statement.h"

#include <string>
#include <variant>

#include <fmt/format.h>

#include "csg/eval/builtin/modules.h"
#include "csg/eval/run/runners.h"
#include "parser/tree_facts.h"

namespace lamina::csg {

template <typename T>
T* StatementResolver::make(InstantiationCode::Runner run, SourceRange range) {
  T* code = resolver_.make<T>();
  code->run = run;
  code->range = range;
  return code;
}

// --- Bodies -----------------------------------------------------------------

Block StatementResolver::body(ast::Statements statements, bool is_used) {
  Block block;
  block.assignments = assignments(statements, nullptr);
  if (!is_used) block.statements = instantiations(statements);
  return block;
}

void StatementResolver::module(Module& module) {
  auto* children = resolver_.make<Variable>();
  children->slot = Module::kChildrenSlot;
  children->scope = scope_;
  children->is_set = children->is_parameter = true;
  children->is_statement_level = true;
  scope_->variables["$children"] = children;
  scope_->activation->next_slot = scope_->activation->slot_count =
      Module::kChildrenSlot + 1;

  resolver_.declare_parameters(module.parameters, *scope_);
  resolver_.resolve_fallbacks(module.parameters, *scope_, *module.scope);
  resolver_.declare(*scope_, module.definition->body);
  module.body.assignments = assignments(module.definition->body, &module);
  module.body.statements = instantiations(module.definition->body);
}

namespace {
std::string overwrite_warning(const Module& module, std::string_view parameter,
                              Language language) {
  return fmt::format("{}Parameter {} is overwritten with a literal",
                     language == Language::k2021
                         ? fmt::format("Module {}: ", module.name)
                         : std::string(),
                     quoted_name(parameter, language, ""));
}
}  // namespace

// The last value of a name counts; it is assigned where the first one stands.
Bindings StatementResolver::assignments(ast::Statements statements,
                                        Module* module) {
  ExpressionResolver resolver = expressions();
  std::vector<Variable*> variables;
  std::vector<Binding> bindings;
  std::vector<const ast::Expr*> values;
  for (const std::size_t i : ast::assignments_that_count(statements)) {
    const auto& written = std::get<ast::Assignment>(statements[i]->node);
    values.push_back(written.value);
    Binding binding;
    binding.name = written.name;
    binding.range = statements[i]->range;
    Variable* variable = nullptr;
    if (!is_dynamic_name(written.name)) {
      const auto known = scope_->variables.find(written.name);
      const bool is_parameter = known != scope_->variables.end();
      variable =
          is_parameter ? known->second : resolver.declare(written.name, true);
      if (is_parameter && module != nullptr &&
          ast::is_literal(*written.value)) {
        module->overwrites.emplace_back(
            static_cast<std::uint32_t>(bindings.size()),
            overwrite_warning(*module, written.name, resolver_.language()));
      }
    }
    binding.target = resolver.target(written.name, variable);
    variables.push_back(variable);
    bindings.push_back(binding);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    bindings[i].value = resolver.resolve(*values[i]);
    if (variables[i] != nullptr) variables[i]->is_set = true;
  }
  return resolver_.keep(bindings);
}

std::span<const InstantiationCode* const> StatementResolver::instantiations(
    ast::Statements statements) {
  std::vector<const InstantiationCode*> codes;
  for (const ast::Statement* statement : statements) {
    if (const InstantiationCode* code = instantiation(*statement)) {
      codes.push_back(code);
    }
  }
  return resolver_.keep(codes);
}

Block* StatementResolver::block(ast::Statements statements,
                                const std::function<void()>& resolve_between) {
  const NestedScope open(resolver_, scope_);
  auto* block = resolver_.make<Block>();
  block->assigns_before_call = resolver_.language() == Language::k2021;
  const std::size_t reads = resolver_.dynamic_reads;
  block->assignments = assignments(statements, nullptr);
  block->reads_dynamic = resolver_.dynamic_reads != reads;
  if (resolve_between) resolve_between();
  block->statements = instantiations(statements);
  block->resets = resolver_.keep(scope_->resets);
  return block;
}

// --- Instantiations ---------------------------------------------------------

const InstantiationCode* StatementResolver::instantiation(
    const ast::Statement& statement) {
  if (const auto* call = std::get_if<ast::Instantiation>(&statement.node)) {
    return this->call(*call, statement.range);
  }
  if (const auto* if_else = std::get_if<ast::IfElse>(&statement.node)) {
    InstantiationCode* code = this->if_else(*if_else, statement.range);
    code->name = "if";
    code->modifiers = if_else->modifiers;
    return code;
  }
  return nullptr;
}

const InstantiationCode* StatementResolver::call(
    const ast::Instantiation& written, SourceRange range) {
  const auto callee = resolver_.find(*scope_, written.name, &Scope::modules);
  InstantiationCode* code = callee.code != nullptr
                                ? user_module(written, range, callee)
                                : builtin(written, range);
  code->name = written.name;
  code->modifiers = written.modifiers;
  return code;
}

// In 2021.01 the arguments of a user module see the assignments among its
// children.
InstantiationCode* StatementResolver::user_module(
    const ast::Instantiation& written, SourceRange range,
    const Resolver::Callee<Module>& callee) {
  auto* code = make<UserModuleCode>(run_user_module, range);
  code->is_foreign = callee.is_foreign;
  if (!callee.is_foreign) {
    code->hops =
        scope_->activation->count_hops(*callee.code->scope->activation);
  }
  const auto resolve_arguments = [&] {
    code->arguments = expressions().arguments(written.arguments);
    code->module = &resolver_.with_extras(*callee.code, code->arguments);
    code->plan = &resolver_.keep_plan(
        plan_arguments(code->module->parameters, callee.code->parameters.size(),
                       code->arguments, resolver_.names(), resolver_.language(),
                       resolver_.module_surplus()));
  };
  if (resolver_.language() == Language::k2021) {
    code->block = block(written.children, resolve_arguments);
  } else {
    resolve_arguments();
    code->block = block(written.children);
  }
  return code;
}

InstantiationCode* StatementResolver::if_else(const ast::IfElse& written,
                                              SourceRange range) {
  auto* code = make<IfCode>(run_if, range);
  code->condition = expressions().resolve(*written.condition);
  code->block = block(written.if_true);
  if (written.has_else) code->otherwise = block(written.if_false);
  return code;
}

InstantiationCode* StatementResolver::loop(const ast::Instantiation& written,
                                           SourceRange range) {
  auto* code = make<ForCode>(run_for, range);
  code->is_intersection = written.name == "intersection_for";
  const NestedScope open(resolver_, scope_);
  std::vector<Binding> bindings;
  for (const ast::Argument& argument : written.arguments) {
    ExpressionResolver resolver = expressions();
    const Expression* value = resolver.resolve(*argument.value);
    bindings.push_back(
        {.target = resolver.declare_set(argument.name, true, true),
         .name = argument.name,
         .value = value,
         .range = range});
  }
  code->bindings = resolver_.keep(bindings);
  code->block = block(written.children);
  return code;
}

InstantiationCode* StatementResolver::let(const ast::Instantiation& written,
                                          SourceRange range) {
  auto* code = make<LetModuleCode>(run_let_module, range);
  const NestedScope open(resolver_, scope_);
  code->bindings =
      expressions().sequential_bindings(written.arguments, range, true);
  code->block = block(written.children);
  code->resets = resolver_.keep(scope_->resets);
  return code;
}

// Unlike let, the values do not see one another.
InstantiationCode* StatementResolver::assign(const ast::Instantiation& written,
                                             SourceRange range) {
  auto* code = make<LetModuleCode>(run_assign, range);
  std::vector<Binding> bindings;
  for (const ast::Argument& argument : written.arguments) {
    if (argument.name.empty()) continue;
    bindings.push_back({.name = argument.name,
                        .value = expressions().resolve(*argument.value),
                        .range = range});
  }
  const NestedScope open(resolver_, scope_);
  for (Binding& binding : bindings) {
    binding.target = expressions().declare_set(binding.name, true, false);
  }
  code->bindings = resolver_.keep(bindings);
  code->block = block(written.children);
  return code;
}

InstantiationCode* StatementResolver::builtin(const ast::Instantiation& written,
                                              SourceRange range) {
  const std::string_view name = written.name;
  if (name == "for" || name == "intersection_for") return loop(written, range);
  if (name == "let") return let(written, range);
  if (name == "assign") return assign(written, range);
  if (name == "assert") {
    auto* code = make<AssertModuleCode>(run_assert_module, range);
    code->assertion =
        expressions().assertion(written.arguments, nullptr, range,
                                ExpressionResolver::Position::kInner);
    code->block = block(written.children);
    return code;
  }
  const Language language = resolver_.language();
  const BuiltinModuleEntry* entry = find_builtin_module(name, language);
  if (entry == nullptr) {
    return make<InstantiationCode>(run_unknown_module, range);
  }
  auto* code = make<BuiltinModuleCode>(run_builtin_module, range);
  code->handler = entry->handler;
  code->parameters = entry->parameters;
  code->unit = scope_->unit;
  code->deprecated_for = entry->replacement;
  code->arguments = expressions().arguments(written.arguments);
  code->plan = &resolver_.keep_plan(
      plan_arguments(entry->parameters, entry->positional_count,
                     code->arguments, resolver_.names(), language));
  code->block = block(written.children, [&] {
    if (entry->needs_late_argument && !written.arguments.empty() &&
        written.arguments[0].name.empty()) {
      code->late_argument = expressions().resolve(*written.arguments[0].value);
    }
  });
  return code;
}

}  // namespace lamina::csg
