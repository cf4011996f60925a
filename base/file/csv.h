#pragma once
// Tables as spreadsheets write them: CSV, as RFC 4180 describes it.
//
//     name;size;engraving
//     ring-1;54,5;"Ada; forever"
//
// Lines end with LF, CR or both; a byte order mark in front is passed over. The
// most frequent of comma, semicolon and tab in the first line separates cells.
// Departures from RFC 4180, for tables that are written by hand: blanks around
// a cell belong to it only between quotes, and empty lines are not rows. No CSV
// reader for C or C++ in Debian says where a fault is.
//
// A table may have millions of rows. So it is read row by row, and no more than
// a block of it is in memory.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"

namespace lamina {

struct CsvRow {
  std::uint32_t line = 1;  // on which it begins
  std::vector<std::string> cells;
};

// The most bytes that a row may have. A quote without an end would take the
// rest of the table for one cell.
inline constexpr std::size_t kLongestCsvRow = std::size_t{1} << 20;

class CsvReader {
 public:
  // Returns the next bytes of the table; none at its end.
  using Read = std::function<std::string()>;

  // path     as messages show it
  // sources  keeps the texts of places; outlives the reader
  CsvReader(std::string path, Read read, SourceStore& sources);

  // Reads the next row; the header is the first one. Returns false at the end.
  //
  // throws  FileError, with the place, where quotes do not match, a byte is no
  //         UTF-8 text or a row is too long
  bool next(CsvRow& row);

  // Known when the header has been read.
  char separator() const { return separator_; }

  // The row that was read last, without its line break. Cost: its text is kept.
  SourceRange range_of_row();

 private:
  void begin();
  bool refill();
  void drop_what_was_read();
  void check_text();
  char find_separator();
  std::uint32_t line_at(std::size_t place) const;
  void count_lines();
  [[noreturn]] void fail_encoding();
  [[noreturn]] void fail(std::size_t begin, std::size_t end,
                         std::string message);
  SourceRange range(std::size_t begin, std::size_t end);

  bool is_at_end();
  bool is_at_row_end();
  bool is_at_separator();
  void skip_blanks();
  bool skip_empty_lines();
  std::string read_cell();
  std::string read_quoted();

  std::string path_;
  Read read_;
  SourceStore& sources_;
  char separator_ = '\0';    // nothing has been read
  std::string text_;         // begins at the begin of a line
  std::size_t checked_ = 0;  // bytes of it that are known to be text
  std::size_t place_ = 0;
  std::size_t row_begin_ = 0;
  std::size_t counted_ = 0;  // bytes of it whose lines are counted
  std::uint32_t line_ = 1;   // that holds the byte behind them
};

// A cell as it stands in CSV with commas, in quotes where it needs them.
std::string csv_cell(std::string_view text);

// A cell of words, which a spreadsheet must not take for a formula: what begins
// like one gets an apostrophe in front.
std::string csv_words(const std::string& text);

}  // namespace lamina
