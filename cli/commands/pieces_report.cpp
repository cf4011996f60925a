#include "cli/commands/pieces_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "cli/report/run_report.h"

namespace lamina::cli {
namespace {

std::size_t count_done(std::span<const Outcome> outcomes) {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(),
                    [](const Outcome& outcome) { return outcome.is_done; }));
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

Outcome outcome_of(const compiler::Report& report, bool is_done) {
  Outcome outcome;
  outcome.is_done = is_done;
  outcome.layers = report.slice.layers;
  outcome.volume = report.slice.volume;
  outcome.seconds = report.wall_seconds;
  return outcome;
}

std::string outcome_table(std::span<const Piece> pieces,
                          std::span<const Outcome> outcomes,
                          std::string_view unit, double seconds) {
  std::size_t width = unit.size();
  for (const Piece& piece : pieces) width = std::max(width, piece.name.size());
  std::string table =
      fmt::format("{:<{}}   layers   volume mm3   time s\n", unit, width);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    table += fmt::format("{:<{}}  ", pieces[i].name, width);
    table += outcome.is_done
                 ? fmt::format("{:>7}  {:>11.3f}  {:>7.3f}\n", outcome.layers,
                               outcome.volume, outcome.seconds)
                 : fmt::format("error: {}\n", first_line(outcome.error));
  }
  const std::size_t done = count_done(outcomes);
  return table + fmt::format("{} of {} {} done, {} failed, in {:.3f} s", done,
                             pieces.size(), unit, pieces.size() - done,
                             seconds);
}

std::string outcomes_csv(std::span<const Piece> pieces,
                         std::span<const Outcome> outcomes) {
  std::string text = "line,name,output,layers,volume_mm3,seconds,error\r\n";
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const Outcome& outcome = outcomes[i];
    const std::string line =
        piece.line > 0 ? fmt::format("{}", piece.line) : "";
    const std::string figures =
        outcome.is_done ? fmt::format("{},{},{},", outcome.layers,
                                      outcome.volume, outcome.seconds)
                        : ",,," + csv_cell(outcome.error);
    text += fmt::format("{},{},{},{}\r\n", line, csv_cell(piece.name),
                        csv_cell(piece.request.output), figures);
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

}  // namespace lamina::cli
