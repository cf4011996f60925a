#pragma once
// Resolved code: what the resolver makes of a syntax tree and the interpreter
// runs.
//
// Design. A tree of small nodes, each with a pointer to the function that runs
// it ("closure generation"). It is as fast as bytecode with registers where it
// counts (a call, a vector operation, a csg node cost more than dispatch), and
// each construct of the language stays one readable function. A variant with
// one large switch would need five times the C++ stack, since its frame holds
// the temporaries of all cases: so recursion 100,000 deep is cheap.
//
// Names are gone: a variable is a slot in the frame of its activation (a file,
// a call of a module or function), found by a number of hops along the static
// links. OpenSCAD assigns in order, and a variable that is not assigned yet
// does not hide the one outside: where a slot is unset at run time, the next
// outer variable is read (`otherwise`). `$` variables have dynamic scope: one
// value per name, saved and restored around scopes (shallow binding).
//
// Resolved code is frozen: what the interpreter wants to remember about a node
// it keeps in tables of its own, under the node's number. The resolver alone
// fills in the bodies of files, functions and modules, when they are first
// entered, so that a library costs what is used of it.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "csg/eval/value/value.h"
#include "parser/ast.h"

namespace lamina::csg {

class Interpreter;
struct Activation;
struct Scope;
struct Module;
struct Unit;
struct Block;
struct ArgumentPlan;

// --- Frames ---------------------------------------------------------------

// The variables of one activation. Lives on the C++ stack.
class Frame {
 public:
  Interpreter& in;
  Value* slots = nullptr;
  Frame* link = nullptr;             // of the module or file written around it
  const Closure* closure = nullptr;  // of a function literal
  // The used file whose code this is; null for the design's own. Messages show
  // places relative to it.
  const Source* document = nullptr;
  // What `children()` of a module's activation stands for.
  const Block* children = nullptr;
  Frame* children_frame = nullptr;
};

// A variable as the resolver sees it. Code refers to it for `is_boxed`, which a
// closure further down the text may decide.
struct Variable {
  std::uint32_t slot = 0;
  bool is_boxed = false;
  bool is_set = false;        // at the point that the resolver has reached
  bool is_parameter = false;  // set from the start of its activation
  bool is_statement_level = false;  // lives as long as its activation
  bool is_repeated = false;         // a loop gives it several values
  bool may_be_unset = false;        // at run time, even where is_set
  Scope* scope = nullptr;
  Variable* outer = nullptr;  // the next of its name in the open scopes around
};

// Where an assignment goes: a slot, a `$` variable, or nowhere.
struct Target {
  enum class Kind : std::uint8_t { kSlot, kDynamic, kNowhere };
  Kind kind = Kind::kNowhere;
  std::uint32_t index = 0;             // slot or number of the `$` variable
  const Variable* variable = nullptr;  // of a slot; null for parameters
};

// --- Expressions ----------------------------------------------------------

struct Expression {
  using Runner = Value (*)(const Expression&, Frame&);
  // What a caller may look at instead of running the node.
  enum class Kind : std::uint8_t {
    kOther,
    kConstant,
    kLocal,  // slots[slot]
    kOuter,  // link->slots[slot]
    kIndex,  // object[index]
    // Nodes that pass a tail position on.
    kConditional,
    kLet,
    kAssert,
    kEcho,
    kTailCall,
  };

