#pragma once
// From syntax trees to code: names become slots.
//
// Scopes follow OpenSCAD: a file, a module, a `{ … }` behind an instantiation,
// a for, let or function each open one. Frames are per activation: a file, a
// call of a module, a function or a function literal; the scopes inside share
// its slots. Files are declared when first needed.
//
// A function literal may outlive the call that made it. It captures variables
// of expressions (parameters of functions, let, for in a comprehension) by
// value, or by a shared box where they get their value later or repeatedly.
// Variables of statements live longer than it, since no module returns a value:
// they are reached through the static link.

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/arena.h"
#include "base/similar.h"
#include "csg/eval/code/argument_plan.h"
#include "csg/eval/code/code.h"
#include "csg/eval/code/dynamic_names.h"
#include "csg/eval/code/lazy_resolver.h"
#include "csg/eval/run/evaluate_options.h"
#include "parser/ast.h"

namespace lamina {
class Loader;
}

namespace lamina::csg {

struct Activation {
  enum class Kind : std::uint8_t { kFile, kModule, kFunction, kLiteral };
  Kind kind = Kind::kFile;
  Activation* link = nullptr;     // the module or file written around it
  Activation* lexical = nullptr;  // what is written directly around it
  Callable* callable = nullptr;   // of a function or function literal
  FunctionLiteral* literal = nullptr;
  // Their places among the captures of `literal`.
  std::unordered_map<const Variable*, std::uint32_t> captured;
  // The nearest activation, this one included, that is a further version of a
  // literal. Closures of that literal exist, so its captures are settled.
  const Activation* version = nullptr;
  std::uint32_t depth = 0;
  std::uint32_t next_slot = 0;
  std::uint32_t slot_count = 0;

  bool is_statement_level() const {
    return kind == Kind::kFile || kind == Kind::kModule;
  }
  std::uint32_t new_slot();
  // How many static links lead to `outer`.
  std::uint32_t count_hops(const Activation& outer) const;
};

struct DeclaredUnit;

struct Scope {
  Scope* parent = nullptr;
  // The file or module that the scope is, or stands in: these alone define
  // functions and modules.
  Scope* home = nullptr;
  Activation* activation = nullptr;
  const DeclaredUnit* unit = nullptr;
  std::unordered_map<std::string_view, Variable*> variables;
  std::unordered_map<std::string_view, Function*> functions;
  std::unordered_map<std::string_view, Module*> modules;
  // Slots of a block that code of another activation may read before they are
  // set.
  std::vector<std::uint32_t> resets;

  bool is_home() const { return home == this; }
  // The file or module around `home`; null for a file.
  Scope* next_home() const {
    return home->parent == nullptr ? nullptr : home->parent->home;
  }
};

// The variables of the scopes that are being resolved, by name, so that nobody
// climbs through scopes nested a thousand deep. Variables of files and modules
// stay in their scopes, since most of the code that sees them is resolved
// later.
class OpenVariables {
 public:
  // Scopes must be left in the reverse order.
  void enter(Scope& scope);
  void leave(Scope& scope);
  // Adds a variable of a scope, which is the last one entered unless it is a
  // home.
  void declare(std::string_view name, Variable& variable);

  // The innermost variable of the name that `scope`, the last one entered,
  // sees, and the next one outside of that; null where there is none.
  Variable* find(const Scope& scope, std::string_view name) const;
  static Variable* next(const Variable& variable, std::string_view name);

 private:
  std::unordered_map<std::string_view, Variable*> innermost_;
};

// A file and what it declares.
struct DeclaredUnit : Unit {
  const ast::Program* program = nullptr;
  Scope* scope = nullptr;
  Activation activation;
  std::vector<const ast::Program*> used;  // in the order of program->uses
};

class Resolver : public LazyResolver {
 public:
  // names    of the `$` variables: gets those that the code names
  // options  must outlive the Resolver, as must the others
  Resolver(const Loader& loader, DynamicNames& names,
           const EvaluateOptions& options);

  const Unit& unit_of(const ast::Program& program) {
    return declared_unit(program);
  }

  // Resolves the assignments of a file, of the main file the instantiations
  // too.
  void resolve(const Unit& unit) override;
  void resolve(const Function& function) override;
  void resolve(const Module& module) override;
  const LiteralCall& plan_for(const CallCode& call,
                              const FunctionLiteral& literal) override;
  std::string did_you_mean(Named kind, std::string_view name) override;
  CodeCounts counts() const override { return counts_; }

  // --- For ExpressionResolver and StatementResolver

  template <typename T>
  T* make() {
    return arena_.make(T());
  }
  template <typename T>
  std::span<const T> keep(const std::vector<T>& values) {
    return arena_.copy(std::span<const T>(values));
  }

