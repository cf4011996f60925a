#pragma once
// Tables as spreadsheets write them: CSV, as RFC 4180 describes it.
//
//     name;size;engraving
//     ring-1;54,5;"Ada; forever"
//
// Lines end with LF, CR or both; a byte order mark in front is passed over. The
// most frequent of comma, semicolon and tab in the first line separates cells.
// Departures from RFC 4180, for tables that are written by hand: blanks around
// a cell belong to it only between quotes, and empty lines are no rows. No CSV
// reader for C or C++ in Debian tells where a fault is.

#include <cstdint>
#include <string>
#include <vector>

#include "base/source.h"

namespace lamina {

struct CsvRow {
  SourceRange range;       // the row's text, without its line break
  std::uint32_t line = 1;  // on which it begins
  std::vector<std::string> cells;
};

struct Csv {
  char separator = ',';
  std::vector<CsvRow> rows;  // the header too
};

// Throws FileError, with the place, where quotes do not match or a byte is no
// UTF-8 text.
Csv read_csv(const Source& source);

// A cell as it stands in CSV with commas, in quotes where it needs them.
std::string csv_cell(const std::string& text);

// A cell of words, which a spreadsheet must not take for a formula: what begins
// like one gets an apostrophe in front.
std::string csv_words(const std::string& text);

}  // namespace lamina
