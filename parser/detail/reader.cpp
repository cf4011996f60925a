#include "parser/detail/reader.h"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "parser/detail/paths.h"
#include "parser/detail/syntax_hint.h"
#include "parser/loader.h"

namespace lamina::detail {

namespace {

// Appends a Unicode code point as UTF-8.
void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&text](std::uint32_t byte) {
    text += static_cast<char>(static_cast<unsigned char>(byte));
  };
  const auto tail = [code](int shift) {
    return 0x80U | (code >> shift & 0x3fU);
  };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xc0U | code >> 6);
    put(tail(0));
  } else if (code < 0x10000) {
    put(0xe0U | code >> 12);
    put(tail(6));
    put(tail(0));
  } else {
    put(0xf0U | code >> 18);
    put(tail(12));
    put(tail(6));
    put(tail(0));
  }
}

bool is_character(std::uint32_t code) {
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return code != 0 && code < 0x110000 && !is_surrogate;
}

bool is_font(std::string_view file) {
  std::string end(file.substr(file.size() < 4 ? 0 : file.size() - 4));
  for (char& c : end) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return end == ".ttf" || end == ".otf";
}

bool same_file(const Source& a, const Source& b) {
  return &a == &b || absolute_path(a.path()) == absolute_path(b.path());
}

std::string quote(std::string_view text) { return fmt::format("'{}'", text); }

}  // namespace

std::size_t Reader::ScopedNameHash::operator()(const ScopedName& key) const {
  return std::hash<std::string_view>()(key.name) ^
         key.scope * std::size_t{0x9e3779b97f4a7c15};
}

Reader::Reader(const Source& source, const Source* user, Loader& loader,
               Diagnostics& diagnostics)
    : program_{std::make_shared<ast::Arena>(), &source, {}, {}, {}},
      arena_(*program_.arena),
      loader_(loader),
      diagnostics_(diagnostics),
      user_(user) {
  open_file(source);
}

ast::Program Reader::finish() {
  if (error_count_ > 0) throw SyntaxError(first_error_);
  program_.statements = arena_.copy(std::span<const ast::Statement* const>(
      statements_.data(), statements_.size()));
  std::reverse(uses_.begin(), uses_.end());
  program_.uses = arena_.copy(std::span<const ast::Use>(uses_));
  program_.fonts = arena_.copy(std::span<const ast::Use>(fonts_));
  return std::move(program_);
}

// --- For the scanner -------------------------------------------------------

void Reader::open_file(const Source& source) {
  // A zero byte ends a text, in OpenSCAD without a word.
  const std::size_t zero = source.text().find('\0');
  if (zero != std::string::npos) {
    const auto place = static_cast<std::uint32_t>(zero);
    diagnostics_.warning({&source, place, place},
                         "Ignoring all text after a zero byte");
  }
  files_.push_back({&source, std::min(zero, source.text().size()), 0, 0});
}

std::size_t Reader::feed(char* buffer, std::size_t most) {
  File& file = files_.back();
  const std::size_t count = std::min(most, file.size - file.fed);
  std::memcpy(buffer, file.source->text().data() + file.fed, count);
  file.fed += count;
  return count;
}

SourceRange Reader::place() const {
  const File& file = files_.back();
  return {file.source, file.position, file.position};
}

SourceRange Reader::whole_token() const {
  return {token_begin_.source, token_begin_.begin, files_.back().position};
}

std::vector<const Source*> Reader::open_includes() const {
  std::vector<const Source*> open;
  for (std::size_t i = 1; i < files_.size(); ++i) {
    open.push_back(files_[i].source);
  }
  return open;
}

bool Reader::open_include() {
  const std::string path =
      loader_.find(*files_.back().source, file_name_, open_includes());
  const Source* source = path.empty() ? nullptr : loader_.open_include(path);
  if (source == nullptr) {
    diagnostics_.report({Severity::kWarning,
                         {},
                         "Can't open include file " + quote(file_name_) + ".",
                         {},
                         {{whole_token(), "included here"}}});
    return false;
  }
  open_file(*source);
  return true;
}

bool Reader::close_include() {
  if (files_.size() == 1) return false;
  files_.pop_back();
  return true;
}

