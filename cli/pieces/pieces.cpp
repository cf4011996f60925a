#include "cli/pieces/pieces.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "base/paths.h"
#include "cli/options/output_pattern.h"
#include "cli/pieces/ledger.h"
#include "cli/pieces/outcomes.h"
#include "cli/process/exit_status.h"
#include "cli/process/run_on_stack.h"
#include "cli/process/streams.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/compile.h"

namespace lamina::cli {
namespace {

// How far a piece may be ahead of the one whose turn it is. It bounds what
// waits to be shown, some 2 KiB each, and is far more than one slow piece is
// worth.
constexpr std::uint64_t kFarthestAhead = 4096;

class WorkerPool {
 public:
  WorkerPool(PieceSource& pieces, const PiecesOptions& options,
             const Context& context, Outcomes& outcomes)
      : pieces_(pieces),
        options_(options),
        context_(context),
        outcomes_(outcomes) {
    const unsigned threads =
        options.threads != 0
            ? options.threads
            : std::max(1U, std::thread::hardware_concurrency());
    worker_count_ = pieces.count() < threads ? 1 : threads;
    threads_per_piece_ = worker_count_ == 1 ? threads : 1;
    line_ =
        std::make_unique<ProgressLine>(!options.is_quiet && worker_count_ > 1);
    line_->begin(pieces.count(), options.unit);
  }

  // The calling thread works too.
  void run() {
    const std::size_t others = worker_count_ - 1;
    context_.watch.reserve(std::uint64_t{others} * LargeStack::kLargestSize);
    std::vector<Worker> workers(others);
    std::size_t started = 0;
    for (Worker& worker : workers) {
      const auto work = [this, &worker] {
        worker.fault = work_caught(worker.stack.size());
      };
      if (!worker.stack.start(work)) break;
      ++started;
    }
    std::exception_ptr fault = work_caught(context_.stack);
    for (std::size_t i = 0; i < started; ++i) {
      workers[i].stack.join();
      if (!fault) fault = workers[i].fault;
    }
    line_->erase();
    if (fault) std::rethrow_exception(fault);
  }

 private:
  struct Worker {
    LargeStack stack;
    std::exception_ptr fault;  // what ended its work
  };

  struct Numbered {
    std::uint64_t turn = 0;  // from 0, in the order of the pieces
    Piece piece;
  };

  // What waits for its turn to be shown.
  struct Finished {
    Outcomes::Entry entry;
    std::string messages;
  };

  // What is thrown here is not a fault of a piece: memory lacks to begin one,
  // the table has changed, the ledger cannot be written.
  std::exception_ptr work_caught(std::size_t stack) noexcept {
    try {
      work(stack);
      return nullptr;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      // Nobody may wait for the piece that has no end now.
      has_lost_a_worker_ = true;
      has_shown_.notify_all();
      return std::current_exception();
    }
  }

  void work(std::size_t stack) {
    while (const std::optional<Numbered> next = next_piece()) {
      const Piece& piece = next->piece;
      // Its time includes that of its messages, which may find no reader.
      const ProcessWatch::Part timed(context_.watch, piece.prefix);
      Inbox inbox{piece.prefix, worker_count_ == 1, "", ""};
      const Outcome outcome = outcome_of(piece, stack, inbox);
      take(next->turn,
           {outcomes_.describe(piece, outcome), std::move(inbox.text)});
    }
  }

  std::optional<Numbered> next_piece() {
    std::unique_lock lock(mutex_);
    const auto is_near = [&] { return begun_ < shown_ + kFarthestAhead; };
    has_shown_.wait(lock, [&] { return is_near() || has_lost_a_worker_; });
    if (!is_near()) return std::nullopt;
    std::optional<Piece> piece = pieces_.next();
    if (!piece) return std::nullopt;
    return Numbered{begun_++, std::move(*piece)};
  }

  Outcome outcome_of(const Piece& piece, std::size_t stack, Inbox& inbox) {
    if (options_.ledger != nullptr && options_.ledger->stands(piece)) {
      Outcome outcome;
      outcome.status = Outcome::Status::kStood;
      return outcome;
    }
    return make(piece, stack, inbox);
  }

  Outcome make(const Piece& piece, std::size_t stack, Inbox& inbox) {
    compiler::Request request = piece.request;
    request.job.threads = threads_per_piece_;
    Session session(
        request, options_.is_quiet,
        {context_.temporary_files, stack, context_.watch, context_.interrupt},
        &inbox);
    compiler::Compilation& compilation = session.compilation;
    const int status = session.run([&] {
      if (!piece.fault.empty()) throw GeometryError(piece.fault);
      make_folder_of(request.output.path, context_.file_access());
      // Where a design failed, openscad's texts end well; a piece does not.
      return compiler::compile(compilation) && !compilation.has_failed ? kDone
                                                                       : kFault;
    });
    Outcome outcome;
    outcome.report = compilation.report;
    if (status == kDone) {
      outcome.status = Outcome::Status::kDone;
      if (request.job.min_feature > 0) {
        session.terminal.say(feature_lines(compilation));
      }
      if (!options_.report.empty()) outcome.json = report_json(compilation);
    }
    // Under hard warnings the last warning is the fault.
    outcome.error = inbox.first_error;
    if (status != kDone && outcome.error.empty()) {
      outcome.error = compilation.diagnostics.all().back().message;
    }
    outcome.error = with_display_paths(std::move(outcome.error));
    if (options_.ledger != nullptr) {
      session.terminal.finish();
      options_.ledger->note(piece, outcome, inbox.text, compilation);
    }
    return outcome;
  }

  // Shows all that no unfinished piece precedes.
  void take(std::uint64_t turn, Finished finished) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(turn, std::move(finished));
    for (auto next = waiting_.begin();
         next != waiting_.end() && next->first == shown_;
         next = waiting_.erase(next), ++shown_) {
      const std::string& messages = next->second.messages;
      if (!messages.empty()) {
        line_->erase();
        print_messages(messages);
      }
      outcomes_.add(next->second.entry);
    }
    line_->show(++done_);
    has_shown_.notify_all();
  }

  PieceSource& pieces_;
  const PiecesOptions& options_;
  const Context& context_;
  unsigned worker_count_ = 1;
  unsigned threads_per_piece_ = 1;

  std::mutex mutex_;  // for all below
  std::condition_variable has_shown_;
  bool has_lost_a_worker_ = false;
  Outcomes& outcomes_;
  std::unique_ptr<ProgressLine> line_;
  std::uint64_t begun_ = 0;
  std::uint64_t done_ = 0;
  std::uint64_t shown_ = 0;
  std::map<std::uint64_t, Finished> waiting_;
};

}  // namespace

std::optional<Piece> PieceList::next() {
  if (next_ == pieces_.size()) return std::nullopt;
  return std::move(pieces_[next_++]);
}

int make_pieces(PieceSource& pieces, const PiecesOptions& options,
                const Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  context.watch.time_parts();
  Outcomes outcomes(options, pieces.count(), context.temporary_files);
  WorkerPool(pieces, options, context, outcomes).run();
  if (options.ledger != nullptr) options.ledger->finish();
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - begin;
  const ProcessWatch::Part timed(context.watch, "");
  Terminal terminal(options.is_quiet);
  terminal.say(outcomes.table(seconds.count()));
  outcomes.commit_report(seconds.count());
  return outcomes.are_all_done() ? kDone : kFault;
}

}  // namespace lamina::cli
