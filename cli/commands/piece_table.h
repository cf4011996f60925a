#pragma once
// From a table to pieces: one for each row of a CSV file, or for each parameter
// set of a file of OpenSCAD's customizer.
//
//     name,size,engraving
//     ring-1,54,Ada
//
// Each column is a variable of the design, or a word of the pattern that names
// the outputs, or both. An empty cell leaves the design's own value.

#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/source.h"
#include "cli/commands/pieces.h"
#include "compiler/request.h"

namespace lamina::cli {

struct TableOptions {
  std::string table;              // path; .json: parameter sets
  std::set<std::string> skipped;  // columns that are passed over
  compiler::Request request;      // of all pieces; `output` is the pattern
};

// The pieces, in the order of the table. What is wrong with a row is the fault
// of its piece; what is wrong with more than that, such as a column that is no
// variable, is an error in `diagnostics`, and nothing can be made then.
//
// sources  keeps the table's text, in which errors have their places
// throws   Error where the table or the design cannot be read
std::vector<Piece> read_pieces(const TableOptions& options,
                               const FileAccess& access, SourceStore& sources,
                               Diagnostics& diagnostics);

}  // namespace lamina::cli
