#include "cli/pieces/collect.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/pieces/ledger.h"
#include "cli/pieces/outcomes.h"
#include "cli/process/exit_status.h"
#include "cli/report/json_list.h"
#include "cli/report/session.h"

namespace lamina::cli {
namespace {

using Json = nlohmann::ordered_json;
using State = LedgerIndex::State;

class Collector {
 public:
  Collector(const CollectOptions& options, const Context& context)
      : options_(options),
        access_(context.file_access()),
        index_(context.file_access()),
        terminal_(options.is_quiet) {
    if (!options.report.empty()) {
      list_ =
          std::make_unique<JsonList>(options.report, context.temporary_files);
    }
  }

  int run(PieceSource& pieces) {
    for (const std::string& ledger : options_.ledgers) read(ledger);
    index_.close();
    while (const std::optional<Piece> piece = pieces.next()) judge(*piece);
    if (told_ > Outcomes::kMostRows) {
      terminal_.say(
          fmt::format("... and {} more", told_ - Outcomes::kMostRows));
    }
    terminal_.say(table());
    if (list_ != nullptr) list_->commit(totals(), "pieces");
    return failed_ + missing_ == 0 ? kDone : kFault;
  }

 private:
  // A share that was never begun has no ledger.
  void read(const std::string& ledger) {
    access_.require(ledger);
    if (!access_.is_there(ledger)) {
      return terminal_.say(fmt::format("there is no ledger '{}'", ledger));
    }
    const OpenFile file = access_.open(ledger);
    if (!file) throw FileError(fmt::format("Can't open ledger '{}'", ledger));
    index_.read(ledger, file);
  }

  void judge(const Piece& piece) {
    const LedgerIndex::Entry entry =
        index_.find(asked_key(piece, options_.asked));
    ++count_;
    if (entry.times > 1) ++twice_;
    if (entry.state == State::kFailed) {
      ++failed_;
      return tell(piece, "failed", index_.failure_of(entry));
    }
    if (entry.state != State::kDone ||
        !is_as_noted(piece.request.output.path, entry, access_)) {
      ++missing_;
      return tell(piece, "missing", {});
    }
    ++done_;
    bytes_ += entry.bytes;
    if (entry.times > 1) list(piece, "twice", {});
  }

  void tell(const Piece& piece, std::string_view what,
            const LedgerIndex::Failure& failure) {
    if (++told_ <= Outcomes::kMostRows) {
      std::string line = fmt::format("{}{}", piece.prefix, what);
      if (!failure.error.empty()) line += ": " + first_line(failure.error);
      terminal_.say(line);
    }
    list(piece, what, failure);
  }

  void list(const Piece& piece, std::string_view what,
            const LedgerIndex::Failure& failure) {
    if (list_ == nullptr) return;
    list_->add(
        list_element({{"row", piece.number},
                      {"line", piece.line > 0 ? Json(piece.line) : Json()},
                      {"name", piece.name},
                      {"output", piece.request.output.path},
                      {"status", what},
                      {"error", failure.error},
                      {"messages", failure.messages}}));
  }

  std::string table() const {
    return fmt::format(
        "{:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>11}  {:>10}  {:>9}\n"
        "{:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>11.3f}  {:>10.1f}  {:>9.1f}",
        "pieces", "done", "failed", "missing", "twice", "output MB", "seconds",
        "memory MB", count_, done_, failed_, missing_, twice_,
        static_cast<double>(bytes_) / 1e6, index_.seconds(),
        static_cast<double>(index_.peak_memory_bytes()) / 1e6);
  }

  Json totals() const {
    return {{"count", count_},
            {"done", done_},
            {"failed", failed_},
            {"missing", missing_},
            {"twice", twice_},
            {"output_bytes", bytes_},
            {"seconds", index_.seconds()},
            {"peak_memory_bytes", index_.peak_memory_bytes()},
            {"torn_lines", index_.torn_lines()}};
  }

  const CollectOptions& options_;
  const FileAccess& access_;
  LedgerIndex index_;
  Terminal terminal_;
  std::unique_ptr<JsonList> list_;  // of what is not simply done
  std::uint64_t told_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t done_ = 0;
  std::uint64_t failed_ = 0;
  std::uint64_t missing_ = 0;
  std::uint64_t twice_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

int collect_pieces(PieceSource& pieces, const CollectOptions& options,
                   const Context& context) {
  return Collector(options, context).run(pieces);
}

}  // namespace lamina::cli
