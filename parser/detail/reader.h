#pragma once
// What the grammar builds with.
//
// Flex and Bison know tokens and productions; the Reader knows texts, places
// and trees. It feeds the scanner from the file being read, follows includes,
// turns byte counts into source ranges, and makes the nodes.
//
// Lists grow on one scratch stack per kind and move to the arena when their
// closing bracket is read. Brackets nest, so lists end in reverse order of
// their beginnings and a list is always the top of its stack. After a syntax
// error a stack may keep what a broken construct left; the tree is thrown away
// then, and what lies above a list's beginning is never used.
//
// Every expression knows its depth. Later passes recurse over trees, so a tree
// that their stack could not hold is an error here: a chain like `1 + 1 + …`
// is as deep as it is long, without ever filling the stack of the parser.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "parser/ast.h"
#include "parser/diagnostic.h"
#include "parser/source.h"

namespace lamina {
class Loader;
}

namespace lamina::detail {

// Greatest depth of a tree, and of the stack of the parser. A pass that needs
// up to 4 KiB a level fits in a stack of 1 GiB; OpenSCAD ends at 20000.
constexpr std::uint32_t kDeepestTree = 250'000;

// Errors after which a text is given up.
constexpr int kMostErrors = 20;

// Values of symbols. They stand in a union, so they have no initialisers.
struct Text {
  const char* data;
  std::size_t size;
};
struct Tree {
  const ast::Expr* expr;  // null: none
  std::uint32_t depth;
};
struct List {
  std::uint32_t begin;  // on the scratch stack; the end is its top
  std::uint32_t depth;  // of the deepest element
};
struct Scope {
  std::uint32_t begin;  // of its statements on the scratch stack
  std::uint32_t outer;  // id of the scope around it
};

class Reader {
 public:
  // user  the file whose `use` asks for `source`; null for a main file
  Reader(const Source& source, const Source* user, Loader& loader,
         Diagnostics& diagnostics);

  // The finished program. Throws the first error, if there was one.
  ast::Program finish();

  // --- For the scanner -----------------------------------------------------

  // Up to `most` bytes of the current text, 0 at its end.
  std::size_t feed(char* buffer, std::size_t most);

  // The next `size` bytes are read: their range.
  SourceRange take(std::uint32_t size) {
    File& file = files_.back();
    const std::uint32_t begin = file.position;
    file.position += size;
    return {file.source, begin, file.position};
  }
  SourceRange place() const;  // empty range where reading stands

  // Tokens of several parts: their beginning, and the range up to here.
  void begin_token(SourceRange range) { opening_ = token_begin_ = range; }
  SourceRange whole_token() const;

  // `include <…>` and `use <…>`.
  void set_file_name(std::string_view name) { file_name_ = name; }
  bool open_include();   // false: not found, a warning is reported
  bool close_include();  // false: the end of the main text
  ast::Use* find_use(SourceRange range);

  Text plain_string(SourceRange range) const;
  void add_to_string(std::string_view part) { string_ += part; }
  // Hexadecimal digits; what is no character becomes a blank.
  void add_code_point(const char* digits);
  // OpenSCAD places a string of several lines on its last one.
  void break_string(SourceRange range);
  Text take_string();

  // Brackets are counted to tell which one a text lacks.
  void open_bracket(SourceRange range) { brackets_.push_back(range); }
  void close_bracket();

  // False if the number is beyond double.
  bool read_number(const char* begin, const char* end, double& value) const;

  // --- Errors --------------------------------------------------------------

  // "Parser error: <message>" at `range`; hints are shown below the caret.
  void report_error(SourceRange range, std::string_view message,
                    std::vector<Note> hints);
  // At the token `range`, which the grammar calls `symbol`; what it could take
  // there is `expected`.
  void report_syntax_error(SourceRange range, std::string_view symbol,
                           std::vector<std::string_view> expected);

  // A text ended in a string or comment; OpenSCAD places that at the end, but
  // names of files (in `use` and `include`) where they begin.
  void report_unterminated(const char* what);
  void report_unterminated_name(const char* what);
  bool gave_up() const { return error_count_ >= kMostErrors; }

  // --- The stack of the parser ---------------------------------------------

  // A larger size for it; false, and an error, if it may not grow.
  bool grow_stack(std::ptrdiff_t& size);

