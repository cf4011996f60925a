#include "parser/ast_printer.h"

#include <array>
#include <cmath>
#include <variant>

#include "base/text.h"
#include "parser/customizer.h"
#include "parser/tree_facts.h"

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

class StatementPrinter {
 public:
  StatementPrinter(std::string& text, const Customizer& customizer)
      : expressions_(text), customizer_(customizer) {}

  enum class Place { kOwnLine, kBehindParent };

  void print_scope(Statements statements, const std::string& indent,
                   Place place = Place::kOwnLine) {
    for (const Statement* statement : statements) {
      print_function(*statement, indent);
    }
    for (const Statement* statement : statements) {
      print_module(*statement, indent);
    }
    for (const std::size_t i : assignments_that_count(statements)) {
      print_variable(*statements[i], indent);
    }
    for (const Statement* statement : statements) {
      print_instantiation(*statement, indent, place);
    }
  }

 private:
  template <typename... Parts>
  void print(const Parts&... parts) {
    expressions_.print(parts...);
  }

  void print_function(const Statement& statement, const std::string& indent) {
    const auto* node = std::get_if<FunctionDefinition>(&statement.node);
    if (node == nullptr) return;
    print(indent, "function ", node->name, '(', node->parameters,
          ") = ", *node->body, ";\n");
  }

  void print_module(const Statement& statement, const std::string& indent) {
    const auto* node = std::get_if<ModuleDefinition>(&statement.node);
    if (node == nullptr) return;
    print(indent, "module ", node->name, '(', node->parameters, ") {\n");
    print_scope(node->body, indent + "\t");
    print(indent, "}\n");
  }

  void print_variable(const Statement& statement, const std::string& indent) {
    const auto& node = std::get<Assignment>(statement.node);
    if (indent.empty()) print_comment(customizer_.comment_of(statement));
    print(indent, node.name, " = ", *node.value, ";\n");
  }

  void print_comment(const ParameterComment& comment) {
    if (!comment.is_parameter) return;
    if (comment.has_group) print_annotation("Group", comment.group);
    if (!comment.description.empty()) {
      print_annotation("Description", comment.description);
    }
    print("//Parameter(", comment.values, ")\n");
  }

  void print_annotation(std::string_view name, const std::string& content) {
    print("//", name, '(', in_quotes(content), ")\n");
  }

  void print_instantiation(const Statement& statement,
                           const std::string& indent, Place place) {
    const auto* plain = std::get_if<Instantiation>(&statement.node);
    const auto* if_else = std::get_if<IfElse>(&statement.node);
    if (plain == nullptr && if_else == nullptr) return;
    if (place == Place::kOwnLine) print(indent);
    if (plain != nullptr) {
      print(plain->name, '(', plain->arguments, ')');
      print_children(plain->children, indent, ";\n");
      return;
    }
    print("if(", *if_else->condition, ')');
    print_children(if_else->if_true, indent, ";\n");
    if (!if_else->has_else) return;
    print(indent, "else");
    print_children(if_else->if_false, indent, ";");
  }

  // Only a lone instantiation stands without braces.
  void print_children(Statements children, const std::string& indent,
                      std::string_view none) {
    const bool is_lone = children.size() == 1 &&
                         !std::holds_alternative<Assignment>(children[0]->node);
    if (children.empty()) {
      print(none);
    } else if (is_lone) {
      print(' ');
      print_scope(children, indent, Place::kBehindParent);
    } else {
      print(" {\n");
      print_scope(children, indent + "\t");
      print(indent, "}\n");
    }
  }

  ExpressionPrinter expressions_;
  const Customizer& customizer_;
};

}  // namespace

std::string print(const Program& program) {
  std::string text;
  const Customizer customizer = Customizer::read(program);
  StatementPrinter(text, customizer).print_scope(program.statements, "");
  return text;
}

void append_expression(const Expr& expression, std::string& text) {
  ExpressionPrinter(text).print(expression);
}

void append_expression(const FunctionLiteral& function, std::string& text) {
  ExpressionPrinter{text}(function);
}

}  // namespace lamina::ast
