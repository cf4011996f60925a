#include "cli/report/pieces_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/csv.h"

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

// Names and messages can hold any bytes.
std::string json_text(const std::string& text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

Outcome outcome_of(const RunReport& report, bool is_done) {
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
                        csv_cell(piece.options.output), figures);
  }
  return text;
}

std::string outcomes_json(std::span<const Piece> pieces,
                          std::span<const Outcome> outcomes, double seconds) {
  const std::size_t done = count_done(outcomes);
  std::string text = fmt::format(
      "{{\n\"done\": {},\n\"failed\": {},\n\"total_seconds\": {},\n"
      "\"wall_seconds\": {},\n\"peak_memory_bytes\": {},\n\"pieces\": [",
      done, pieces.size() - done, process_seconds(), seconds,
      peak_memory_bytes());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const Outcome& outcome = outcomes[i];
    text += fmt::format(
        "{}\n{{\"line\": {}, \"name\": {}, \"output\": {}, \"error\": {}, "
        "\"report\": {}}}",
        i == 0 ? "" : ",",
        piece.line > 0 ? fmt::format("{}", piece.line) : "null",
        json_text(piece.name), json_text(piece.options.output),
        outcome.is_done ? "null" : json_text(outcome.error),
        outcome.json.empty() ? "null" : outcome.json);
  }
  return text + "\n]\n}\n";
}

}  // namespace lamina::cli
