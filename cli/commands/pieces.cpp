#include "cli/commands/pieces.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "base/text.h"
#include "cli/options/output_pattern.h"
#include "cli/process/exit_status.h"
#include "cli/process/run_on_stack.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/compile.h"
#include "compiler/passes.h"
#include "slicer/check/finding_table.h"

namespace lamina::cli {
namespace {

// What came of a piece. Lists of outcomes are in the order of the pieces.
struct Outcome {
  bool is_done = false;
  std::string error;  // the first one
  compiler::Report report;
  nlohmann::ordered_json json;  // report_json(), if a report is wanted
};

class Workshop {
 public:
  Workshop(std::span<const Piece> pieces, const PiecesOptions& options,
           const Context& context)
      : pieces_(pieces),
        options_(options),
        context_(context),
        outcomes_(pieces.size()) {
    const unsigned threads =
        options.threads != 0
            ? options.threads
            : std::max(1U, std::thread::hardware_concurrency());
    worker_count_ = pieces.size() < threads ? 1 : threads;
    threads_per_piece_ = worker_count_ == 1 ? threads : 1;
    line_ =
        std::make_unique<ProgressLine>(!options.is_quiet && worker_count_ > 1);
    line_->begin(pieces.size(), options.unit);
  }

  // The calling thread works too.
  std::vector<Outcome> run() {
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
    return std::move(outcomes_);
  }

 private:
  struct Worker {
    LargeStack stack;
    std::exception_ptr fault;  // what ended its work
  };

  // What is thrown here is no fault of a piece: memory lacks to begin one.
  std::exception_ptr work_caught(std::size_t stack) noexcept {
    try {
      work(stack);
      return nullptr;
    } catch (...) {
      return std::current_exception();
    }
  }

  void work(std::size_t stack) {
    while (const Piece* piece = next()) {
      // Its time includes that of its messages, which may find no reader.
      const ProcessWatch::Part timed(context_.watch, piece->prefix);
      const auto index = static_cast<std::size_t>(piece - pieces_.data());
      Inbox inbox{piece->prefix, worker_count_ == 1, "", ""};
      Outcome outcome = make(*piece, stack, inbox);
      take(index, std::move(outcome), std::move(inbox.text));
    }
  }

  const Piece* next() {
    const std::lock_guard lock(mutex_);
    return next_ < pieces_.size() ? &pieces_[next_++] : nullptr;
  }

  Outcome make(const Piece& piece, std::size_t stack, Inbox& inbox) {
    compiler::Request request = piece.request;
    request.settings.threads = threads_per_piece_;
    Session session(request, options_.is_quiet,
                    {context_.temporary_files, stack, context_.watch}, &inbox);
    compiler::Compilation& compilation = session.compilation;
    const int status = session.run([&] {
      if (!piece.fault.empty()) throw GeometryError(piece.fault);
      make_folder_of(request.output, context_.file_access());
      return compiler::compile(compilation) ? kDone : kFault;
    });
    Outcome outcome;
    outcome.is_done = status == kDone;
    outcome.report = compilation.report;
    if (status == kDone) {
      if (request.settings.min_feature > 0) {
        session.terminal.say(feature_lines(compilation));
      }
      if (!options_.report.empty()) outcome.json = report_json(compilation);
    }
    // Under hard warnings the last warning is the fault.
    outcome.error = inbox.first_error;
    if (status != kDone && outcome.error.empty()) {
      outcome.error = compilation.diagnostics.all().back().message;
    }
    return outcome;
  }

  // Shows the messages of all pieces that no unfinished one precedes.
  void take(std::size_t index, Outcome outcome, std::string text) {
    const std::lock_guard lock(mutex_);
    outcomes_[index] = std::move(outcome);
    held_back_.resize(pieces_.size());
    held_back_[index] = std::make_unique<std::string>(std::move(text));
    for (; shown_ < pieces_.size() && held_back_[shown_]; ++shown_) {
      const std::string& next_text = *held_back_[shown_];
      if (!next_text.empty()) {
        line_->erase();
        std::fwrite(next_text.data(), 1, next_text.size(), stderr);
      }
      held_back_[shown_].reset();
    }
    line_->show(++done_);
  }

  std::span<const Piece> pieces_;
  const PiecesOptions& options_;
  const Context& context_;
  unsigned worker_count_ = 1;
  unsigned threads_per_piece_ = 1;

