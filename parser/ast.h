#pragma once
// The abstract syntax tree of an OpenSCAD program.
//
// Trees are variants; all nodes and lists of a program live in one arena and
// are freed with it, without recursion. Names and strings are views into the
// arena or into the source texts, which must outlive the program. Nothing is
// resolved here: a Variable is a name, a Call is an expression applied to
// arguments.
//
// What OpenSCAD's own parser already settles is settled here as well: unary
// `+` and disabled (`*`) instantiations leave no trace, and the statements of
// a bare `{ … }` stand in the list around it, since such braces open no scope.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "base/arena.h"
#include "base/source.h"
#include "parser/language.h"

namespace lamina::ast {

struct Expr;

// `name = value`, `value` or (in parameter lists) `name`.
struct Argument {
  std::string_view name;        // empty: positional
  const Expr* value = nullptr;  // null: a parameter without default
  SourceRange range;
};
using Arguments = std::span<const Argument>;

enum class UnaryOp : std::uint8_t { kNot, kNegate, kBitNot };
enum class BinaryOp : std::uint8_t {
  kOr,
  kAnd,
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kBitOr,
  kBitAnd,
  kShiftLeft,
  kShiftRight,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kModulo,
  kPower,
};

struct Undef {};
struct Bool {
  bool value;
};
struct Number {
  double value;
};
struct String {
  std::string_view value;
};  // escapes already decoded
struct Variable {
  std::string_view name;
};  // `$` names too
struct Unary {
  UnaryOp op;
  const Expr* operand;
};
struct Binary {
  BinaryOp op;
  const Expr* left;
  const Expr* right;
};
struct Conditional {
  const Expr* condition;
  const Expr* if_true;
  const Expr* if_false;
};
struct Vector {
  std::span<const Expr* const> elements;
};
// A vector of nothing but number literals (`-1` counts as one): by far the
// most frequent thing in a .csg file and in tables, so it is kept flat.
struct Numbers {
  std::span<const double> values;
};
struct Range {
  const Expr* begin;
  const Expr* step;
  const Expr* end;
};  // step may be null
struct Index {
  const Expr* object;
  const Expr* index;
};
struct Member {
  const Expr* object;
  std::string_view name;
};  // v.x
struct Call {
  const Expr* callee;
  Arguments arguments;
};
struct FunctionLiteral {
  Arguments parameters;
  const Expr* body;
};
struct Let {
  Arguments bindings;
  const Expr* body;
};
struct AssertExpr {
  Arguments arguments;
  const Expr* body;
};  // body may be null
struct EchoExpr {
  Arguments arguments;
  const Expr* body;
};  // body may be null

// Elements of list comprehensions: they stand inside a Vector (or inside one
// another) and give any number of values.
struct ForElements {
  Arguments bindings;
  const Expr* body;
};
struct ForCHead {  // for (init; condition; update)
  Arguments init;
  const Expr* condition;
  Arguments update;
};
struct ForCElements {
  const ForCHead* head;  // apart, since it would make every Expr larger
  const Expr* body;
};
struct IfElements {
  const Expr* condition;
  const Expr* if_true;
  const Expr* if_false;  // may be null
};
struct EachElements {
  const Expr* body;
};
struct LetElements {
  Arguments bindings;
  const Expr* body;
};

struct Expr {
  std::variant<Undef, Bool, Number, String, Variable, Unary, Binary,
               Conditional, Vector, Numbers, Range, Index, Member, Call,
               FunctionLiteral, Let, AssertExpr, EchoExpr, ForElements,
               ForCElements, IfElements, EachElements, LetElements>
      node;
  SourceRange range;
};

struct Statement;
using Statements = std::span<const Statement* const>;

// The modifiers in front of an instantiation.
struct Modifiers {
  bool root = false;        // !
  bool highlight = false;   // #
  bool background = false;  // %
};

struct Assignment {
  std::string_view name;
  const Expr* value;
};
struct FunctionDefinition {
  std::string_view name;
  Arguments parameters;
  const Expr* body;
};
struct ModuleDefinition {
  std::string_view name;
  Arguments parameters;
  Statements body;
};
struct Instantiation {  // `name(arguments) children`
  std::string_view name;
  Arguments arguments;
  Statements children;  // of `{ … }` or the one statement that follows
  Modifiers modifiers;
};
struct IfElse {
  const Expr* condition;
  Statements if_true;
  Statements if_false;
  bool has_else = false;  // `else;` has no statements
  Modifiers modifiers;
};
struct Statement {
  std::variant<Assignment, FunctionDefinition, ModuleDefinition, Instantiation,
               IfElse>
      node;
  SourceRange range;
};

// `use <file>`.
struct Use {
  std::string_view file;  // path; as written where no file was found
  SourceRange range;
  bool is_found;
};

// One program: a main file with all that it includes, or a used file.
// Statements stand in the order of the text; a variable assigned twice stands
// twice (the evaluator applies "last value, first place").
struct Program {
  std::shared_ptr<Arena> arena;
  const Source* source = nullptr;  // the main file
  Statements statements;
  // In the order in which names are looked up: the last `use` first, a file
  // used twice where its last `use` puts it. Fonts stand in `fonts` instead.
  std::span<const Use> uses;
  std::span<const Use> fonts;  // `use <….ttf>`, in the order of the text
  std::optional<NewerSyntax> newer = {};  // the first place of that kind
};

}  // namespace lamina::ast
