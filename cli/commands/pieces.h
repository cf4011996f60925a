#pragma once
// Several pieces in one run: the designs of a command line, the rows of a
// table.
//
// One bad piece never stops the rest. Where there are at least as many pieces
// as threads, each is made by one thread and as many are under way as there are
// threads, so that memory does not grow with the table; where there are fewer,
// one follows the other and has all threads. The bytes are those of single
// runs either way, and messages and the closing table keep the order of the
// pieces.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "cli/process/context.h"
#include "compiler/request.h"

namespace lamina::cli {

struct Piece {
  compiler::Request request;
  std::string name;        // for the closing table
  std::string prefix;      // of its messages: "orders.csv:17: ring-17: "
  std::uint32_t line = 0;  // of the table; 0: none
  std::string fault;       // why it cannot be made; empty: not known yet
};

struct PiecesOptions {
  std::string_view unit = "pieces";  // what they are
  std::string report;    // path; .csv: a table, else JSON; empty: none
  unsigned threads = 0;  // 0: as many as the machine has
  bool is_quiet = false;
};

// Makes all pieces and their folders; returns the exit status.
//
// throws  FileError where the report cannot be written
int make_pieces(std::span<const Piece> pieces, const PiecesOptions& options,
                const Context& context);

}  // namespace lamina::cli