  // Moves a part of it (0: states, 1: values, 2: ranges), `bytes` in use, to
  // memory for `size` items.
  template <int kPart, typename Item>
  void move_stack(Item*& items, std::ptrdiff_t bytes, std::ptrdiff_t size) {
    std::vector<std::byte> memory(static_cast<std::size_t>(size) *
                                  sizeof(Item));
    std::memcpy(memory.data(), items, static_cast<std::size_t>(bytes));
    stack_[kPart].swap(memory);
    items = reinterpret_cast<Item*>(stack_[kPart].data());
  }

  // --- Statements ----------------------------------------------------------

  void add_use(const ast::Use& use);
  void end_file() { file_ended_ = true; }

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
  // parenthesis. The range of the whole head tells more, so it is cut down to
  // the parenthesis only where their lines differ.
  SourceRange place_head(SourceRange keyword, SourceRange close) const;

  // --- Expressions ---------------------------------------------------------

  Tree no_tree() const { return {nullptr, 0}; }
  template <typename Node>
  Tree make_leaf(Node node, SourceRange range) {
    return make(node, 1, range);
  }
  Tree make_string(Text string, SourceRange range);
  Tree make_unary(ast::UnaryOp op, Tree operand, SourceRange range);
  Tree make_binary(ast::BinaryOp op, Tree left, Tree right, SourceRange range);
  Tree make_conditional(Tree condition, Tree if_true, Tree if_false,
                        SourceRange range);
  Tree make_range(Tree begin, Tree step, Tree end, SourceRange range);
  Tree make_index(Tree object, Tree index, SourceRange range);
  Tree make_member(Tree object, SourceRange name, SourceRange range);
  Tree make_call(Tree callee, List arguments, SourceRange range);
  Tree make_function(List parameters, Tree body, SourceRange range);
  Tree make_each(Tree body, SourceRange range);
  Tree make_if_elements(Tree condition, Tree if_true, Tree if_false,
                        SourceRange range);
  Tree make_for_c(List init, Tree condition, List update, Tree body,
                  SourceRange range);
  // Let, AssertExpr, EchoExpr, LetElements, ForElements.
  template <typename Node>
  Tree make_body(List arguments, Tree body, SourceRange range) {
    const std::uint32_t depth = std::max(arguments.depth, body.depth);
    return make(Node{close_arguments(arguments), body.expr}, depth + 1, range);
  }

  // A vector of number literals alone is made anew, as Numbers, in the memory
  // that its elements took: `mark` is the state of the arena before them.
  ast::Arena::Mark mark() const { return arena_.mark(); }
  Tree make_vector(ast::Arena::Mark mark, List elements, SourceRange range);

  List start_elements(Tree first);
  List append_element(List elements, Tree element);

  // Arguments of calls and parameters of definitions. An argument goes to the
  // scratch stack when it is read; its value is its depth.
  std::uint32_t add_argument(SourceRange name, Tree value, SourceRange range);
  List start_arguments() const;
  List start_arguments(std::uint32_t first_depth) const;
  List append_argument(List arguments, std::uint32_t depth) const;

 private:
  // A text being read.
  struct File {
    const Source* source;
    std::size_t size;        // bytes that count
    std::size_t fed;         // bytes given to the scanner
    std::uint32_t position;  // where reading stands
  };

  template <typename Node>
  Tree make(Node node, std::uint32_t depth, SourceRange range) {
    if (depth > kDeepestTree) report_depth(range);
    return {arena_.make(ast::Expr{node, range}), depth};
  }
  void report_depth(SourceRange range);
  void report_unterminated(const char* what, SourceRange range,
                           std::vector<Note> hints);
  SourceRange last_text(SourceRange before) const;

  ast::Arguments close_arguments(List arguments);
  ast::Statements close_scope(Scope scope);
  // Fills numbers_ from elements_; false if one is no number literal.
  bool collect_numbers(std::uint32_t begin);
  std::vector<const Source*> open_includes() const;
  void open_file(const Source& source);
  void warn_overwritten(std::string_view name, SourceRange before,
                        SourceRange now);

  ast::Program program_;
  ast::Arena& arena_;
  Loader& loader_;
  Diagnostics& diagnostics_;
  const Source* user_;

  std::array<std::vector<std::byte>, 3> stack_;
  std::vector<File> files_;  // the main text, then the includes being read
  SourceRange opening_;      // its first part
  SourceRange token_begin_;  // where the token is taken to begin
  std::string file_name_;    // in `include <…>`, `use <…>`
  std::string string_;       // decoded so far
  std::vector<SourceRange> brackets_;  // open
  SourceRange closed_bracket_;         // the opening one, closed last

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

  int error_count_ = 0;
  bool too_deep_ = false;
  Diagnostic first_error_;
};

}  // namespace lamina::detail