  OpenVariables open_variables;
  std::size_t dynamic_reads = 0;  // of `$` variables, so far
  DynamicNames& names() { return names_; }
  Language language() const { return options_.language; }
  std::uint32_t next_call_number() { return counts_.calls++; }
  std::uint32_t next_tail_default_number() { return counts_.tail_defaults++; }

  Scope& open_scope(Scope& parent, Activation& activation);
  Activation& open_activation(Activation::Kind kind, Activation& around);
  void resolve_callable(Callable& callable, ast::Arguments parameters,
                        const ast::Expr& body, Scope& inside, Scope& outside);
  void resolve_fallbacks(std::span<Parameter> parameters, Scope& inside,
                         Scope& outside);
  std::string_view keep_text(std::string_view text) {
    return arena_.copy(text);
  }
  void declare(Scope& scope, ast::Statements statements);
  // Gives parameters slots from `first_slot` on. Their fallbacks are resolved
  // with the body.
  std::span<Parameter> make_parameters(ast::Arguments written,
                                       std::uint32_t first_slot);
  // Declares the parameters as variables of the scope.
  void declare_parameters(std::span<const Parameter> parameters, Scope& scope);

  template <typename Named>
  struct Callee {
    const Named* code = nullptr;
    bool is_foreign = false;  // declared by a used file
  };
  std::span<Parameter> extended_parameters(
      std::span<const Parameter> parameters,
      const std::vector<std::string_view>& names, std::uint32_t first_slot);
  // Finds a function or module (`table`) that `scope` sees.
  template <typename Named>
  Callee<Named> find(
      const Scope& scope, std::string_view name,
      std::unordered_map<std::string_view, Named*> Scope::*table) {
    for (const Scope* s = scope.home; s != nullptr; s = s->next_home()) {
      const auto found = (s->*table).find(name);
      if (found != (s->*table).end()) return {found->second, false};
    }
    for (const ast::Program* used : scope.unit->used) {
      const auto& declared = declared_unit(*used).scope->*table;
      const auto found = declared.find(name);
      if (found != declared.end()) return {found->second, true};
    }
    return {};
  }
  // A version of the callee with further parameters, for arguments whose names
  // are not parameters: OpenSCAD warns of them, but the callee sees those
  // variables.
  const Function& with_extras(const Function& function,
                              std::span<const WrittenArgument> arguments);
  const Module& with_extras(const Module& module,
                            std::span<const WrittenArgument> arguments);
  const FunctionLiteral& with_extras(
      const FunctionLiteral& literal,
      std::span<const WrittenArgument> arguments);
  // Whether to warn of arguments for which a user's module has no parameter.
  Surplus module_surplus() const {
    return options_.check_parameters ? Surplus::kWarn : Surplus::kSilent;
  }

  // Copies that live as long as the code.
  Value& keep_constant(Value value) {
    return constants_.emplace_back(std::move(value));
  }
  ArgumentPlan& keep_plan(ArgumentPlan plan) {
    return plans_.emplace_back(std::move(plan));
  }
  FunctionLiteral& new_literal() { return literals_.emplace_back(); }

 private:
  DeclaredUnit& declared_unit(const ast::Program& program);
  Function& new_function(const ast::FunctionDefinition& written,
                         SourceRange range, Scope& scope);
  Module& new_module(const ast::ModuleDefinition& written, SourceRange range,
                     Scope& scope);

  const Loader& loader_;
  DynamicNames& names_;
  const EvaluateOptions& options_;
  Arena arena_;
  std::deque<Value> constants_;
  std::deque<Scope> scopes_;
  std::deque<Activation> activations_;
  std::deque<Function> functions_;
  std::deque<Module> modules_;
  std::deque<FunctionLiteral> literals_;
  std::deque<ArgumentPlan> plans_;
  std::map<std::pair<const CallCode*, const FunctionLiteral*>, LiteralCall>
      literal_calls_;
  std::map<std::pair<const void*, std::string>, const Function*>
      extra_functions_;
  std::map<std::pair<const void*, std::string>, const Module*> extra_modules_;
  std::map<std::pair<const void*, std::string>, const FunctionLiteral*>
      extra_literals_;
  std::deque<DeclaredUnit> units_;
  std::map<std::pair<Named, std::string_view>, std::string> hints_;
  Guesses guesses_;
  std::unordered_map<const ast::Program*, DeclaredUnit*> unit_of_;
  CodeCounts counts_;
};

// Opens a scope inside the current one, in the same activation; its slots are
// free again when it closes.
class NestedScope {
 public:
  NestedScope(Resolver& resolver, Scope*& current);
  ~NestedScope();
  NestedScope(const NestedScope&) = delete;
  NestedScope& operator=(const NestedScope&) = delete;

 private:
  Resolver& resolver_;
  Scope*& current_;
  Scope* outer_;
  std::uint32_t first_slot_;
};

}  // namespace lamina::csg
