#pragma once
// The warnings of operations that have no meaning.

#include <string>

#include "csg/eval/value/value.h"
#include "parser/ast.h"

namespace lamina::csg {

// Why an operation has no meaning, in the words of OpenSCAD's warning; empty
// where it has one.
struct Reason {
  std::string text;
  // What OpenSCAD warns of before, naming no place; mostly empty.
  std::string said_before;
};

// undef; leaves "undefined operation (number + string)" in `reason`.
Value undefined(ast::BinaryOp op, const Value& left, const Value& right,
                Reason& reason);

}  // namespace lamina::csg
