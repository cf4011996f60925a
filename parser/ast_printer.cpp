#include "parser/ast_printer.h"

#include <cmath>
#include <variant>

#include "base/text.h"
#include "parser/customizer.h"
#include "parser/tree_facts.h"

namespace lamina::ast {

std::string_view symbol(BinaryOp op) {
  switch (op) {
    case BinaryOp::kOr:
      return "||";
    case BinaryOp::kAnd:
      return "&&";
    case BinaryOp::kEqual:
      return "==";
    case BinaryOp::kNotEqual:
      return "!=";
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
  }
  return "";
}

namespace {

char symbol(UnaryOp op) {
  switch (op) {
    case UnaryOp::kNot:
      return '!';
    case UnaryOp::kNegate:
      return '-';
    case UnaryOp::kBitNot:
      return '~';
  }
  return ' ';
}

// Writes expressions to the end of a text.
class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(std::string& text) : text_(text) {}

  void print(const Expr& expr) { std::visit(*this, expr.node); }

  void print(const Arguments& arguments) {
    const char* separator = "";
    for (const Argument& argument : arguments) {
      text_ += separator;
      separator = ", ";
      text_ += argument.name;
      if (argument.value == nullptr) continue;
      if (!argument.name.empty()) text_ += " = ";
      print(*argument.value);
    }
  }

  void operator()(const Undef&) { text_ += "undef"; }
  void operator()(const Bool& node) { text_ += node.value ? "true" : "false"; }
  void operator()(const Number& node) { append_number(node.value, text_); }
  void operator()(const String& node) { append_quoted(node.value, text_); }
  void operator()(const Variable& node) { text_ += node.name; }

  void operator()(const Unary& node) {
    text_ += symbol(node.op);
    print(*node.operand);
  }

  void operator()(const Binary& node) {
    text_ += '(';
    print(*node.left);
    text_ += ' ';
    text_ += symbol(node.op);
    text_ += ' ';
    print(*node.right);
    text_ += ')';
  }

  void operator()(const Conditional& node) {
    text_ += '(';
    print(*node.condition);
    text_ += " ? ";
    print(*node.if_true);
    text_ += " : ";
    print(*node.if_false);
    text_ += ')';
  }

  void operator()(const Vector& node) {
    text_ += '[';
    const char* separator = "";
    for (const Expr* element : node.elements) {
      text_ += separator;
      separator = ", ";
      print(*element);
    }
    text_ += ']';
  }

  void operator()(const Numbers& node) {
    text_ += '[';
    const char* separator = "";
    for (const double value : node.values) {
      text_ += separator;
      separator = ", ";
      // The sign was an operator of its own: -0 shows it.
      if (std::signbit(value)) text_ += '-';
      append_number(std::fabs(value), text_);
    }
    text_ += ']';
  }

  void operator()(const Range& node) {
    text_ += '[';
    print(*node.begin);
    if (node.step != nullptr) {
      text_ += " : ";
      print(*node.step);
    }
    text_ += " : ";
    print(*node.end);
    text_ += ']';
  }

  void operator()(const Index& node) {
    print(*node.object);
    text_ += '[';
    print(*node.index);
    text_ += ']';
  }

  void operator()(const Member& node) {
    print(*node.object);
    text_ += '.';
    text_ += node.name;
  }

  void operator()(const Call& node) {
    const bool is_name = std::holds_alternative<Variable>(node.callee->node);
    if (!is_name) text_ += '(';
    print(*node.callee);
    if (!is_name) text_ += ')';
    text_ += '(';
    print(node.arguments);
    text_ += ')';
  }

  void operator()(const FunctionLiteral& node) {
    print_head("function(", node.parameters);
    print(*node.body);
  }

  void operator()(const Let& node) {
    print_head("let(", node.bindings);
    print(*node.body);
  }

  void operator()(const AssertExpr& node) {
    print_check("assert(", node.arguments, node.body);
  }
  void operator()(const EchoExpr& node) {
    print_check("echo(", node.arguments, node.body);
  }

  // A loop over several variables is a loop in a loop.
  void operator()(const ForElements& node) {
    if (node.bindings.empty()) {
      print(*node.body);
      return;
    }
    for (std::size_t i = 0; i < node.bindings.size(); ++i) {
      print_head(i == 0 ? "for(" : "(for(", node.bindings.subspan(i, 1));
    }
    print_in_parentheses(*node.body);
    text_.append(node.bindings.size() - 1, ')');
  }

