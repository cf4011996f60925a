#pragma once
// Programs as text: what `-o x.ast` writes.
//
// The text is exactly that of OpenSCAD 2021.01. It lists a scope's functions,
// modules, variables and instantiations in this order, a variable once (in the
// place of its first assignment, with its last value), without modifiers.
// Recursion is as deep as the tree.

#include <string>

#include "parser/ast.h"

namespace lamina::ast {

// Prints the whole program, with the customizer's comments (`//Parameter(…)`)
// over the variables of the main file.
std::string print(const Program& program);

}  // namespace lamina::ast
