#include "parser/customizer.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "parser/text.h"

namespace lamina {

namespace {

bool is_literal(const ast::Expr* expr) {
  if (expr == nullptr) return true;
  if (const auto* unary = std::get_if<ast::Unary>(&expr->node)) {
    return is_literal(unary->operand);
  }
  if (const auto* range = std::get_if<ast::Range>(&expr->node)) {
    return is_literal(range->begin) && is_literal(range->step) &&
           is_literal(range->end);
  }
  if (const auto* vector = std::get_if<ast::Vector>(&expr->node)) {
    return std::all_of(vector->elements.begin(), vector->elements.end(),
                       is_literal);
  }
  return std::holds_alternative<ast::Undef>(expr->node) ||
         std::holds_alternative<ast::Bool>(expr->node) ||
         std::holds_alternative<ast::Number>(expr->node) ||
         std::holds_alternative<ast::Numbers>(expr->node) ||
         std::holds_alternative<ast::String>(expr->node);
}

// The comment behind the first statement of a line; none if a second one
// follows.
std::string_view find_comment(std::string_view line) {
  bool is_in_string = false;
  int semicolons = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (is_in_string && line.substr(i, 2) == "\\\"") {
      ++i;
      continue;
    }
    if (line[i] == '"') is_in_string = !is_in_string;
    if (is_in_string) continue;
    if (line.substr(i, 2) == "//") return line.substr(i + 2);
    if (line[i] == ';' && semicolons++ > 0) return {};
  }
  return {};
}

// The text of a line that is a comment, further "//" in it made blanks.
std::string read_description(std::string_view line) {
  if (!line.starts_with("//")) return {};
  line.remove_prefix(2);
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  std::string description;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_slashes = line.substr(i, 2) == "//";
    description += is_slashes ? ' ' : line[i];
    if (is_slashes) ++i;
  }
  return description;
}

// "[a] x [b]" names the group "a-b".
std::string read_group(std::string_view comment) {
  std::string name;
  while (true) {
    const std::size_t begin = comment.find('[');
    if (begin == std::string_view::npos) return name;
    const std::size_t end = comment.find(']', begin);
    if (end == std::string_view::npos) return name;
    if (!name.empty()) name += '-';
    name += comment.substr(begin + 1, end - begin - 1);
    comment.remove_prefix(end + 1);
  }
}

// Reads the comment behind a parameter:
//
//   comment  item | '[' number ':' number (':' number)? ']'
//                 | '[' value (',' value)* ']'
//   value    item | item ':' item                        (value : label)
//   item     a number, or any sequence of words and numbers with a word in it
//
// Words are what stands between blanks and the signs ( ) [ ] , " :, of which
// parentheses are skipped. A string in quotes is one word.
class ValuesReader {
 public:
  explicit ValuesReader(std::string_view text) : rest_(text) { advance(); }

  // The values in OpenSCAD's notation; none where the comment makes no sense.
  std::optional<std::string> read() {
    std::string result;
    const bool is_list = kind_ == Kind::kSign && sign_ == '[';
    if (is_list) advance();
    if (is_list ? !read_list(result) : !read_item(result)) return {};
    return kind_ == Kind::kEnd ? std::optional(result) : std::nullopt;
  }

 private:
  enum class Kind { kEnd, kSign, kNumber, kWord };

  void advance() {
    while (!rest_.empty() &&
           (rest_[0] == ' ' || rest_[0] == '(' || rest_[0] == ')')) {
      rest_.remove_prefix(1);
    }
    // A lone tab is blank, one at the edge of a word belongs to the word.
    if (rest_ == "\t" || rest_.starts_with("\t ")) {
      rest_.remove_prefix(1);
      return advance();
    }
    if (rest_.empty()) {
      kind_ = Kind::kEnd;
    } else if (rest_[0] == '"') {
      read_string();
    } else if (std::string_view("[],:").find(rest_[0]) !=
               std::string_view::npos) {
      kind_ = Kind::kSign;
      sign_ = rest_[0];
      rest_.remove_prefix(1);
    } else {
      read_word();
    }
  }

  void read_word() {
    const std::size_t end =
        std::min(rest_.find_first_of("([ ],\":)"), rest_.size());
    word_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
    kind_ = is_number(word_) ? Kind::kNumber : Kind::kWord;
  }