  Runner run = nullptr;
  SourceRange range;
  Kind kind = Kind::kOther;
  std::uint32_t slot = 0;
};

// An expression as the node that its function knows it to be.
template <typename T>
const T& as(const Expression& expression) {
  return static_cast<const T&>(expression);
}

struct Constant : Expression {
  const Value* value = nullptr;
};

// A number that is not quite what was written: each look at it warns.
struct InexactLiteral : Expression {
  double value = 0;
  std::string_view warning;
};

struct UnknownVariable : Expression {
  std::string_view name;
};
struct DynamicVariable : Expression {
  std::uint32_t index = 0;
  std::string_view name;
  bool is_silent = false;
};
// A variable of any activation, or a captured value, by its slot.
struct VariableLoad : Expression {
  std::uint32_t hops = 0;
  const Expression* otherwise = nullptr;  // where the slot is unset
};

struct UnaryCode : Expression {
  const Expression* operand = nullptr;
};
struct BinaryCode : Expression {
  ast::BinaryOp op = ast::BinaryOp::kAdd;
  const Expression* left = nullptr;
  const Expression* right = nullptr;
};
struct ConditionalCode : Expression {
  const Expression* condition = nullptr;
  const Expression* if_true = nullptr;
  const Expression* if_false = nullptr;
};
struct MemberCode : Expression {
  const Expression* object = nullptr;
  std::string_view name;
};
struct RangeCode : Expression {
  const Expression* begin = nullptr;
  const Expression* step = nullptr;  // may be null
  const Expression* end = nullptr;
  bool is_literal = false;
};

// An element of a vector or comprehension. It emits any number of values.
struct Element {
  using Emit = void (*)(const Element&, Frame&, VectorGrower&);
  Emit emit = nullptr;
  const Expression* value = nullptr;  // of a plain one
  SourceRange range;
};
struct VectorCode : Expression {
  std::span<const Element* const> elements;
};

// `name = value` in let, for, and assignments.
struct Binding {
  Target target = {};
  std::string_view name;
  const Expression* value = nullptr;
  bool is_duplicate = false;  // reported and dropped
  SourceRange range;
};
using Bindings = std::span<const Binding>;

struct LetCode : Expression {
  Bindings bindings;
  const Expression* body = nullptr;
};

struct ForElement : Element {
  Binding binding;
  const Element* body = nullptr;
};
struct ForCElement : Element {
  Bindings init;
  const Expression* condition = nullptr;
  Bindings update;  // into slots of their own, then copied:
  struct Copy {
    Target from;
    Target to;
  };
  std::span<const Copy> copies;
  const Element* body = nullptr;
};
struct IfElement : Element {
  const Expression* condition = nullptr;
  const Element* if_true = nullptr;
  const Element* if_false = nullptr;  // may be null
};
struct EachElement : Element {
  const Element* body = nullptr;
};
struct LetElement : Element {
  Bindings bindings;
  const Element* body = nullptr;
};

// Arguments as written, for echo and for built-in functions.
struct WrittenArgument {
  std::string_view name;
  const Expression* value = nullptr;
};

struct EchoCode : Expression {
  std::span<const WrittenArgument> arguments;
  const Expression* body = nullptr;  // may be null
};
struct AssertCode : Expression {
  const ArgumentPlan* plan = nullptr;
  const Expression* condition = nullptr;
  const Expression* message = nullptr;
  const ast::Expr* condition_text = nullptr;  // null: none given
  const Expression* body = nullptr;           // may be null
};

// --- Calls ----------------------------------------------------------------

struct Parameter {
  std::string_view name;
  Target target;
  const Expression* fallback = nullptr;  // null: undef
  const ast::Expr* fallback_text = nullptr;
  bool has_silent_fallback = true;  // evaluating it cannot be noticed
  bool is_extra = false;            // only given by callers that were warned
};

// An argument and the parameter or variable that it sets.
struct BoundArgument {
  Target target;
  std::uint32_t written = 0;  // index in the call's arguments
};
// How the arguments of a call meet parameters, settled once per call site.
struct ArgumentWarning {
  std::string words;
  std::string hint;
};
struct ArgumentPlan {
  // In the order in which OpenSCAD evaluates them.
  std::vector<BoundArgument> bound;
  std::vector<std::uint32_t> defaults;  // parameters whose fallback is needed
  // Fallbacks are evaluated after the arguments, and `$` variables among these
  // are set after both. Else each is set at once, fallbacks first.
  bool evaluates_fallbacks_last = false;
  std::vector<ArgumentWarning> warnings;
  // Whether one is given that only 2026 knows.
  bool has_newer_argument = false;
};

// What named functions and function literals have in common.
struct Callable {
  std::string_view name;
  std::span<Parameter> parameters;
  const Expression* body = nullptr;  // null until resolved
  std::uint32_t slot_count = 0;
  bool has_tail_calls = false;
};
struct Function : Callable {
  std::uint32_t number = 0;  // among the functions
  const ast::FunctionDefinition* definition = nullptr;
  SourceRange range;
  Scope* scope = nullptr;  // where it is defined
  const Unit* unit = nullptr;
};
struct FunctionLiteral : Callable, FunctionCode {
  struct Capture {
    bool from_closure = false;  // else from a slot of the frame
    std::uint32_t index = 0;
  };
  std::vector<Capture> captures;
  std::uint32_t hops = 0;  // from the maker's frame to the closure's link
  const Source* document = nullptr;  // as in Frame
  Scope* scope = nullptr;            // where it is written
  Activation* activation = nullptr;
};

inline const FunctionLiteral& literal_of(const Closure& closure) {
  return static_cast<const FunctionLiteral&>(*closure.code);
}

// How a call meets a function literal: the version of it that has parameters
// for all that the call names, and the plan for that version.
struct LiteralCall {
  const FunctionLiteral* literal = nullptr;
  ArgumentPlan plan;
};

struct LiteralCode : Expression {
  const FunctionLiteral* literal = nullptr;
};

using BuiltinFunction = Value (*)(const struct CallCode&, Frame&);
using MathFunction = double (*)(double);

struct CallCode : Expression {
  std::string_view name;  // empty where the callee is not a plain name:
  const ast::Expr* callee_text = nullptr;
  std::span<const WrittenArgument> arguments;
  // The function that the name means, if any: one of these two.
  const Function* function = nullptr;
  BuiltinFunction builtin = nullptr;
  MathFunction math = nullptr;  // of a built-in function of one number
  std::uint32_t hops = 0;       // from the caller's frame to the callee's link
  bool is_foreign = false;      // defined in another file: by `use`
  ArgumentPlan* plan = nullptr;
  // A variable of that name: if it holds a function, it is called. Or the
  // callee, where that is not a plain name.
  const Expression* callee = nullptr;
  bool is_name = true;
  std::uint32_t number = 0;  // among the calls that have a `callee`
  // Whether a function calls itself in tail position. OpenSCAD looks at the
  // names of the arguments once, so their warnings come once.
  bool is_self_call = false;
  // Such a call is a jump (`is_jump`) where it names the parameters of this
  // version only. It leaves out arguments that pass a parameter on to itself.
  // As in OpenSCAD 2021.01, its fallbacks are evaluated once per call site, in
  // the scope of the call; since then each time, in that of the definition.
  struct TailDefault {
    Target target;
    const Expression* value = nullptr;
    std::uint32_t number = 0;  // among the fallbacks of all jumps
    bool is_evaluated_once = true;
  };
  bool is_jump = false;
  // In tail position, so that a later OpenSCAD than 2021.01 needs no stack for
  // it, whatever it calls.
  bool may_be_deferred = false;
  std::span<const BoundArgument> tail_arguments;
  std::span<const TailDefault> tail_defaults;
};

// --- Statements -----------------------------------------------------------

struct InstantiationCode {
  // Makes the node of the module's instance, if there is one, on top of the
  // interpreter's list of nodes.
  using Runner = void (*)(const InstantiationCode&, Frame&);
  Runner run = nullptr;
  std::string_view name;
  SourceRange range;
  ast::Modifiers modifiers;
  Block* block = nullptr;  // its children
};

// `{ … }` behind a module: assignments, then instantiations.
struct Block {
  Bindings assignments;
  // The assignments belong to the call: they run once, before its arguments.
  // Else they run whenever the children do.
  bool assigns_before_call = true;
  // Whether the assignments read `$` variables, which what is called may set.
  bool reads_dynamic = false;
  std::span<const InstantiationCode* const> statements;
  // Variables of the block that code may read before they are set.
  std::span<const std::uint32_t> resets;
};

// A file: the design, or one that is used.
struct Unit {
  std::uint32_t number = 0;  // among the files; 0: the design
  const Source* source = nullptr;
  const Source* document = nullptr;  // of a used file; null for the design
  Block body;                        // of a used file assignments only
  std::uint32_t slot_count = 0;
  bool is_resolved = false;
};

struct Module {
  static constexpr std::uint32_t kChildrenSlot = 0;  // of `$children`

