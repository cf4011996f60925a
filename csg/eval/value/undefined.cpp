#include "csg/eval/value/undefined.h"

#include <fmt/format.h>

#include "parser/ast_printer.h"

namespace lamina::csg {

Value undefined(ast::BinaryOp op, const Value& left, const Value& right,
                Reason& reason) {
  reason.text =
      fmt::format("undefined operation ({} {} {})", type_name(left.type()),
                  ast::symbol(op), type_name(right.type()));
  return Value();
}

}  // namespace lamina::csg
