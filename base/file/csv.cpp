#include "base/file/csv.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/utf8.h"

namespace lamina {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_space_or_tab(char c) { return c == ' ' || c == '\t'; }

}  // namespace

CsvReader::CsvReader(std::string path, Read read, SourceStore& sources)
    : path_(std::move(path)), read_(std::move(read)), sources_(sources) {}

bool CsvReader::next(CsvRow& row) {
  if (separator_ == '\0') begin();
  if (!skip_empty_lines()) return false;
  drop_what_was_read();
  row_begin_ = place_;
  count_lines();
  row.line = line_;
  row.cells.clear();
  row.cells.push_back(read_cell());
  while (is_at_separator()) {
    ++place_;
    row.cells.push_back(read_cell());
  }
  return true;
}

SourceRange CsvReader::range_of_row() { return range(row_begin_, place_); }

void CsvReader::begin() {
  while (text_.size() < kByteOrderMark.size() && refill()) {
  }
  if (text_.starts_with(kByteOrderMark)) {
    text_.erase(0, kByteOrderMark.size());
    checked_ -= kByteOrderMark.size();
  }
  separator_ = find_separator();
}

// False at the end of the table.
bool CsvReader::refill() {
  if (place_ - row_begin_ > kLongestCsvRow) {
    fail(row_begin_, row_begin_ + 1,
         fmt::format("this row has more than {} bytes: does a quote lack its "
                     "end?",
                     kLongestCsvRow));
  }
  const std::string more = read_();
  text_ += more;
  if (more.empty()) {
    // A character that was cut off stays so.
    if (checked_ < text_.size()) fail_encoding();
    return false;
  }
  check_text();
  return true;
}

void CsvReader::drop_what_was_read() {
  constexpr std::size_t kMuch = 1 << 16;
  if (place_ < kMuch) return;
  count_lines();
  text_.erase(0, place_);
  checked_ -= place_;
  place_ = counted_ = 0;
}

// Refuses other encodings: letters would come out wrong in the layers, where
// nobody reads them.
void CsvReader::check_text() {
  constexpr std::size_t kLongestCharacter = 4;
  while (checked_ < text_.size()) {
    const std::string_view rest = std::string_view(text_).substr(checked_);
    const std::size_t length = character_length(rest);
    const char c = rest.front();
    const bool is_control =
        static_cast<unsigned char>(c) < 0x20 && !is_line_end(c) && c != '\t';
    if (length == 0 && rest.size() < kLongestCharacter) return;
    if (length == 0 || is_control) fail_encoding();
    checked_ += length;
  }
}

void CsvReader::fail_encoding() {
  fail(checked_, checked_ + 1,
       "this is no UTF-8 text; let the spreadsheet save the table as "
       "\"CSV UTF-8\"");
}

char CsvReader::find_separator() {
  // Where counts are equal, the first one is taken.
  constexpr std::array<char, 3> kSeparators = {',', ';', '\t'};
  std::array<std::size_t, 3> counts{};
  bool is_quoted = false;
  for (; !is_at_end(); ++place_) {
    if (is_line_end(text_[place_]) && !is_quoted) break;
    if (text_[place_] == '"') is_quoted = !is_quoted;
    for (std::size_t k = 0; k < kSeparators.size(); ++k) {
      if (text_[place_] == kSeparators[k] && !is_quoted) ++counts[k];
    }
  }
  place_ = 0;
  const auto most = std::max_element(counts.begin(), counts.end());
  return kSeparators[static_cast<std::size_t>(most - counts.begin())];
}

// The line that holds a place of the text.
std::uint32_t CsvReader::line_at(std::size_t place) const {
  const auto [from, to] = std::minmax(counted_, place);
  const auto between = static_cast<std::uint32_t>(
      std::count(text_.data() + from, text_.data() + to, '\n'));
  return place < counted_ ? line_ - between : line_ + between;
}

void CsvReader::count_lines() {
  line_ = line_at(place_);
  counted_ = place_;
}

void CsvReader::fail(std::size_t begin, std::size_t end, std::string message) {
  throw FileError(std::move(message), range(begin, end));
}

// Keeps the lines from `begin` to `end`, below as many empty ones as precede
// them in the table: so they have their numbers.
SourceRange CsvReader::range(std::size_t begin, std::size_t end) {
  const std::size_t break_before =
      begin == 0 ? std::string::npos : text_.rfind('\n', begin - 1);
  const std::size_t first =
      break_before == std::string::npos ? 0 : break_before + 1;
  const std::size_t last = std::min(text_.find('\n', end), text_.size());
  const std::size_t lines = line_at(first) - 1;
  const Source& source = sources_.add(
      path_, std::string(lines, '\n') + text_.substr(first, last - first));
  return {&source, static_cast<std::uint32_t>(lines + begin - first),
          static_cast<std::uint32_t>(lines + end - first)};
}

bool CsvReader::is_at_end() { return place_ == text_.size() && !refill(); }

bool CsvReader::is_at_row_end() {
  return is_at_end() || is_line_end(text_[place_]);
}

bool CsvReader::is_at_separator() {
  return !is_at_end() && text_[place_] == separator_;
}

void CsvReader::skip_blanks() {
  while (!is_at_end() && is_space_or_tab(text_[place_]) && !is_at_separator()) {
    ++place_;
  }
}

// False at the end of the text.
bool CsvReader::skip_empty_lines() {
  while (true) {
    row_begin_ = place_;
    skip_blanks();
    if (is_at_end()) return false;
    if (!is_at_row_end()) {
      place_ = row_begin_;
      return true;
    }
    ++place_;
  }
}

std::string CsvReader::read_cell() {
  skip_blanks();
  if (!is_at_end() && text_[place_] == '"') return read_quoted();
  const std::size_t begin = place_;
  while (!is_at_row_end() && !is_at_separator()) ++place_;
  std::size_t end = place_;
  while (end > begin && is_space_or_tab(text_[end - 1])) --end;
  return text_.substr(begin, end - begin);
}

std::string CsvReader::read_quoted() {
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

std::string csv_cell(std::string_view text) {
  const bool is_plain =
      text.find_first_of(",;\t\"\r\n") == std::string_view::npos &&
      (text.empty() ||
       (!is_space_or_tab(text.front()) && !is_space_or_tab(text.back())));
  if (is_plain) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

std::string csv_words(const std::string& text) {
  constexpr std::string_view kFormula = "=+-@\t\r";
  // Spreadsheets of other countries part cells there, in the middle of ours.
  constexpr std::string_view kSeparators = ";\t\r\n";
  std::string words;
  bool is_begin = true;
  for (const char c : text) {
    if (is_begin && kFormula.find(c) != std::string_view::npos) words += '\'';
    words += c;
    is_begin =
        kSeparators.find(c) != std::string_view::npos || (is_begin && c == '"');
  }
  return csv_cell(words);
}

}  // namespace lamina