ast::Use* Reader::find_use(SourceRange range) {
  std::string path =
      loader_.find(*files_.back().source, file_name_, open_includes());
  const bool is_found = !path.empty();
  if (!is_found) {
    diagnostics_.report({Severity::kWarning,
                         {},
                         "Can't open library " + quote(file_name_) + ".",
                         {},
                         {{range, "used here"}}});
    path = file_name_;
  }
  const auto copy = arena_.copy(std::span<const char>(path));
  return arena_.make(ast::Use{{copy.data(), copy.size()}, range, is_found});
}

Text Reader::plain_string(SourceRange range) const {
  const std::string_view text = range.text();
  return {text.data() + 1, text.size() - 2};
}

void Reader::add_code_point(const char* digits) {
  const auto code =
      static_cast<std::uint32_t>(std::strtoul(digits, nullptr, 16));
  append_utf8(string_, is_character(code) ? code : ' ');
}

void Reader::break_string(SourceRange range) {
  token_begin_ = {range.source, range.end, range.end};
}

Text Reader::take_string() {
  const auto copy = arena_.copy(std::span<const char>(string_));
  string_.clear();
  return {copy.data(), copy.size()};
}

void Reader::close_bracket() {
  closed_bracket_ = {};
  if (brackets_.empty()) return;
  closed_bracket_ = brackets_.back();
  brackets_.pop_back();
}

bool Reader::read_number(const char* begin, const char* end,
                         double& value) const {
  const auto result = std::from_chars(begin, end, value);
  if (result.ec == std::errc()) return true;
  // Too large or too small: strtod tells which.
  value = std::strtod(std::string(begin, end).c_str(), nullptr);
  return value < 1;
}

// --- Errors ----------------------------------------------------------------

void Reader::report_error(SourceRange range, std::string_view message,
                          std::vector<Note> hints) {
  Diagnostic error{Severity::kError,
                   range,
                   fmt::format("Parser error: {}", message),
                   {},
                   std::move(hints)};
  if (error_count_ == 0) first_error_ = error;
  ++error_count_;
  diagnostics_.report(std::move(error));
}

void Reader::report_syntax_error(SourceRange range, std::string_view symbol,
                                 std::vector<std::string_view> expected) {
  const std::string_view text = range.text();
  const bool is_end = symbol.starts_with("end of");
  std::vector<Note> hints;
  // The end is behind the line breaks that end the text: show the text.
  hints.push_back({is_end ? last_text(range) : SourceRange{},
                   describe_syntax_error(symbol, text, std::move(expected))});
  const bool is_closing = text == ")" || text == "]" || text == "}";
  SourceRange opening;
  if (is_end && !brackets_.empty()) opening = brackets_.back();
  if (is_closing) opening = closed_bracket_;
  // A bracket that the token closes is no news, and after an error the count
  // is not to be trusted.
  const std::string pair = std::string(opening.text()) + std::string(text);
  const bool is_pair = pair == "()" || pair == "[]" || pair == "{}";
  if (opening.is_known() && !is_pair && error_count_ == 0) {
    hints.push_back({opening, "opened here"});
  }
  report_error(range, "syntax error", std::move(hints));
}

SourceRange Reader::last_text(SourceRange before) const {
  const std::string& text = before.source->text();
  std::uint32_t end = before.begin;
  while (end > 0 && static_cast<unsigned char>(text[end - 1]) <= ' ') --end;
  return {before.source, end - (end > 0 ? 1 : 0), end};
}

void Reader::report_unterminated(const char* what) {
  report_unterminated(what, place(), {{opening_, "it begins here"}});
}

void Reader::report_unterminated_name(const char* what) {
  report_unterminated(what, opening_, {});
}

void Reader::report_unterminated(const char* what, SourceRange range,
                                 std::vector<Note> hints) {
  report_error(range, fmt::format("Unterminated {}", what), std::move(hints));
}

void Reader::report_depth(SourceRange range) {
  if (too_deep_) return;
  too_deep_ = true;
  report_error(range, "memory exhausted",
               {{{}, fmt::format("nested more than {} deep", kDeepestTree)}});
}

bool Reader::grow_stack(std::ptrdiff_t& size) {
  constexpr std::ptrdiff_t kMost = kDeepestTree;
  if (size == kMost) {
    report_depth(place());
    return false;
  }
  size = std::min(4 * size, kMost);
  return true;
}

// --- Statements ------------------------------------------------------------

