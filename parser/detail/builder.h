#pragma once
// Makes the nodes of the tree, called by the grammar's actions.
//
// After a syntax error the scratch stacks may keep what a broken construct
// left; the tree is thrown away then, and what lies above a list's beginning
// is never used.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/source.h"
#include "parser/ast.h"
#include "parser/detail/symbol_values.h"
#include "parser/detail/syntax_errors.h"

namespace lamina::detail {

class Builder {
 public:
  // source    the main text of the program
  // user      the file whose `use` asks for it; null for a main file
  // language  whose words messages have, and whose errors are errors
  // files     what fonts may be read
  Builder(const Source& source, const Source* user, Language language,
          SyntaxErrors& errors, const FileAccess& files,
          Diagnostics& diagnostics);

  Arena& arena() { return arena_; }

  // The finished program. Throws the first error, if there was one.
  ast::Program finish();

  // --- Statements ----------------------------------------------------------

  void add_use(const ast::Use& use);
  void end_file() { file_ended_ = true; }
  // Remembers the first place that 2021.01 cannot parse.
  void note_newer(SourceRange range, std::string_view what) {
    if (!program_.newer) program_.newer = NewerSyntax{range, what};
  }

  // Reports a comma that 2021.01 passes over, where 2026 does not.
  void reject_since_2026(SourceRange comma);

  // Between them stand the statements of one scope.
  Scope open_scope();

  void add_statement(const ast::Statement* statement);  // null: none
  void add_assignment(SourceRange name, Tree value, SourceRange range);
  void add_function(SourceRange name, List parameters, Tree body,
                    SourceRange range);
  void add_module(SourceRange name, List parameters, Scope scope,
                  SourceRange range);
  ast::Statement* make_instantiation(SourceRange name, List arguments,
                                     SourceRange range);
  ast::Statement* set_children(ast::Statement* instantiation, Scope scope);
  ast::Statement* make_if(Tree condition, Scope scope, SourceRange range);
  ast::Statement* set_else(ast::Statement* if_else, Scope scope);
  ast::Statement* set_modifier(ast::Statement* instantiation,
                               bool ast::Modifiers::*modifier);

  // OpenSCAD places a module and an `if` on the line of their closing
  // parenthesis. The range of the whole head shows more, so it is cut down to
  // the parenthesis only where their lines differ.
  SourceRange place_head(SourceRange keyword, SourceRange close) const;

  // --- Expressions ---------------------------------------------------------

  Tree no_tree() const { return {nullptr, 0}; }
  template <typename Node>
  Tree make_leaf(Node node, SourceRange range) {
    return make(node, 1, range);
  }
  // Conditional, Range, Index, EachElements, IfElements.
  template <typename Node, typename... Parts>
  Tree make_of(SourceRange range, Parts... parts) {
    return make(Node{parts.expr...}, std::max({parts.depth...}) + 1, range);
  }
  Tree make_unary(ast::UnaryOp op, Tree operand, SourceRange range);
  Tree make_binary(ast::BinaryOp op, Tree left, Tree right, SourceRange range);
  Tree make_member(Tree object, SourceRange name, SourceRange range);
  Tree make_call(Tree callee, List arguments, SourceRange range);
  Tree make_for_c(List init, Tree condition, List update, Tree body,
                  SourceRange range);
  // FunctionLiteral, Let, AssertExpr, EchoExpr, LetElements, ForElements.
  template <typename Node>
  Tree make_body(List arguments, Tree body, SourceRange range) {
    const std::uint32_t depth = std::max(arguments.depth, body.depth);
    return make(Node{close_arguments(arguments), body.expr}, depth + 1, range);
  }

  // A vector of number literals alone is made anew, as Numbers, in the memory
  // that its elements took: `mark` is the state of the arena before them.
  Arena::Mark mark() const { return arena_.mark(); }
  Tree make_vector(Arena::Mark mark, List elements, SourceRange range);

  List start_elements(Tree first);
  List append_element(List elements, Tree element);

  // Arguments of calls and parameters of definitions. An argument goes to the
  // scratch stack when it is read; its value is its depth.
  std::uint32_t add_argument(SourceRange name, Tree value, SourceRange range);
  List start_arguments() const;
  List start_arguments(std::uint32_t first_depth) const;
  List append_argument(List arguments, std::uint32_t depth) const;

 private:
  template <typename Node>
  Tree make(Node node, std::uint32_t depth, SourceRange range) {
    if (depth > kDeepestTree) errors_.report_depth(range);
    return {arena_.make(ast::Expr{node, range}), depth};
  }

  // Moves what stands on a scratch stack from `begin` on to the arena.
  template <typename T>
  std::span<const T> take_top(std::vector<T>& stack, std::uint32_t begin) {
    const auto top = arena_.copy(std::span<const T>(stack).subspan(begin));
    stack.resize(begin);
    return top;
  }
  ast::Arguments close_arguments(List arguments) {
    return take_top(arguments_, arguments.begin);
  }
  ast::Statements close_scope(Scope scope);
  // Fills numbers_ from elements_; false if one is not a number literal.
  bool collect_numbers(std::uint32_t begin);
  void warn_overwritten(std::string_view name, SourceRange before,
                        SourceRange now);

  ast::Program program_;
  Arena& arena_;
  const Source* user_;
  Language language_;
  SyntaxErrors& errors_;
  const FileAccess& file_access_;
  Diagnostics& diagnostics_;

  std::vector<const ast::Expr*> elements_;
  std::vector<ast::Argument> arguments_;
  std::vector<const ast::Statement*> statements_;
  std::vector<double> numbers_;
  std::vector<ast::Use> uses_;
  std::vector<ast::Use> fonts_;

  // Where each name of each scope was assigned last.
  struct ScopedName {
    std::uint32_t scope;
    std::string_view name;
    bool operator==(const ScopedName&) const = default;
  };
  struct ScopedNameHash {
    std::size_t operator()(const ScopedName& key) const;
  };
  std::unordered_map<ScopedName, SourceRange, ScopedNameHash> assigned_;
  std::uint32_t scope_ = 0;
  std::uint32_t scope_count_ = 1;
  bool file_ended_ = false;
};

}  // namespace lamina::detail
