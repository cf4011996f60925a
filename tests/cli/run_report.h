#pragma once
// The report of a run of the program.

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"

namespace lamina::cli {

// Runs it with these arguments, which must go well, and returns its --report.
inline nlohmann::json report_of(const support::TemporaryFolder& folder,
                                std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"-q", "--report", "report.json"});
  const auto made = run(folder, std::move(arguments));
  EXPECT_EQ(made.status, 0) << made.errors;
  return nlohmann::json::parse(support::read_file(folder.file("report.json")));
}

}  // namespace lamina::cli
