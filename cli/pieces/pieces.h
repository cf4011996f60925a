#pragma once
// Several pieces in one run: the designs of a command line, the rows of a
// table.
//
// One bad piece never stops the rest. Where there are at least as many pieces
// as threads, each is made by one thread and as many are under way as there are
// threads; where there are fewer, one follows the other and has all threads.
// The bytes are those of single runs either way, and messages and the closing
// table keep the order of the pieces.
//
// Memory does not grow with the number of pieces. They come one by one, and
// what is said of them goes to the terminal and to files as soon as it is its
// turn. A thread that would get too far ahead of the piece whose turn it is
// waits.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/process/context.h"
#include "compiler/request.h"

namespace lamina::cli {

class Ledger;

struct Piece {
  compiler::Request request;
  std::string name;          // for the closing table
  std::string prefix;        // of its messages: "orders.csv:17: ring-17: "
  std::uint64_t number = 0;  // of the row or design, from 1
  std::uint32_t line = 0;    // of the table; 0: none
  std::string fault;         // why it cannot be made; empty: not known yet
};

class PieceSource {
 public:
  virtual ~PieceSource() = default;
  virtual std::uint64_t count() const = 0;
  // No value behind the last one. Called by one thread at a time.
  virtual std::optional<Piece> next() = 0;
};

class PieceList : public PieceSource {
 public:
  explicit PieceList(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}
  std::uint64_t count() const override { return pieces_.size(); }
  std::optional<Piece> next() override;

 private:
  std::vector<Piece> pieces_;
  std::size_t next_ = 0;
};

struct PiecesOptions {
  std::string_view unit = "pieces";  // what they are
  std::string report;    // path; .csv: a table, else JSON; empty: none
  unsigned threads = 0;  // 0: as many as the machine has
  bool is_quiet = false;
  Ledger* ledger = nullptr;  // notes what came of each piece; null: none
};

// Makes all pieces and their folders, but those that stand by the ledger;
// returns the exit status. What is written has been told to RunFiles before.
//
// throws  FileError where the report or the ledger cannot be written
int make_pieces(PieceSource& pieces, const PiecesOptions& options,
                const Context& context);

}  // namespace lamina::cli
