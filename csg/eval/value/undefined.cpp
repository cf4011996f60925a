#include "csg/eval/value/undefined.h"

#include <fmt/format.h>

namespace lamina::csg {

using ast::BinaryOp;

std::string_view symbol(BinaryOp op) {
  switch (op) {
    case BinaryOp::kLess:
      return "<";
    case BinaryOp::kLessEqual:
      return "<=";
    case BinaryOp::kGreater:
      return ">";
    case BinaryOp::kGreaterEqual:
      return ">=";
    case BinaryOp::kBitOr:
      return "|";
    case BinaryOp::kBitAnd:
      return "&";
    case BinaryOp::kShiftLeft:
      return "<<";
    case BinaryOp::kShiftRight:
      return ">>";
    case BinaryOp::kAdd:
      return "+";
    case BinaryOp::kSubtract:
      return "-";
    case BinaryOp::kMultiply:
      return "*";
    case BinaryOp::kDivide:
      return "/";
    case BinaryOp::kModulo:
      return "%";
    case BinaryOp::kPower:
      return "^";
    default:
      return "";
  }
}

Value undefined(BinaryOp op, const Value& left, const Value& right,
                Reason& reason) {
  reason.text =
      fmt::format("undefined operation ({} {} {})", type_name(left.type()),
                  symbol(op), type_name(right.type()));
  return Value();
}

}  // namespace lamina::csg
