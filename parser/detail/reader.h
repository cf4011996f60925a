#pragma once
// What the scanner reads from: texts, and the places in them.
//
// Flex knows tokens; the Reader feeds it from the file being read, follows
// includes, turns byte counts into source ranges, and decodes strings and
// numbers.

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/ast.h"
#include "parser/detail/symbol_values.h"
#include "parser/detail/syntax_errors.h"

namespace lamina {
class Loader;
}

namespace lamina::detail {

class Reader {
 public:
  // arena  of the program: takes decoded strings
  Reader(const Source& source, Arena& arena, Loader& loader,
         SyntaxErrors& errors, Diagnostics& diagnostics);

  // Up to `most` bytes of the current text, 0 at its end.
  std::size_t feed(char* buffer, std::size_t most);

  // Reads the next `size` bytes and returns their range.
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

  // What OpenSCAD 2021.01 accepts without a word.
  void warn_in_2026(std::string_view message);

  // Says in 2026, once for each line, that a name begins with a digit.
  void note_name(SourceRange name);

  // `include <…>` and `use <…>`.
  void set_file_name(std::string_view name) { file_name_ = name; }
  bool open_include();   // false: not found, a warning is reported
  bool close_include();  // false: the end of the main text
  ast::Use* find_use(SourceRange range);

  Text plain_string(SourceRange range) const;
  void add_to_string(std::string_view part) { string_ += part; }
  // Takes hexadecimal digits; what is not a character becomes a blank.
  void add_code_point(const char* digits);
  // OpenSCAD places a string of several lines on its last one.
  void break_string(SourceRange range);
  Text take_string();

  // Brackets are counted to find the one that a text lacks.
  void open_bracket(SourceRange range) { brackets_.push_back(range); }
  void close_bracket();

  // False if the number is beyond double.
  bool read_number(const char* begin, const char* end, double& value);

  // An error at the token `range`, which the grammar calls `symbol`; what it
  // could take there is `expected`.
  void report_syntax_error(SourceRange range, std::string_view symbol,
                           std::vector<std::string_view> expected);

  // Report a text that ends in a string or comment. OpenSCAD places that error
  // at the end, but for names of files (in `use` and `include`) where they
  // begin.
  void report_unterminated(const char* what);
  void report_unterminated_name(const char* what);

 private:
  // A text being read.
  struct File {
    const Source* source;
    std::size_t size;        // bytes that count
    std::size_t fed;         // bytes given to the scanner
    std::uint32_t position;  // where reading stands
  };

  void open_file(const Source& source);
  void warn_of_file(std::string_view message, SourceRange range,
                    std::string_view hint);
  void warn_of_digits(std::string_view digits, double value);
  std::vector<const Source*> open_includes() const;

  Arena& arena_;
  Loader& loader_;
  SyntaxErrors& errors_;
  Diagnostics& diagnostics_;

  std::vector<File> files_;  // the main text, then the includes being read
  // Where a token of several parts opened, and where it is taken to begin.
  SourceRange opening_;
  SourceRange token_begin_;
  std::string file_name_;              // in `include <…>`, `use <…>`
  std::string string_;                 // decoded so far
  std::vector<SourceRange> brackets_;  // open
  SourceRange closed_bracket_;         // the opening one, closed last
  // Names that begin with a digit, with their lines.
  std::set<std::tuple<const Source*, std::uint32_t, std::string_view>>
      names_with_digits_;
};

}  // namespace lamina::detail
