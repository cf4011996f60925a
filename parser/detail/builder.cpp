#include "parser/detail/builder.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/paths.h"

namespace lamina::detail {

namespace {

bool same_file(const Source& a, const Source& b) {
  return &a == &b || absolute_path(a.path()) == absolute_path(b.path());
}

constexpr std::string_view kBitwise = "bitwise operator";

bool is_bitwise(ast::BinaryOp op) {
  return op >= ast::BinaryOp::kBitOr && op <= ast::BinaryOp::kShiftRight;
}

}  // namespace

std::size_t Builder::ScopedNameHash::operator()(const ScopedName& key) const {
  return std::hash<std::string_view>()(key.name) ^
         key.scope * std::size_t{0x9e3779b97f4a7c15};
}

Builder::Builder(const Source& source, const Source* user, Language language,
                 SyntaxErrors& errors, const FileAccess& files,
                 Diagnostics& diagnostics)
    : program_{std::make_shared<Arena>(), &source, {}, {}, {}},
      arena_(*program_.arena),
      user_(user),
      language_(language),
      errors_(errors),
      file_access_(files),
      diagnostics_(diagnostics) {}

ast::Program Builder::finish() {
  if (!errors_.is_empty()) errors_.throw_first();
  program_.statements = arena_.copy(std::span<const ast::Statement* const>(
      statements_.data(), statements_.size()));
  std::reverse(uses_.begin(), uses_.end());
  program_.uses = arena_.copy(std::span<const ast::Use>(uses_));
  program_.fonts = arena_.copy(std::span<const ast::Use>(fonts_));
  return std::move(program_);
}

// --- Statements ------------------------------------------------------------

void Builder::add_use(const ast::Use& use) {
  if (is_font(use.file)) {
    if (!file_access_.is_regular_file(std::string(use.file))) {
      diagnostics_.report(
          {Severity::kError,
           {},
           fmt::format("Can't read font with path '{}'", use.file),
           {},
           {{use.range, "used here"}}});
    }
    fonts_.push_back(use);
    return;
  }
  std::erase_if(uses_, [&](const ast::Use& u) { return u.file == use.file; });
  uses_.push_back(use);
}

Scope Builder::open_scope() {
  const Scope scope{static_cast<std::uint32_t>(statements_.size()), scope_};
  scope_ = scope_count_++;
  return scope;
}

ast::Statements Builder::close_scope(Scope scope) {
  scope_ = scope.outer;
  return take_top(statements_, scope.begin);
}

void Builder::add_statement(const ast::Statement* statement) {
  if (statement != nullptr) statements_.push_back(statement);
}

void Builder::reject_since_2026(SourceRange comma) {
  if (language_ == Language::k2021) return;
  errors_.report(comma, "syntax error",
                 hint_of("--language 2021 passes over a comma too many"));
}

void Builder::add_assignment(SourceRange name, Tree value, SourceRange range) {
  const std::string_view text = name.text();
  add_statement(
      arena_.make(ast::Statement{ast::Assignment{text, value.expr}, range}));
  const auto [place, is_new] =
      assigned_.try_emplace(ScopedName{scope_, text}, range);
  if (is_new) return;
  // After an error the scopes may be wrong.
  if (!file_ended_ && errors_.is_empty()) {
    warn_overwritten(text, place->second, range);
  }
  place->second = range;
}

void Builder::warn_overwritten(std::string_view name, SourceRange before,
                               SourceRange now) {
  const Source* main = user_ == nullptr ? program_.source : nullptr;
  const bool was_in_main = main != nullptr && same_file(*before.source, *main);
  const bool is_in_main = main != nullptr && same_file(*now.source, *main);
  const std::uint32_t line = before.source->openscad_line(before.begin);
  std::string message = fmt::format("{} was assigned on line {}",
                                    quoted_name(name, language_, ""), line);
  if (!was_in_main || !is_in_main) {
    // Included once more, or meant to be overwritten by the main file?
    const bool is_same = same_file(*before.source, *now.source);
    if (is_same && line == now.source->openscad_line(now.begin)) return;
    if (!is_same && !was_in_main) return;
    const Source& base = user_ == nullptr ? *program_.source : *user_;
    message += fmt::format(" of \"{}\"", relative_path(before.source->path(),
                                                       folder_of(base.path())));
  }
  diagnostics_.report({Severity::kWarning,
                       now,
                       message + " but was overwritten",
                       {},
                       {{before, "assigned here"}}});
}

void Builder::add_function(SourceRange name, List parameters, Tree body,
                           SourceRange range) {
  const ast::Arguments list = close_arguments(parameters);
  add_statement(arena_.make(ast::Statement{
      ast::FunctionDefinition{name.text(), list, body.expr}, range}));
}

void Builder::add_module(SourceRange name, List parameters, Scope scope,
                         SourceRange range) {
  const ast::Statements body = close_scope(scope);
  const ast::Arguments list = close_arguments(parameters);
  add_statement(arena_.make(
      ast::Statement{ast::ModuleDefinition{name.text(), list, body}, range}));
}

ast::Statement* Builder::make_instantiation(SourceRange name, List arguments,
                                            SourceRange range) {
  const ast::Arguments list = close_arguments(arguments);
  return arena_.make(
      ast::Statement{ast::Instantiation{name.text(), list, {}, {}}, range});
}

ast::Statement* Builder::set_children(ast::Statement* instantiation,
                                      Scope scope) {
  std::get<ast::Instantiation>(instantiation->node).children =
      close_scope(scope);
  return instantiation;
}

ast::Statement* Builder::make_if(Tree condition, Scope scope,
                                 SourceRange range) {
  const ast::Statements if_true = close_scope(scope);
  return arena_.make(ast::Statement{
      ast::IfElse{condition.expr, if_true, {}, false, {}}, range});
}

ast::Statement* Builder::set_else(ast::Statement* if_else, Scope scope) {
  auto& node = std::get<ast::IfElse>(if_else->node);
  node.if_false = close_scope(scope);
  node.has_else = true;
  return if_else;
}

ast::Statement* Builder::set_modifier(ast::Statement* instantiation,
                                      bool ast::Modifiers::*modifier) {
  if (instantiation == nullptr) return nullptr;
  if (auto* plain = std::get_if<ast::Instantiation>(&instantiation->node)) {
    plain->modifiers.*modifier = true;
  } else {
    std::get<ast::IfElse>(instantiation->node).modifiers.*modifier = true;
  }
  return instantiation;
}

SourceRange Builder::place_head(SourceRange keyword, SourceRange close) const {
  const SourceRange whole{keyword.source, keyword.begin, close.end};
  if (keyword.source != close.source) return close;
  return whole.text().find('\n') == std::string_view::npos ? whole : close;
}

// --- Expressions -----------------------------------------------------------

Tree Builder::make_unary(ast::UnaryOp op, Tree operand, SourceRange range) {
  if (op == ast::UnaryOp::kBitNot) note_newer(range, kBitwise);
  return make(ast::Unary{op, operand.expr}, operand.depth + 1, range);
}

Tree Builder::make_binary(ast::BinaryOp op, Tree left, Tree right,
                          SourceRange range) {
  if (is_bitwise(op)) note_newer(range, kBitwise);
  return make(ast::Binary{op, left.expr, right.expr},
              std::max(left.depth, right.depth) + 1, range);
}

Tree Builder::make_member(Tree object, SourceRange name, SourceRange range) {
  return make(ast::Member{object.expr, name.text()}, object.depth + 1, range);
}

Tree Builder::make_call(Tree callee, List arguments, SourceRange range) {
  const std::uint32_t depth = std::max(callee.depth, arguments.depth);
  return make(ast::Call{callee.expr, close_arguments(arguments)}, depth + 1,
              range);
}

Tree Builder::make_for_c(List init, Tree condition, List update, Tree body,
                         SourceRange range) {
  const std::uint32_t depth =
      std::max({init.depth, condition.depth, update.depth, body.depth});
  const ast::Arguments last = close_arguments(update);
  const ast::Arguments first = close_arguments(init);
  const auto* head = arena_.make(ast::ForCHead{first, condition.expr, last});
  return make(ast::ForCElements{head, body.expr}, depth + 1, range);
}

bool Builder::collect_numbers(std::uint32_t begin) {
  numbers_.clear();
  for (std::size_t i = begin; i < elements_.size(); ++i) {
    const ast::Expr* element = elements_[i];
    const auto* sign = std::get_if<ast::Unary>(&element->node);
    const bool is_negated =
        sign != nullptr && sign->op == ast::UnaryOp::kNegate;
    if (is_negated) element = sign->operand;
    const auto* number = std::get_if<ast::Number>(&element->node);
    if (number == nullptr) return false;
    numbers_.push_back(is_negated ? -number->value : number->value);
  }
  return true;
}

Tree Builder::make_vector(Arena::Mark mark, List elements, SourceRange range) {
  if (collect_numbers(elements.begin)) {
    arena_.release(mark);
    elements_.resize(elements.begin);
    const auto copy = arena_.copy(std::span<const double>(numbers_));
    return make(ast::Numbers{copy}, 1, range);
  }
  return make(ast::Vector{take_top(elements_, elements.begin)},
              elements.depth + 1, range);
}

List Builder::start_elements(Tree first) {
  elements_.push_back(first.expr);
  return {static_cast<std::uint32_t>(elements_.size() - 1), first.depth};
}

List Builder::append_element(List elements, Tree element) {
  elements_.push_back(element.expr);
  return {elements.begin, std::max(elements.depth, element.depth)};
}

std::uint32_t Builder::add_argument(SourceRange name, Tree value,
                                    SourceRange range) {
  arguments_.push_back({name.text(), value.expr, range});
  return value.depth;
}

List Builder::start_arguments() const {
  return {static_cast<std::uint32_t>(arguments_.size()), 0};
}

List Builder::start_arguments(std::uint32_t first_depth) const {
  return {static_cast<std::uint32_t>(arguments_.size() - 1), first_depth};
}

List Builder::append_argument(List arguments, std::uint32_t depth) const {
  return {arguments.begin, std::max(arguments.depth, depth)};
}

}  // namespace lamina::detail
