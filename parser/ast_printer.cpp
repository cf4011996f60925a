#include "parser/ast_printer.h"

#include <array>
#include <cmath>
#include <variant>

#include "base/text.h"

namespace lamina::ast {

std::string_view symbol(BinaryOp op) {
  // In the order of the operators.
  constexpr std::array<std::string_view, 18> kSymbols = {
      "||", "&&", "==", "!=", "<", "<=", ">", ">=", "|",
      "&",  "<<", ">>", "+",  "-", "*",  "/", "%",  "^"};
  return kSymbols[static_cast<std::size_t>(op)];
}

namespace {

char symbol(UnaryOp op) {
  return std::string_view("!-~")[static_cast<std::size_t>(op)];
}

// Writes expressions to the end of a text.
class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(std::string& text) : text_(text) {}

  // Prints texts, expressions and arguments one after the other.
  template <typename... Parts>
  void print(const Parts&... parts) {
    (print_part(parts), ...);
  }

  void operator()(const Undef&) { print("undef"); }
  void operator()(const Bool& node) { print(node.value ? "true" : "false"); }
  void operator()(const Number& node) { append_number(node.value, text_); }
  void operator()(const String& node) { print(in_quotes(node.value)); }
  void operator()(const Variable& node) { print(node.name); }

  void operator()(const Unary& node) { print(symbol(node.op), *node.operand); }

  void operator()(const Binary& node) {
    print('(', *node.left, ' ', symbol(node.op), ' ', *node.right, ')');
  }

  void operator()(const Conditional& node) {
    print('(', *node.condition, " ? ", *node.if_true, " : ", *node.if_false,
          ')');
  }

  void operator()(const Vector& node) {
    print('[');
    const char* separator = "";
    for (const Expr* element : node.elements) {
      print(separator, *element);
      separator = ", ";
    }
    print(']');
  }

  void operator()(const Numbers& node) {
    print('[');
    const char* separator = "";
    for (const double value : node.values) {
      // The sign was an operator of its own: -0 shows it.
      print(separator, std::signbit(value) ? "-" : "");
      separator = ", ";
      append_number(std::fabs(value), text_);
    }
    print(']');
  }

  void operator()(const Range& node) {
    print('[', *node.begin, " : ");
    if (node.step != nullptr) print(*node.step, " : ");
    print(*node.end, ']');
  }

  void operator()(const Index& node) {
    print(*node.object, '[', *node.index, ']');
  }

  void operator()(const Member& node) { print(*node.object, '.', node.name); }

  void operator()(const Call& node) {
    const bool is_name = std::holds_alternative<Variable>(node.callee->node);
    if (is_name) {
      print(*node.callee);
    } else {
      print_in_parentheses(*node.callee);
    }
    print('(', node.arguments, ')');
  }

  void operator()(const FunctionLiteral& node) {
    print("function(", node.parameters, ") ", *node.body);
  }

  void operator()(const Let& node) {
    print("let(", node.bindings, ") ", *node.body);
  }

  void operator()(const AssertExpr& node) {
    print("assert(", node.arguments, ')');
    if (node.body != nullptr) print(' ', *node.body);
  }
  void operator()(const EchoExpr& node) {
    print("echo(", node.arguments, ')');
    if (node.body != nullptr) print(' ', *node.body);
  }

  // A loop over several variables is a loop in a loop.
  void operator()(const ForElements& node) {
    if (node.bindings.empty()) return print(*node.body);
    for (std::size_t i = 0; i < node.bindings.size(); ++i) {
      print(i == 0 ? "for(" : "(for(", node.bindings.subspan(i, 1), ") ");
    }
    print_in_parentheses(*node.body);
    text_.append(node.bindings.size() - 1, ')');
  }

  void operator()(const ForCElements& node) {
    const ForCHead& head = *node.head;
    print("for(", head.init, ';', *head.condition, ';', head.update, ") ",
          *node.body);
  }

  void operator()(const IfElements& node) {
    print("if(", *node.condition, ") ");
    print_in_parentheses(*node.if_true);
    if (node.if_false == nullptr) return;
    print(" else ");
    print_in_parentheses(*node.if_false);
  }

  void operator()(const EachElements& node) {
    print("each ");
    print_in_parentheses(*node.body);
  }

  void operator()(const LetElements& node) {
    print("let(", node.bindings, ") ");
    print_in_parentheses(*node.body);
  }

 private:
  void print_part(char sign) { text_ += sign; }
  void print_part(std::string_view text) { text_ += text; }
  void print_part(const Expr& expr) { std::visit(*this, expr.node); }
  void print_part(const Arguments& arguments) {
    const char* separator = "";
    for (const Argument& argument : arguments) {
      print(separator, argument.name);
      separator = ", ";
      if (argument.value == nullptr) continue;
      print(argument.name.empty() ? "" : " = ", *argument.value);
    }
  }

  void print_in_parentheses(const Expr& expr) { print('(', expr, ')'); }

  std::string& text_;
};

}  // namespace

void append_expression(const Expr& expression, std::string& text) {
  ExpressionPrinter(text).print(expression);
}

void append_expression(const FunctionLiteral& function, std::string& text) {
  ExpressionPrinter{text}(function);
}

void append_arguments(const Arguments& arguments, std::string& text) {
  ExpressionPrinter(text).print(arguments);
}

}  // namespace lamina::ast
