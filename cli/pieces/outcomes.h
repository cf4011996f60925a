#pragma once
// What came of pieces, told twice: in a table that closes the run on the
// terminal, and in the file of --report.
//
// Both are written piece by piece. A table of thousands of rows helps nobody:
// beyond kMostRows there is none.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file/output_file.h"
#include "cli/pieces/pieces.h"
#include "cli/report/json_list.h"
#include "compiler/compilation.h"

namespace lamina::cli {

struct Outcome {
  enum class Status : std::uint8_t { kDone, kFailed, kStood };
  Status status = Status::kFailed;  // kStood: an earlier run had made it
  std::string error;                // the first one
  compiler::Report report;
  nlohmann::ordered_json json;  // report_json(), if a report is wanted

  bool is_done() const { return status == Status::kDone; }
};

class Outcomes {
 public:
  static constexpr std::size_t kMostRows = 1000;

  // Opens the report, where one is wanted. Throws FileError.
  //
  // count    of the pieces
  // options  outlive it
  Outcomes(const PiecesOptions& options, std::uint64_t count,
           TemporaryFiles& temporary_files);

  // What is told of a piece.
  struct Entry {
    Outcome::Status status = Outcome::Status::kFailed;
    std::string name;
    std::string row;     // behind the name
    std::string report;  // of the file
    compiler::Machine machine;
    slicer::PrintEstimate estimate;
  };
  // Safe to call from several threads.
  Entry describe(const Piece& piece, const Outcome& outcome) const;

  // To be called in the order of the pieces.
  void add(const Entry& entry);

  bool are_all_done() const { return done_ + stood_ == count_; }

  // The table, without its last '\n'.
  std::string table(double seconds) const;

  // Ends the report and gives it its name.
  void commit_report(double seconds);

 private:
  const PiecesOptions& options_;
  std::uint64_t count_;
  std::unique_ptr<OutputFile> csv_;  // the report; at most one of the two
  std::unique_ptr<JsonList> json_;
  std::vector<std::pair<std::string, std::string>> rows_;  // name, the rest
  std::uint64_t done_ = 0;
  std::uint64_t failed_ = 0;
  std::uint64_t stood_ = 0;
  compiler::Machine machine_;    // of all pieces
  slicer::PrintEstimate total_;  // of those that this run made
};

}  // namespace lamina::cli