  void operator()(const ForCElements& node) {
    text_ += "for(";
    print(node.head->init);
    text_ += ';';
    print(*node.head->condition);
    text_ += ';';
    print(node.head->update);
    text_ += ") ";
    print(*node.body);
  }

  void operator()(const IfElements& node) {
    text_ += "if(";
    print(*node.condition);
    text_ += ") ";
    print_in_parentheses(*node.if_true);
    if (node.if_false == nullptr) return;
    text_ += " else ";
    print_in_parentheses(*node.if_false);
  }

  void operator()(const EachElements& node) {
    text_ += "each ";
    print_in_parentheses(*node.body);
  }

  void operator()(const LetElements& node) {
    print_head("let(", node.bindings);
    print_in_parentheses(*node.body);
  }

 private:
  void print_head(const char* head, const Arguments& arguments) {
    text_ += head;
    print(arguments);
    text_ += ") ";
  }

  void print_in_parentheses(const Expr& expr) {
    text_ += '(';
    print(expr);
    text_ += ')';
  }

  void print_check(const char* head, const Arguments& arguments,
                   const Expr* body) {
    text_ += head;
    print(arguments);
    text_ += ')';
    if (body == nullptr) return;
    text_ += ' ';
    print(*body);
  }

  std::string& text_;
};

class StatementPrinter {
 public:
  StatementPrinter(std::string& text, const Customizer& customizer)
      : text_(text), expressions_(text), customizer_(customizer) {}

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
  void print_function(const Statement& statement, const std::string& indent) {
    const auto* node = std::get_if<FunctionDefinition>(&statement.node);
    if (node == nullptr) return;
    print_definition(indent + "function ", node->name, node->parameters);
    text_ += " = ";
    expressions_.print(*node->body);
    text_ += ";\n";
  }

  void print_module(const Statement& statement, const std::string& indent) {
    const auto* node = std::get_if<ModuleDefinition>(&statement.node);
    if (node == nullptr) return;
    print_definition(indent + "module ", node->name, node->parameters);
    text_ += " {\n";
    print_scope(node->body, indent + "\t");
    text_ += indent + "}\n";
  }

  void print_definition(const std::string& head, std::string_view name,
                        const Arguments& parameters) {
    text_ += head;
    text_ += name;
    text_ += '(';
    expressions_.print(parameters);
    text_ += ')';
  }

  void print_variable(const Statement& statement, const std::string& indent) {
    const auto& node = std::get<Assignment>(statement.node);
    if (indent.empty()) print_comment(customizer_.comment_of(statement));
    text_ += indent;
    text_ += node.name;
    text_ += " = ";
    expressions_.print(*node.value);
    text_ += ";\n";
  }

  void print_comment(const ParameterComment& comment) {
    if (!comment.is_parameter) return;
    if (comment.has_group) print_annotation("Group", comment.group);
    if (!comment.description.empty()) {
      print_annotation("Description", comment.description);
    }
    text_ += "//Parameter(" + comment.values + ")\n";
  }

  void print_annotation(const char* name, const std::string& content) {
    text_ += std::string("//") + name + "(";
    append_quoted(content, text_);
    text_ += ")\n";
  }

  void print_instantiation(const Statement& statement,
                           const std::string& indent, Place place) {
    const auto* plain = std::get_if<Instantiation>(&statement.node);
    const auto* if_else = std::get_if<IfElse>(&statement.node);
    if (plain == nullptr && if_else == nullptr) return;
    if (place == Place::kOwnLine) text_ += indent;
    if (plain != nullptr) {
      text_ += plain->name;
      text_ += '(';
      expressions_.print(plain->arguments);
      text_ += ')';
      print_children(plain->children, indent, ";\n");
      return;
    }
    text_ += "if(";
    expressions_.print(*if_else->condition);
    text_ += ')';
    print_children(if_else->if_true, indent, ";\n");
    if (!if_else->has_else) return;
    text_ += indent + "else";
    print_children(if_else->if_false, indent, ";");
  }

  // Only a lone instantiation stands without braces.
  void print_children(Statements children, const std::string& indent,
                      const char* none) {
    const bool is_lone = children.size() == 1 &&
                         !std::holds_alternative<Assignment>(children[0]->node);
    if (children.empty()) {
      text_ += none;
    } else if (is_lone) {
      text_ += ' ';
      print_scope(children, indent, Place::kBehindParent);
    } else {
      text_ += " {\n";
      print_scope(children, indent + "\t");
      text_ += indent + "}\n";
    }
  }

  std::string& text_;
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