void Reader::add_use(const ast::Use& use) {
  if (is_font(use.file)) {
    if (!std::filesystem::is_regular_file(use.file)) {
      diagnostics_.report({Severity::kError,
                           {},
                           "Can't read font with path " + quote(use.file),
                           {},
                           {{use.range, "used here"}}});
    }
    fonts_.push_back(use);
    return;
  }
  std::erase_if(uses_, [&](const ast::Use& u) { return u.file == use.file; });
  uses_.push_back(use);
}

Scope Reader::open_scope() {
  const Scope scope{static_cast<std::uint32_t>(statements_.size()), scope_};
  scope_ = scope_count_++;
  return scope;
}

ast::Statements Reader::close_scope(Scope scope) {
  const auto statements = arena_.copy(
      std::span<const ast::Statement* const>(statements_).subspan(scope.begin));
  statements_.resize(scope.begin);
  scope_ = scope.outer;
  return statements;
}

void Reader::add_statement(const ast::Statement* statement) {
  if (statement != nullptr) statements_.push_back(statement);
}

void Reader::add_assignment(SourceRange name, Tree value, SourceRange range) {
  const std::string_view text = name.text();
  add_statement(
      arena_.make(ast::Statement{ast::Assignment{text, value.expr}, range}));
  const auto [place, is_new] =
      assigned_.try_emplace(ScopedName{scope_, text}, range);
  if (is_new) return;
  // After an error the scopes are not what they seem.
  if (!file_ended_ && error_count_ == 0) {
    warn_overwritten(text, place->second, range);
  }
  place->second = range;
}

