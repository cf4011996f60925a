#pragma once
// Expressions as text, as OpenSCAD 2021.01 writes them: in messages, for the
// values of functions, and in what `-o x.ast` writes
// (parser/customizer/program_printer.h). Recursion is as deep as the tree.

#include <string>
#include <string_view>

#include "parser/ast.h"

namespace lamina::ast {

// Appends one expression: `(a + 1)`, `function(x) x`.
void append_expression(const Expr& expression, std::string& text);
void append_expression(const FunctionLiteral& function, std::string& text);

// Appends arguments or parameters: `1, a = 2`.
void append_arguments(const Arguments& arguments, std::string& text);

// The operator as it is written: "<=".
std::string_view symbol(BinaryOp op);

}  // namespace lamina::ast
