// Tables of `lamina batch`.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/csv.h"
#include "base/diagnostic.h"
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
  const Source source("x.csv", std::string(fuzz::as_text(data, size)));
  try {
    for (const CsvRow& row : read_csv(source).rows) {
      for (const std::string& cell : row.cells) take(cell);
    }
  } catch (const FileError&) {
  }
  return 0;
}
