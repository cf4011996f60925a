#include "parser/detail/literal.h"

#include <algorithm>
#include <variant>

namespace lamina::detail {
namespace {

bool is_literal_or_absent(const ast::Expr* expr) {
  return expr == nullptr || is_literal(*expr);
}

bool is_arithmetic(ast::BinaryOp op) { return op >= ast::BinaryOp::kAdd; }

std::optional<ValueType> type_of_binary(const ast::Binary& binary) {
  const std::optional<ValueType> left = type_of(*binary.left);
  const std::optional<ValueType> right = type_of(*binary.right);
  if (!left || !right) return std::nullopt;
  if (!is_arithmetic(binary.op)) return ValueType::kBool;
  const bool are_numbers =
      left == ValueType::kNumber && right == ValueType::kNumber;
  return are_numbers ? left : std::nullopt;
}

std::optional<ValueType> type_of_unary(const ast::Unary& unary) {
  const std::optional<ValueType> operand = type_of(*unary.operand);
  if (unary.op == ast::UnaryOp::kNot && operand) return ValueType::kBool;
  const bool can_negate =
      operand == ValueType::kNumber || operand == ValueType::kVector;
  return can_negate ? operand : std::nullopt;
}

}  // namespace

bool is_literal(const ast::Expr& expr) {
  if (const auto* unary = std::get_if<ast::Unary>(&expr.node)) {
    return is_literal(*unary->operand);
  }
  if (const auto* range = std::get_if<ast::Range>(&expr.node)) {
    return is_literal(*range->begin) && is_literal_or_absent(range->step) &&
           is_literal(*range->end);
  }
  if (const auto* vector = std::get_if<ast::Vector>(&expr.node)) {
    return std::all_of(vector->elements.begin(), vector->elements.end(),
                       [](const ast::Expr* e) { return is_literal(*e); });
  }
  return std::holds_alternative<ast::Undef>(expr.node) ||
         std::holds_alternative<ast::Bool>(expr.node) ||
         std::holds_alternative<ast::Number>(expr.node) ||
         std::holds_alternative<ast::Numbers>(expr.node) ||
         std::holds_alternative<ast::String>(expr.node);
}

std::optional<ValueType> type_of(const ast::Expr& expr) {
  if (const auto* unary = std::get_if<ast::Unary>(&expr.node)) {
    return type_of_unary(*unary);
  }
  if (const auto* binary = std::get_if<ast::Binary>(&expr.node)) {
    return type_of_binary(*binary);
  }
  if (std::holds_alternative<ast::Bool>(expr.node)) return ValueType::kBool;
  if (std::holds_alternative<ast::Number>(expr.node)) return ValueType::kNumber;
  if (std::holds_alternative<ast::String>(expr.node)) return ValueType::kString;
  if (std::holds_alternative<ast::Range>(expr.node)) return ValueType::kRange;
  if (std::holds_alternative<ast::Vector>(expr.node) ||
      std::holds_alternative<ast::Numbers>(expr.node)) {
    return ValueType::kVector;
  }
  return std::nullopt;
}

}  // namespace lamina::detail
