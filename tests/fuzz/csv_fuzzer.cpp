// Tables of `lamina batch`.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "base/diagnostic.h"
#include "base/file/csv.h"
#include "base/source.h"
#include "parser/cell.h"
#include "parser/tree_facts.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

void take(const std::string& cell) {
  csv_cell(cell);
  if (cell.empty()) return;
  for (const ast::ValueType kind :
       {ast::ValueType::kString, ast::ValueType::kNumber}) {
    try {
      value_of_cell(cell, kind, DecimalSign::kPointOrComma);
    } catch (const FileError&) {
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string text(fuzz::as_text(data, size));
  SourceStore sources;
  bool is_read = false;
  CsvReader reader(
      "x.csv",
      [&] { return std::exchange(is_read, true) ? std::string() : text; },
      sources);
  try {
    for (CsvRow row; reader.next(row);) {
      for (const std::string& cell : row.cells) take(cell);
    }
  } catch (const FileError&) {
  }
  return 0;
}
