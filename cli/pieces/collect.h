#pragma once
// `lamina batch --collect`: what ledgers say of the pieces of a table.

#include <string>
#include <vector>

#include "cli/pieces/pieces.h"

namespace lamina::cli {

struct CollectOptions {
  std::vector<std::string> ledgers;
  std::string asked;   // as of LedgerOptions
  std::string report;  // path of a JSON file; empty: none
  bool is_quiet = false;
};

// Names the pieces that are missing or failed, and counts all. Returns the exit
// status: kFault where one is missing or failed.
//
// throws  FileError where a ledger cannot be read or the report not be written
int collect_pieces(PieceSource& pieces, const CollectOptions& options,
                   const Context& context);

}  // namespace lamina::cli
