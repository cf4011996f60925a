#pragma once
// The ledger of a batch: a file that gets a line of JSON for each piece that
// was made or failed, so that a batch that was cut short goes on where it
// ended, and shares that were made apart can be counted together.
//
//     {"read": "9a…", "files": [["ring.scad", "5c…"], …]}
//     {"row": 17, "line": 18, "name": "ring-17", "output": "out/ring-17.slc",
//      "key": "3f….9a…", "status": "done", "seconds": 0.025, …}
//
// The key of a piece has two halves. What was asked: version, options, the
// row's values, its output. What was read: the design and all files on which
// its output depends. Only the run knows which these were, so a line of their
// own names them, before the first piece that read just these. A piece stands
// if both halves are those of today and its output is there, byte for byte.
//
// A ledger only grows. Lines of pieces whose files are others today count no
// more; of the others of a piece the last one that says "done" counts, or else
// the last. A line that was torn as the machine stopped is passed over, and its
// piece made again.

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <sys/stat.h>

#include "base/file/append_file.h"
#include "base/file/file_access.h"
#include "base/file/open_file.h"
#include "cli/pieces/outcomes.h"
#include "cli/pieces/pieces.h"
#include "compiler/compilation.h"

namespace lamina::cli {

// Digests of files, each read once as long as it does not change. Safe to use
// from several threads.
class FileDigests {
 public:
  explicit FileDigests(const FileAccess& access) : access_(access) {
    access_.report_to(nullptr);  // to know a file again is not to read it
  }

  // "none" for what is not a file that may be read.
  std::string digest_of(const std::string& path);

 private:
  struct Known {
    struct stat status {};
    std::string digest;
  };

  FileAccess access_;
  std::mutex mutex_;
  std::map<std::string, Known> known_;
};

// What ledgers say of pieces, in some 40 bytes for each.
class LedgerIndex {
 public:
  explicit LedgerIndex(const FileAccess& access) : files_(access) {}

  // Reads a ledger; what it says comes after all that were read before.
  //
  // throws  FileError where it cannot be read
  void read(const std::string& path, const OpenFile& file);
  // To be called behind the last ledger.
  void close();

  enum class State : std::uint8_t { kUnknown, kDone, kFailed };
  struct Entry {
    std::uint64_t piece = 0;   // fingerprint of what was asked
    std::uint64_t output = 0;  // fingerprint of the output's digest
    std::uint64_t bytes = 0;   // of the output
    std::uint32_t times = 0;   // how often it was done
    State state = State::kUnknown;
  };

  // Of a piece of which there is no line, or whose files are others today, the
  // state is kUnknown.
  //
  // asked_key  as of the function
  Entry find(const std::string& asked_key) const;

  struct Failure {
    std::string error;
    std::vector<std::string> messages;
  };
  // Of a piece that failed; of very many, not all are kept.
  Failure failure_of(const Entry& entry) const;

  std::uint64_t torn_lines() const { return torn_lines_; }
  double seconds() const { return seconds_; }
  std::uint64_t peak_memory_bytes() const { return peak_memory_bytes_; }

 private:
  void read_line(std::string_view line);

  FileDigests files_;
  std::set<std::string> standing_;  // digests of files that are as they were
  std::vector<Entry> entries_;
  std::map<std::uint64_t, Failure> failures_;  // by pieces
  std::uint64_t torn_lines_ = 0;
  double seconds_ = 0;
  std::uint64_t peak_memory_bytes_ = 0;
};

// Whether the output is what the entry's line says, byte for byte.
bool is_as_noted(const std::string& output, const LedgerIndex::Entry& entry,
                 const FileAccess& access);

// The first half of a piece's key, by which it is known again. Names in a line
// are for people: what of them is no UTF-8 is replaced there.
//
// options  what was asked of all pieces, as text
std::string asked_key(const Piece& piece, const std::string& options);

struct LedgerOptions {
  std::string path;
  bool resumes = false;
  std::string asked;  // of all pieces, as text
};

// Safe to use from several threads.
class Ledger {
 public:
  // Opens the ledger, or begins it; reads it where the run resumes.
  //
  // access  outlives it
  // throws  FileError where that cannot be, AccessError where it may not
  Ledger(const LedgerOptions& options, const FileAccess& access);

  // Whether the piece was done and is as it was.
  bool stands(const Piece& piece) const;

  // messages  as they were shown
  // Throws FileError where the line cannot be written.
  void note(const Piece& piece, const Outcome& outcome,
            const std::string& messages,
            const compiler::Compilation& compilation);

  // Returns when the lines are safe from the machine's failure.
  void finish();

 private:
  std::string read_key(const compiler::Compilation& compilation);
  // With the mutex held.
  void append(const std::string& line);

  const LedgerOptions options_;
  const FileAccess& access_;
  FileDigests files_;
  std::optional<LedgerIndex> index_;  // where the run resumes

  std::mutex mutex_;  // for all below
  AppendFile file_;
  std::set<std::string> noted_;  // sets of files that have a line
  std::chrono::steady_clock::time_point last_sync_;
  std::uint64_t memory_;  // the most so far, looked at with every sync
};

}  // namespace lamina::cli
