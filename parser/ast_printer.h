#pragma once
// Syntax trees as text: what `-o x.ast` writes and how a function value shows
// itself.
//
// The text is exactly that of OpenSCAD 2021.01. It lists a scope's functions,
// modules, variables and instantiations in this order, a variable once (in the
// place of its first assignment, with its last value), without modifiers.
// Recursion is as deep as the tree.

#include <string>
#include <string_view>

#include "parser/ast.h"

namespace lamina::ast {

// The whole program, with the customizer's comments (`//Parameter(…)`) over
// the variables of the main file.
std::string print(const Program& program);

// Appends one expression: `(a + 1)`, `function(x) x`.
void append_expression(const Expr& expression, std::string& text);
void append_expression(const FunctionLiteral& function, std::string& text);

// The operator as it is written: "<=".
std::string_view symbol(BinaryOp op);

}  // namespace lamina::ast
