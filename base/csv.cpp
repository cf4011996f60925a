#include "base/csv.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/diagnostic.h"
#include "base/utf8.h"

namespace lamina {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

class Reader {
 public:
  explicit Reader(const Source& source)
      : source_(source), text_(source.text()) {
    if (text_.starts_with(kByteOrderMark)) place_ = kByteOrderMark.size();
  }

  Csv read() {
    check_text();
    Csv csv;
    csv.separator = separator_ = find_separator();
    while (skip_empty_lines()) csv.rows.push_back(read_row());
    return csv;
  }

 private:
  [[noreturn]] void fail(std::size_t begin, std::size_t end,
                         std::string message) const {
    throw FileError(std::move(message), range(begin, end));
  }

  SourceRange range(std::size_t begin, std::size_t end) const {
    return {&source_, static_cast<std::uint32_t>(begin),
            static_cast<std::uint32_t>(end)};
  }

  // Refuses other encodings: letters would come out wrong in the layers, where
  // nobody reads them.
  void check_text() const {
    std::size_t length = 0;
    for (std::size_t i = 0; i < text_.size(); i += length) {
      length = character_length(std::string_view(text_).substr(i));
      const auto c = static_cast<unsigned char>(text_[i]);
      const bool is_control = c < 0x20 && !is_line_end(text_[i]) && c != '\t';
      if (length == 0 || is_control) {
        fail(i, i + 1,
             "this is no UTF-8 text; let the spreadsheet save the table as "
             "\"CSV UTF-8\"");
      }
    }
  }

  char find_separator() const {
    // Where counts are equal, the first one is taken.
    constexpr std::array<char, 3> kSeparators = {',', ';', '\t'};
    std::array<std::size_t, 3> counts{};
    bool is_quoted = false;
    for (std::size_t i = place_; i < text_.size(); ++i) {
      if (is_line_end(text_[i]) && !is_quoted) break;
      if (text_[i] == '"') is_quoted = !is_quoted;
      for (std::size_t k = 0; k < kSeparators.size(); ++k) {
        if (text_[i] == kSeparators[k] && !is_quoted) ++counts[k];
      }
    }
    const auto most = std::max_element(counts.begin(), counts.end());
    return kSeparators[static_cast<std::size_t>(most - counts.begin())];
  }

  bool is_at_end() const { return place_ == text_.size(); }
  bool is_at_row_end() const {
    return is_at_end() || is_line_end(text_[place_]);
  }
  bool is_at_separator() const {
    return !is_at_end() && text_[place_] == separator_;
  }

  void skip_blanks() {
    while (!is_at_end() && is_blank(text_[place_]) && !is_at_separator()) {
      ++place_;
    }
  }

  // False at the end of the text.
  bool skip_empty_lines() {
    while (true) {
      const std::size_t begin = place_;
      skip_blanks();
      if (is_at_end()) return false;
      if (!is_at_row_end()) {
        place_ = begin;
        return true;
      }
      ++place_;
    }
  }

  CsvRow read_row() {
    CsvRow row;
    const std::size_t begin = place_;
    row.cells.push_back(read_cell());
    while (is_at_separator()) {
      ++place_;
      row.cells.push_back(read_cell());
    }
    row.range = range(begin, place_);
    row.line = source_.line_column(row.range.begin).line;
    return row;
  }

  std::string read_cell() {
    skip_blanks();
    if (!is_at_end() && text_[place_] == '"') return read_quoted();
    const std::size_t begin = place_;
    while (!is_at_row_end() && !is_at_separator()) ++place_;
    std::size_t end = place_;
    while (end > begin && is_blank(text_[end - 1])) --end;
    return text_.substr(begin, end - begin);
  }

  std::string read_quoted() {
    const std::size_t begin = place_++;
    std::string cell;
    while (true) {
      if (is_at_end()) fail(begin, begin + 1, "this quote has no end");
      const char c = text_[place_++];
      if (c == '"') {
        if (is_at_end() || text_[place_] != '"') break;
        ++place_;
      }
      cell += c;
    }
    skip_blanks();
    if (!is_at_row_end() && !is_at_separator()) {
      fail(begin, place_,
           "the cell goes on behind its quotes; a quote inside a cell is "
           "written twice");
    }
    return cell;
  }

  const Source& source_;
  const std::string& text_;
  std::size_t place_ = 0;
  char separator_ = ',';
};

}  // namespace

Csv read_csv(const Source& source) { return Reader(source).read(); }

std::string csv_cell(const std::string& text) {
  const bool is_plain =
      text.find_first_of(",;\t\"\r\n") == std::string::npos &&
      (text.empty() || (!is_blank(text.front()) && !is_blank(text.back())));
  if (is_plain) return text;
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

std::string csv_words(const std::string& text) {
  constexpr std::string_view kFormula = "=+-@\t\r";
  const bool is_formula =
      !text.empty() && kFormula.find(text.front()) != std::string_view::npos;
  return csv_cell(is_formula ? "'" + text : text);
}

}  // namespace lamina