  bool is_number(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) {
      word.remove_prefix(1);
    }
    if (word.find_first_not_of("+-.0123456789eE") != std::string_view::npos) {
      return false;
    }
    const auto result =
        std::from_chars(word.data(), word.data() + word.size(), number_);
    return result.ec == std::errc() && result.ptr == word.data() + word.size();
  }

  void read_string() {
    kind_ = Kind::kWord;
    word_.clear();
    std::size_t i = 1;
    for (; i < rest_.size() && rest_[i] != '"'; ++i) {
      if (rest_[i] != '\\' || i + 1 == rest_.size()) {
        word_ += rest_[i];
        continue;
      }
      ++i;
      const char c = rest_[i];
      word_ += c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
    }
    rest_.remove_prefix(std::min(i + 1, rest_.size()));
  }

  bool take(char sign) {
    if (kind_ != Kind::kSign || sign_ != sign) return false;
    advance();
    return true;
  }

  // Numbers among words become words.
  bool read_item(std::string& result) {
    const bool begins_with_number = kind_ == Kind::kNumber;
    const double first = number_;
    int parts = 0;
    int words = 0;
    std::string joined;
    for (; kind_ == Kind::kNumber || kind_ == Kind::kWord; advance()) {
      if (parts++ > 0) joined += ' ';
      if (kind_ == Kind::kWord) ++words;
      joined += kind_ == Kind::kWord ? word_ : fmt::format("{:g}", number_);
    }
    is_number_ = begins_with_number && parts == 1;
    if (is_number_) {
      append_number(first, result);
    } else if (words > 0) {
      append_quoted(joined, result);
    }
    return is_number_ || words > 0;
  }

  // The rest of "[ … ]".
  bool read_list(std::string& result) {
    std::string list;
    bool is_range = true;  // as long as it may still be one
    int count = 0;
    do {
      std::vector<std::string> parts(1);
      if (!read_item(parts.back())) return false;
      is_range = is_range && is_number_;
      while (take(':')) {
        if (!read_item(parts.emplace_back())) return false;
        is_range = is_range && is_number_;
      }
      if (parts.size() > 3 || (parts.size() == 3 && !is_range)) return false;
      is_range = is_range && parts.size() > 1 && count == 0;
      if (count++ > 0) list += ", ";
      list += parts.size() == 1 ? parts[0] : join(parts);
      const bool is_whole = kind_ == Kind::kSign && sign_ == ']';
      if (is_range && is_whole) {
        result = fmt::format("[{}]", fmt::join(parts, " : "));
        return take(']');
      }
      if (parts.size() == 3) return false;
      is_range = false;
    } while (take(','));
    result = fmt::format("[{}]", list);
    return take(']');
  }

  static std::string join(const std::vector<std::string>& parts) {
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }

  std::string_view rest_;
  Kind kind_ = Kind::kEnd;
  char sign_ = 0;
  double number_ = 0;
  std::string word_;
  bool is_number_ = false;  // the item read last
};

}  // namespace

Customizer::Customizer(const ast::Program& program) : source_(*program.source) {
  scan();
}

// Finds the groups and the first '{'. Like OpenSCAD's scan this one is apart
// from the language: a '{' in a string counts.
void Customizer::scan() {
  const std::string& text = source_.text();
  bool is_in_string = false;
  std::uint32_t line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view pair = std::string_view(text).substr(i, 2);
    if (text[i] == '\n') {
      ++line;
    } else if (is_in_string && pair == "\\\"") {
      ++i;
    } else if (text[i] == '"') {
      is_in_string = !is_in_string;
    } else if (!is_in_string && pair == "//") {
      i = std::min(text.find('\n', i), text.size());
      ++line;
    } else if (!is_in_string && pair == "/*") {
      i = skip_comment(i + 2, line);
    } else if (text[i] == '{') {
      break;
    }
  }
  end_line_ = line;
}

// Skips a comment that begins before `place` and returns the place of the '*'
// that ends it. One on a single line is a group.
std::size_t Customizer::skip_comment(std::size_t place, std::uint32_t& line) {
  const std::string& text = source_.text();
  const std::size_t end = std::min(text.find("*/", place), text.size());
  const std::string_view comment =
      std::string_view(text).substr(place, end - place);
  const auto lines = std::count(comment.begin(), comment.end(), '\n');
  line += static_cast<std::uint32_t>(lines);
  if (lines == 0) groups_.push_back({read_group(comment), line});
  return end;
}

ParameterComment Customizer::comment_of(
    const ast::Statement& assignment) const {
  ParameterComment result;
  const SourceRange range = assignment.range;
  const auto& node = std::get<ast::Assignment>(assignment.node);
  if (range.source != &source_ || !is_literal(node.value)) return result;
  const std::uint32_t line = source_.openscad_line(range.begin);
  if (line >= end_line_) return result;
  result.is_parameter = true;
  result.description = read_description(source_.line_text(line - 1));
  ValuesReader reader(find_comment(source_.line_text(line)));
  if (const auto values = reader.read()) result.values = *values;
  const auto group =
      std::find_if(groups_.rbegin(), groups_.rend(),
                   [line](const Group& g) { return g.line < line; });
  result.has_group = group != groups_.rend();
  if (result.has_group) result.group = group->name;
  return result;
}

}  // namespace lamina
