#pragma once
// What came of all pieces: the closing table, and `--report`.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "cli/commands/pieces.h"
#include "compiler/report.h"

namespace lamina::cli {

struct Outcome {
  bool is_done = false;
  std::string error;  // the first one
  std::uint64_t layers = 0;
  double volume = 0;            // [mm³]
  double seconds = 0;           // by the clock
  nlohmann::ordered_json json;  // report_json(), if a report is wanted
};

Outcome outcome_of(const compiler::Report& report, bool is_done);

// Each function takes the outcomes in the order of the pieces.

// Without the last '\n'.
std::string outcome_table(std::span<const Piece> pieces,
                          std::span<const Outcome> outcomes,
                          std::string_view unit, double seconds);
std::string outcomes_csv(std::span<const Piece> pieces,
                         std::span<const Outcome> outcomes);
std::string outcomes_json(std::span<const Piece> pieces,
                          std::span<const Outcome> outcomes, double seconds);

}  // namespace lamina::cli
