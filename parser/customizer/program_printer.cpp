#include "parser/customizer/program_printer.h"

#include <variant>

#include "base/text.h"
#include "parser/ast_printer.h"
#include "parser/customizer/customizer.h"
#include "parser/tree_facts.h"

namespace lamina::ast {
namespace {

class StatementPrinter {
 public:
  StatementPrinter(std::string& text, const Customizer& customizer)
      : text_(text), customizer_(customizer) {}

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
  // Prints texts, expressions and arguments one after the other.
  template <typename... Parts>
  void print(const Parts&... parts) {
    (print_part(parts), ...);
  }
  void print_part(char sign) { text_ += sign; }
  void print_part(std::string_view text) { text_ += text; }
  void print_part(const Expr& expr) { append_expression(expr, text_); }
  void print_part(const Arguments& list) { append_arguments(list, text_); }

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

  std::string& text_;
  const Customizer& customizer_;
};

}  // namespace

std::string print(const Program& program) {
  std::string text;
  const Customizer customizer = Customizer::read(program);
  StatementPrinter(text, customizer).print_scope(program.statements, "");
  return text;
}

}  // namespace lamina::ast
