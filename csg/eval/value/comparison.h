#pragma once
// Which values are equal, and which come before others.

#include "csg/eval/value/undefined.h"
#include "csg/eval/value/value.h"
#include "parser/ast.h"

namespace lamina::csg {

// left == right; never undefined.
bool are_equal(const Value& left, const Value& right);

// left < right, false where that is undefined (min, max and search use it).
bool is_less(const Value& left, const Value& right);

// By `<`, `<=`, `>` or `>=`; undef with its reason where values do not compare.
Value compare(ast::BinaryOp op, const Value& left, const Value& right,
              Reason& reason);

}  // namespace lamina::csg