void Reader::warn_overwritten(std::string_view name, SourceRange before,
                              SourceRange now) {
  const Source* main = user_ == nullptr ? program_.source : nullptr;
  const bool was_in_main = main != nullptr && same_file(*before.source, *main);
  const bool is_in_main = main != nullptr && same_file(*now.source, *main);
  const std::uint32_t line = before.source->openscad_line(before.begin);
  std::string message = fmt::format("{} was assigned on line {}", name, line);
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

void Reader::add_function(SourceRange name, List parameters, Tree body,
                          SourceRange range) {
  const ast::Arguments list = close_arguments(parameters);
  add_statement(arena_.make(ast::Statement{
      ast::FunctionDefinition{name.text(), list, body.expr}, range}));
}

void Reader::add_module(SourceRange name, List parameters, Scope scope,
                        SourceRange range) {
  const ast::Statements body = close_scope(scope);
  const ast::Arguments list = close_arguments(parameters);
  add_statement(arena_.make(
      ast::Statement{ast::ModuleDefinition{name.text(), list, body}, range}));
}

ast::Statement* Reader::make_instantiation(SourceRange name, List arguments,
                                           SourceRange range) {
  const ast::Arguments list = close_arguments(arguments);
  return arena_.make(
      ast::Statement{ast::Instantiation{name.text(), list, {}, {}}, range});
}

ast::Statement* Reader::set_children(ast::Statement* instantiation,
                                     Scope scope) {
  std::get<ast::Instantiation>(instantiation->node).children =
      close_scope(scope);
  return instantiation;
}

ast::Statement* Reader::make_if(Tree condition, Scope scope,
                                SourceRange range) {
  const ast::Statements if_true = close_scope(scope);
  return arena_.make(ast::Statement{
      ast::IfElse{condition.expr, if_true, {}, false, {}}, range});
}

ast::Statement* Reader::set_else(ast::Statement* if_else, Scope scope) {
  auto& node = std::get<ast::IfElse>(if_else->node);
  node.if_false = close_scope(scope);
  node.has_else = true;
  return if_else;
}

ast::Statement* Reader::set_modifier(ast::Statement* instantiation,
                                     bool ast::Modifiers::*modifier) {
  if (instantiation == nullptr) return nullptr;
  if (auto* plain = std::get_if<ast::Instantiation>(&instantiation->node)) {
    plain->modifiers.*modifier = true;
  } else {
    std::get<ast::IfElse>(instantiation->node).modifiers.*modifier = true;
  }
  return instantiation;
}

SourceRange Reader::place_head(SourceRange keyword, SourceRange close) const {
  const SourceRange whole{keyword.source, keyword.begin, close.end};
  if (keyword.source != close.source) return close;
  return whole.text().find('\n') == std::string_view::npos ? whole : close;
}

// --- Expressions -----------------------------------------------------------

Tree Reader::make_string(Text string, SourceRange range) {
  return make(ast::String{{string.data, string.size}}, 1, range);
}

Tree Reader::make_unary(ast::UnaryOp op, Tree operand, SourceRange range) {
  return make(ast::Unary{op, operand.expr}, operand.depth + 1, range);
}

Tree Reader::make_binary(ast::BinaryOp op, Tree left, Tree right,
                         SourceRange range) {
  return make(ast::Binary{op, left.expr, right.expr},
              std::max(left.depth, right.depth) + 1, range);
}

Tree Reader::make_conditional(Tree condition, Tree if_true, Tree if_false,
                              SourceRange range) {
  const std::uint32_t depth =
      std::max({condition.depth, if_true.depth, if_false.depth});
  return make(ast::Conditional{condition.expr, if_true.expr, if_false.expr},
              depth + 1, range);
}

Tree Reader::make_range(Tree begin, Tree step, Tree end, SourceRange range) {
  const std::uint32_t depth = std::max({begin.depth, step.depth, end.depth});
  return make(ast::Range{begin.expr, step.expr, end.expr}, depth + 1, range);
}

Tree Reader::make_index(Tree object, Tree index, SourceRange range) {
  return make(ast::Index{object.expr, index.expr},
              std::max(object.depth, index.depth) + 1, range);
}

Tree Reader::make_member(Tree object, SourceRange name, SourceRange range) {
  return make(ast::Member{object.expr, name.text()}, object.depth + 1, range);
}

Tree Reader::make_call(Tree callee, List arguments, SourceRange range) {
  const std::uint32_t depth = std::max(callee.depth, arguments.depth);
  return make(ast::Call{callee.expr, close_arguments(arguments)}, depth + 1,
              range);
}

Tree Reader::make_function(List parameters, Tree body, SourceRange range) {
  return make_body<ast::FunctionLiteral>(parameters, body, range);
}

Tree Reader::make_each(Tree body, SourceRange range) {
  return make(ast::EachElements{body.expr}, body.depth + 1, range);
}

Tree Reader::make_if_elements(Tree condition, Tree if_true, Tree if_false,
                              SourceRange range) {
  const std::uint32_t depth =
      std::max({condition.depth, if_true.depth, if_false.depth});
  return make(ast::IfElements{condition.expr, if_true.expr, if_false.expr},
              depth + 1, range);
}

Tree Reader::make_for_c(List init, Tree condition, List update, Tree body,
                        SourceRange range) {
  const std::uint32_t depth =
      std::max({init.depth, condition.depth, update.depth, body.depth});
  const ast::Arguments last = close_arguments(update);
  const ast::Arguments first = close_arguments(init);
  const auto* head = arena_.make(ast::ForCHead{first, condition.expr, last});
  return make(ast::ForCElements{head, body.expr}, depth + 1, range);
}

bool Reader::collect_numbers(std::uint32_t begin) {
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

Tree Reader::make_vector(ast::Arena::Mark mark, List elements,
                         SourceRange range) {
  if (collect_numbers(elements.begin)) {
    arena_.release(mark);
    elements_.resize(elements.begin);
    const auto copy = arena_.copy(std::span<const double>(numbers_));
    return make(ast::Numbers{copy}, 1, range);
  }
  const auto copy = arena_.copy(
      std::span<const ast::Expr* const>(elements_).subspan(elements.begin));
  elements_.resize(elements.begin);
  return make(ast::Vector{copy}, elements.depth + 1, range);
}

List Reader::start_elements(Tree first) {
  elements_.push_back(first.expr);
  return {static_cast<std::uint32_t>(elements_.size() - 1), first.depth};
}

List Reader::append_element(List elements, Tree element) {
  elements_.push_back(element.expr);
  return {elements.begin, std::max(elements.depth, element.depth)};
}

std::uint32_t Reader::add_argument(SourceRange name, Tree value,
                                   SourceRange range) {
  arguments_.push_back({name.text(), value.expr, range});
  return value.depth;
}

List Reader::start_arguments() const {
  return {static_cast<std::uint32_t>(arguments_.size()), 0};
}

List Reader::start_arguments(std::uint32_t first_depth) const {
  return {static_cast<std::uint32_t>(arguments_.size() - 1), first_depth};
}

List Reader::append_argument(List arguments, std::uint32_t depth) const {
  return {arguments.begin, std::max(arguments.depth, depth)};
}

ast::Arguments Reader::close_arguments(List arguments) {
  const auto copy = arena_.copy(
      std::span<const ast::Argument>(arguments_).subspan(arguments.begin));
  arguments_.resize(arguments.begin);
  return copy;
}

}  // namespace lamina::detail
