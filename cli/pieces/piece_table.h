#pragma once
// From a table to pieces: one for each row of a CSV file, or for each parameter
// set of a file of OpenSCAD's customizer.
//
//     name,size,engraving
//     ring-1,54,Ada
//
// Each column is a variable of the design, or a word of the pattern that names
// the outputs, or both. An empty cell leaves the design's own value.
//
// The table is read twice. First as a whole, for what must be known before
// anything is made: how many rows it has, and that no two have one output. Then
// row by row, as pieces are wanted. So memory holds a block of the table, and
// of each row no more than a fingerprint of its output.

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/source.h"
#include "cli/pieces/pieces.h"
#include "compiler/request.h"
#include "parser/customizer/definitions.h"

namespace lamina::cli {

// One of several equal shares of a table. Rows are dealt like cards: what
// makes them slow or wrong often comes in runs, and a row keeps its share when
// others are appended to the table.
struct Share {
  std::uint64_t index = 1;  // from 1 to `count`
  std::uint64_t count = 1;

  // row  its number, from 1
  bool has(std::uint64_t row) const { return (row - 1) % count == index - 1; }
};

struct TableOptions {
  std::string table;              // path; .json: parameter sets
  std::set<std::string> skipped;  // columns that are passed over
  Share share;
  compiler::Request request;  // of all pieces; `output` is the pattern
};

// The pieces of the share, in the order of the table, whose outputs have been
// told to RunFiles. What is wrong with a row is the fault of its piece; what is
// wrong with more than that, such as a column that is not a variable, is an
// error in `diagnostics`, and nothing can be made then.
//
// options  outlives the result, as do the others
// sources  keeps the places of errors
// throws   Error where the table or the design cannot be read; so does next(),
//          where the table has changed
std::unique_ptr<PieceSource> open_table(const TableOptions& options,
                                        const FileAccess& access,
                                        SourceStore& sources,
                                        Diagnostics& diagnostics);

// The variables that the design lets others set. Its errors go to
// `diagnostics`; its warnings come with its pieces.
Variables variables_of(const compiler::Request& request,
                       const FileAccess& access, SourceStore& sources,
                       Diagnostics& diagnostics);

// Whether it is the name of a variable such as $fn, which a design need not
// mention. What else begins with '$' may be code.
bool is_special_variable(std::string_view name);

}  // namespace lamina::cli