  std::mutex mutex_;  // for all below
  std::unique_ptr<ProgressLine> line_;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
  std::size_t shown_ = 0;
  std::vector<Outcome> outcomes_;
  std::vector<std::unique_ptr<std::string>> held_back_;
};

std::size_t count_done(std::span<const Outcome> outcomes) {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(),
                    [](const Outcome& outcome) { return outcome.is_done; }));
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

// "2 warnings; 1 island": what a row says at its end.
std::string notes_of(const compiler::Report& report) {
  std::string text;
  if (report.warnings > 0) text = counted(report.warnings, "warning");
  if (report.slice.print && !report.slice.print->findings.empty()) {
    text += (text.empty() ? "" : "; ") +
            slicer::finding_counts(*report.slice.print);
  }
  return text;
}

// The closing table, without the last '\n'.
std::string outcome_table(std::span<const Piece> pieces,
                          std::span<const Outcome> outcomes,
                          std::string_view unit, double seconds) {
  std::size_t width = unit.size();
  std::vector<std::string> names;
  for (const Piece& piece : pieces) {
    width = std::max(width, names.emplace_back(on_one_line(piece.name)).size());
  }
  std::string table =
      fmt::format("{:<{}}  {:>7}  {:>24}  {:>11}  {:>9}  {:>7}\n", unit, width,
                  "layers", "size", "volume mm³", "weight g", "time s");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    table += fmt::format("{:<{}}  ", names[i], width);
    if (!outcome.is_done) {
      table += fmt::format("error: {}\n", first_line(outcome.error));
      continue;
    }
    const compiler::Report& report = outcome.report;
    const std::string row = fmt::format(
        "{:>7}  {:>24}  {:>11.3f}  {:>9}  {:>7.3f}  {}", report.slice.layers,
        size_text(report.slice.box.size()), report.slice.volume,
        report.estimate.grams > 0 ? fmt::format("{:.3f}", report.estimate.grams)
                                  : "-",
        report.wall_seconds, notes_of(report));
    table += fmt::format("{}\n", row.substr(0, row.find_last_not_of(' ') + 1));
  }
  const std::size_t done = count_done(outcomes);
  return table + fmt::format("{} of {} {} done, {} failed, in {:.3f} s", done,
                             pieces.size(), unit, pieces.size() - done,
                             seconds);
}

std::string outcomes_csv(std::span<const Piece> pieces,
                         std::span<const Outcome> outcomes) {
  std::string text =
      "line,name,output,layers,x_mm,y_mm,z_mm,volume_mm3,grams,seconds,"
      "warnings,findings,error\r\n";
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const Outcome& outcome = outcomes[i];
    const std::string line =
        piece.line > 0 ? fmt::format("{}", piece.line) : "";
    std::string figures = ",,,,,,,,,";
    if (outcome.is_done) {
      const compiler::Report& report = outcome.report;
      const Vec3 size = report.slice.box.size();
      figures = fmt::format(
          "{},{:.6g},{:.6g},{:.6g},{},{},{},{},{},", report.slice.layers,
          size.x, size.y, size.z, report.slice.volume,
          report.estimate.grams > 0 ? fmt::format("{}", report.estimate.grams)
                                    : "",
          report.wall_seconds, report.warnings,
          csv_words(report.slice.print
                        ? slicer::finding_counts(*report.slice.print)
                        : ""));
    } else {
      figures += csv_words(outcome.error);
    }
    text += fmt::format("{},{},{},{}\r\n", line, csv_words(piece.name),
                        csv_words(piece.request.output), figures);
  }
  return text;
}

std::string outcomes_json(std::span<const Piece> pieces,
                          std::span<const Outcome> outcomes, double seconds) {
  using Json = nlohmann::ordered_json;
  const std::size_t done = count_done(outcomes);
  Json json = {{"done", done},
               {"failed", pieces.size() - done},
               {"total_seconds", process_seconds()},
               {"wall_seconds", seconds},
               {"peak_memory_bytes", peak_memory_bytes()},
               {"pieces", Json::array()}};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const Outcome& outcome = outcomes[i];
    json["pieces"].push_back(
        {{"line", piece.line > 0 ? Json(piece.line) : Json()},
         {"name", piece.name},
         {"output", piece.request.output},
         {"error", outcome.is_done ? Json() : Json(outcome.error)},
         {"report", outcome.json}});
  }
  return json_text(json);
}

}  // namespace

int make_pieces(std::span<const Piece> pieces, const PiecesOptions& options,
                const Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  context.watch.time_parts();
  for (const Piece& piece : pieces) {
    if (piece.fault.empty()) context.expect_outputs({piece.request.output});
  }
  context.expect_outputs({options.report});
  const std::vector<Outcome> outcomes =
      Workshop(pieces, options, context).run();
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - begin;
  const ProcessWatch::Part timed(context.watch, "");
  Terminal terminal(options.is_quiet);
  terminal.say(outcome_table(pieces, outcomes, options.unit, seconds.count()));
  if (!options.report.empty()) {
    compiler::write_file(options.report,
                         options.report.ends_with(".csv")
                             ? outcomes_csv(pieces, outcomes)
                             : outcomes_json(pieces, outcomes, seconds.count()),
                         context.temporary_files);
  }
  return count_done(outcomes) == pieces.size() ? kDone : kFault;
}

}  // namespace lamina::cli
