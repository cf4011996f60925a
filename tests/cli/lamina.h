#pragma once
// Runs the program under test.

#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::cli {

inline std::vector<std::string> command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), LAMINA_PROGRAM);
  return arguments;
}

inline support::ProcessResult run(const support::TemporaryFolder& folder,
                                  std::vector<std::string> arguments) {
  return support::run_process(command(std::move(arguments)), folder.path());
}

}  // namespace lamina::cli
