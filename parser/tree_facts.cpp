#include "parser/tree_facts.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <variant>

namespace lamina::ast {
namespace {

bool is_literal_or_absent(const Expr* expr) {
  return expr == nullptr || is_literal(*expr);
}

bool is_arithmetic(BinaryOp op) { return op >= BinaryOp::kAdd; }

ValueType type_of_binary(const Binary& binary) {
  const ValueType left = type_of(*binary.left);
  const ValueType right = type_of(*binary.right);
  if (left == ValueType::kAny || right == ValueType::kAny) {
    return ValueType::kAny;
  }
  if (!is_arithmetic(binary.op)) return ValueType::kBool;
  const bool are_numbers =
      left == ValueType::kNumber && right == ValueType::kNumber;
  return are_numbers ? left : ValueType::kAny;
}

ValueType type_of_unary(const Unary& unary) {
  const ValueType operand = type_of(*unary.operand);
  if (operand == ValueType::kAny) return operand;
  if (unary.op == UnaryOp::kNot) return ValueType::kBool;
  const bool can_negate =
      operand == ValueType::kNumber || operand == ValueType::kVector;
  return can_negate ? operand : ValueType::kAny;
}

}  // namespace

bool is_literal(const Expr& expr) {
  if (const auto* unary = std::get_if<Unary>(&expr.node)) {
    return is_literal(*unary->operand);
  }
  if (const auto* range = std::get_if<Range>(&expr.node)) {
    return is_literal(*range->begin) && is_literal_or_absent(range->step) &&
           is_literal(*range->end);
  }
  if (const auto* vector = std::get_if<Vector>(&expr.node)) {
    return std::all_of(vector->elements.begin(), vector->elements.end(),
                       [](const Expr* e) { return is_literal(*e); });
  }
  return std::holds_alternative<Undef>(expr.node) ||
         std::holds_alternative<Bool>(expr.node) ||
         std::holds_alternative<Number>(expr.node) ||
         std::holds_alternative<Numbers>(expr.node) ||
         std::holds_alternative<String>(expr.node);
}

ValueType type_of(const Expr& expr) {
  if (const auto* unary = std::get_if<Unary>(&expr.node)) {
    return type_of_unary(*unary);
  }
  if (const auto* binary = std::get_if<Binary>(&expr.node)) {
    return type_of_binary(*binary);
  }
  if (std::holds_alternative<Bool>(expr.node)) return ValueType::kBool;
  if (std::holds_alternative<Number>(expr.node)) return ValueType::kNumber;
  if (std::holds_alternative<String>(expr.node)) return ValueType::kString;
  if (std::holds_alternative<Range>(expr.node)) return ValueType::kRange;
  if (std::holds_alternative<Vector>(expr.node) ||
      std::holds_alternative<Numbers>(expr.node)) {
    return ValueType::kVector;
  }
  return ValueType::kAny;
}

std::optional<double> number_of(const Expr& expr) {
  if (const auto* number = std::get_if<Number>(&expr.node)) {
    return number->value;
  }
  const auto* unary = std::get_if<Unary>(&expr.node);
  if (unary == nullptr || unary->op != UnaryOp::kNegate) return std::nullopt;
  const std::optional<double> operand = number_of(*unary->operand);
  return operand ? std::optional(-*operand) : std::nullopt;
}

std::optional<std::vector<double>> numbers_of(const Expr& expr) {
  if (const auto* numbers = std::get_if<Numbers>(&expr.node)) {
    return std::vector(numbers->values.begin(), numbers->values.end());
  }
  const auto* vector = std::get_if<Vector>(&expr.node);
  if (vector == nullptr) return std::nullopt;
  std::vector<double> numbers;
  for (const Expr* element : vector->elements) {
    const std::optional<double> number = number_of(*element);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::size_t> assignments_that_count(Statements statements) {
  std::vector<std::size_t> last;
  std::unordered_map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const auto* assignment = std::get_if<Assignment>(&statements[i]->node);
    if (assignment == nullptr) continue;
    const auto [place, is_new] =
        places.try_emplace(assignment->name, last.size());
    if (is_new) {
      last.push_back(i);
    } else {
      last[place->second] = i;
    }
  }
  return last;
}

}  // namespace lamina::ast