  std::uint32_t number = 0;  // among the modules
  std::string_view name;
  const ast::ModuleDefinition* definition = nullptr;
  SourceRange range;
  Scope* scope = nullptr;
  const Unit* unit = nullptr;
  std::span<Parameter> parameters;
  std::uint32_t slot_count = 0;
  bool is_resolved = false;
  Block body;
  // Assignments that overwrite a parameter with a literal (index, message).
  std::vector<std::pair<std::uint32_t, std::string>> overwrites;
};

struct UserModuleCode : InstantiationCode {
  const Module* module = nullptr;
  std::uint32_t hops = 0;
  bool is_foreign = false;
  std::span<const WrittenArgument> arguments;
  ArgumentPlan* plan = nullptr;
};
struct IfCode : InstantiationCode {
  const Expression* condition = nullptr;
  const Block* otherwise = nullptr;  // null: no `else`
};
struct ForCode : InstantiationCode {
  Bindings bindings;
  bool is_intersection = false;
};
struct LetModuleCode : InstantiationCode {
  Bindings bindings;
  std::span<const std::uint32_t> resets;  // as for Block
};
struct AssertModuleCode : InstantiationCode {
  const AssertCode* assertion = nullptr;
};
struct BuiltinModuleCode;
using BuiltinModule = void (*)(const BuiltinModuleCode&, Frame&);
struct BuiltinModuleCode : InstantiationCode {
  BuiltinModule handler = nullptr;
  std::span<const Parameter> parameters;
  std::span<const WrittenArgument> arguments;
  ArgumentPlan* plan = nullptr;
  const Unit* unit = nullptr;
  // The first argument of linear_extrude, resolved inside its block.
  const Expression* late_argument = nullptr;
  std::string_view deprecated_for;  // what to use instead; mostly empty
};

}  // namespace lamina::csg
