#include "parser/customizer/detail/customizer_value.h"

#include <algorithm>
#include <charconv>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace lamina::detail {
namespace {

// Reads
//
//   text   item | '[' number ':' number (':' number)? ']'
//               | '[' value (',' value)* ']'
//   value  item | item ':' item                          (value : label)
//   item   a number, or any sequence of words and numbers with a word in it
//
// Words are what stands between blanks and the signs ( ) [ ] , " :, of which
// parentheses are skipped. A string in quotes is one word.
class Reader {
 public:
  Reader(std::string_view text, Arena& arena) : rest_(text), arena_(arena) {
    advance();
  }

  const ast::Expr* read() {
    const ast::Expr* value = take('[') ? read_list() : read_item();
    return kind_ == Kind::kEnd ? value : nullptr;
  }

 private:
  enum class Kind { kEnd, kSign, kNumber, kWord };

  void advance() {
    while (!rest_.empty() &&
           (rest_[0] == ' ' || rest_[0] == '(' || rest_[0] == ')')) {
      rest_.remove_prefix(1);
    }
    // A lone tab is a blank; one at the edge of a word belongs to the word.
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

  bool is_at(char sign) const { return kind_ == Kind::kSign && sign_ == sign; }

  bool take(char sign) {
    if (!is_at(sign)) return false;
    advance();
    return true;
  }

  template <typename Node>
  const ast::Expr* make(Node node) {
    return arena_.make(ast::Expr{node, {}});
  }
  const ast::Expr* make_vector(const std::vector<const ast::Expr*>& elements) {
    return make(
        ast::Vector{arena_.copy(std::span<const ast::Expr* const>(elements))});
  }

  // Numbers among words become words.
  const ast::Expr* read_item() {
    const bool begins_with_number = kind_ == Kind::kNumber;
    const double first = number_;
    int parts = 0;
    bool has_word = false;
    std::string joined;
    for (; kind_ == Kind::kNumber || kind_ == Kind::kWord; advance()) {
      if (parts++ > 0) joined += ' ';
      has_word = has_word || kind_ == Kind::kWord;
      joined += kind_ == Kind::kWord ? word_ : fmt::format("{:g}", number_);
    }
    if (begins_with_number && parts == 1) return make(ast::Number{first});
    if (!has_word) return nullptr;
    return make(ast::String{arena_.copy(joined)});
  }

  static bool is_number(const ast::Expr* item) {
    return std::holds_alternative<ast::Number>(item->node);
  }

  // The rest of "[ … ]".
  const ast::Expr* read_list() {
    std::vector<const ast::Expr*> values;
    do {
      std::vector<const ast::Expr*> items;
      do {
        items.push_back(read_item());
        if (items.back() == nullptr) return nullptr;
      } while (take(':'));
      if (values.empty() && is_at(']') && is_range(items)) {
        advance();
        return make_range(items);
      }
      if (items.size() > 2) return nullptr;
      values.push_back(items.size() == 1 ? items[0] : make_vector(items));
    } while (take(','));
    return take(']') ? make_vector(values) : nullptr;
  }

  static bool is_range(const std::vector<const ast::Expr*>& items) {
    return (items.size() == 2 || items.size() == 3) &&
           std::all_of(items.begin(), items.end(),
                       [](const ast::Expr* item) { return is_number(item); });
  }

  const ast::Expr* make_range(const std::vector<const ast::Expr*>& items) {
    return make(ast::Range{
        items.front(), items.size() == 3 ? items[1] : nullptr, items.back()});
  }

  std::string_view rest_;
  Arena& arena_;
  Kind kind_ = Kind::kEnd;
  char sign_ = 0;
  double number_ = 0;
  std::string word_;
};

}  // namespace

const ast::Expr* read_customizer_value(std::string_view text, Arena& arena) {
  return Reader(text, arena).read();
}

}  // namespace lamina::detail
