#include "parser/detail/reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "base/utf8.h"
#include "parser/loader.h"

namespace lamina::detail {

Reader::Reader(const Source& source, Arena& arena, Loader& loader,
               SyntaxErrors& errors, Diagnostics& diagnostics)
    : arena_(arena),
      loader_(loader),
      errors_(errors),
      diagnostics_(diagnostics) {
  open_file(source);
}

void Reader::open_file(const Source& source) {
  // A zero byte ends a text; OpenSCAD does not say so.
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

void Reader::note_name(SourceRange name) {
  const std::string_view text = name.text();
  if (text[0] < '0' || text[0] > '9') return;
  if (loader_.language() == Language::k2021) return;
  const std::uint32_t line = name.source->line_column(name.begin).line;
  if (!names_with_digits_.emplace(name.source, line, text).second) return;
  diagnostics_.report(
      {Severity::kDeprecated, name,
       fmt::format("Variable names starting with digits (\"{}\") will be "
                   "removed in future releases.",
                   text)});
}

void Reader::warn_in_2026(std::string_view message) {
  if (loader_.language() == Language::k2026) {
    diagnostics_.warning(place(), std::string(message));
  }
}

// Places of missing files are OpenSCAD 2026's; 2021.01 has none.
void Reader::warn_of_file(std::string_view message, SourceRange range,
                          std::string_view hint) {
  const std::string text = fmt::format("{} '{}'.", message, file_name_);
  if (loader_.language() == Language::k2026) {
    diagnostics_.warning(place(), text);
  } else {
    diagnostics_.report(
        {Severity::kWarning, {}, text, {}, {{range, std::string(hint)}}});
  }
}

bool Reader::open_include() {
  const std::string path =
      loader_.find(whole_token(), file_name_, open_includes());
  const Source* source = path.empty() ? nullptr : loader_.open_include(path);
  if (source == nullptr) {
    const bool is_named_so =
        loader_.language() == Language::k2021 || !path.empty();
    warn_of_file(
        is_named_so ? "Can't open include file" : "Can't find include file",
        whole_token(), "included here");
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
  std::string path = loader_.find(range, file_name_, open_includes());
  const bool is_found = !path.empty();
  if (!is_found) {
    warn_of_file("Can't open library", range, "used here");
    path = file_name_;
  }
  return arena_.make(ast::Use{arena_.copy(path), range, is_found});
}

Text Reader::plain_string(SourceRange range) const {
  const std::string_view text = range.text();
  return {text.data() + 1, text.size() - 2};
}

void Reader::add_code_point(const char* digits) {
  const auto code =
      static_cast<std::uint32_t>(std::strtoul(digits, nullptr, 16));
  if (!append_utf8(code, string_)) string_ += ' ';
}

void Reader::break_string(SourceRange range) {
  token_begin_ = {range.source, range.end, range.end};
}

Text Reader::take_string() {
  const std::string_view copy = arena_.copy(string_);
  string_.clear();
  return {copy.data(), copy.size()};
}

void Reader::close_bracket() {
  closed_bracket_ = {};
  if (brackets_.empty()) return;
  closed_bracket_ = brackets_.back();
  brackets_.pop_back();
}

bool Reader::read_number(const char* begin, const char* end, double& value) {
  const auto result = std::from_chars(begin, end, value);
  if (result.ec == std::errc()) {
    constexpr double kGreatestExact = 0x1p53;
    if (value > kGreatestExact) warn_of_digits({begin, end}, value);
    return true;
  }
  // Too large or too small.
  const auto small =
      parse_number({begin, static_cast<std::size_t>(end - begin)});
  value = small.value_or(HUGE_VAL);
  return small.has_value();
}

void Reader::warn_of_digits(std::string_view digits, double value) {
  std::uint64_t whole = 0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, whole);
  if (read.ptr != end) return;  // no integer
  const bool is_exact = read.ec == std::errc() && value < 0x1p64 &&
                        static_cast<std::uint64_t>(value) == whole;
  if (is_exact) return;
  warn_in_2026(
      fmt::format("Integer \"{}\" cannot be represented precisely", digits));
}

void Reader::report_syntax_error(SourceRange range, std::string_view symbol,
                                 std::vector<std::string_view> expected) {
  const std::string_view text = range.text();
  // The program adds the ';' behind a -D.
  const bool ends_definition =
      range.is_defined_by_option() && range.source->text()[range.end] == '\n';
  if (ends_definition) symbol = "end of the definition";
  const bool is_end = symbol.starts_with("end of");
  std::vector<Note> hints;
  hints.push_back(
      {{}, describe_syntax_error(symbol, text, std::move(expected))});
  const bool is_closing = text == ")" || text == "]" || text == "}";
  SourceRange opening;
  if (is_end && !brackets_.empty()) opening = brackets_.back();
  if (is_closing) opening = closed_bracket_;
  // A bracket that the token closes needs no hint, and after an error the count
  // may be wrong.
  const std::string pair = std::string(opening.text()) + std::string(text);
  const bool is_pair = pair == "()" || pair == "[]" || pair == "{}";
  if (opening.is_known() && !is_pair && errors_.is_empty()) {
    hints.push_back({opening, "opened here"});
  }
  errors_.report(range, "syntax error", std::move(hints));
}

void Reader::report_unterminated(const char* what) {
  errors_.report_unterminated(place(), what, {{opening_, "it begins here"}});
}

void Reader::report_unterminated_name(const char* what) {
  errors_.report_unterminated(opening_, what, {});
}

}  // namespace lamina::detail
