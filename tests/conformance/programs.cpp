#include "tests/conformance/programs.h"

#include <filesystem>
#include <regex>
#include <vector>

#include "tests/support/openscad_cache.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTimeLimit = "120";  // seconds

}  // namespace

std::string normalized(std::string text) {
  static const std::regex kTimestamp(", timestamp = [0-9]+");
  static const std::regex kFolders("(file = \")([^\"/]*/)*([^\"]*\")");
  text = std::regex_replace(text, kTimestamp, "");
  text = std::regex_replace(text, kFolders, "$1$3");
  const std::size_t first = text.find_first_not_of('\n');
  if (first == std::string::npos) return "\n";
  const std::size_t last = text.find_last_not_of('\n');
  return text.substr(first, last - first + 1) + "\n";
}

std::string run_lamina(const Case& one) {
  const support::TemporaryFolder folder;
  const std::string output = folder.file("output." + one.format);
  // Some designs show what 2021.01 does not understand: that would let lamina
  // read them as newer ones.
  std::vector<std::string> command = {"timeout", kTimeLimit, LAMINA_PROGRAM,
                                      "--language", "2021"};
  command.insert(command.end(), one.arguments.begin(), one.arguments.end());
  command.insert(command.end(), {"-o", output, one.design.string()});
  support::run_process(command, support::cache_folder().string());
  return fs::exists(output) ? support::read_file(output) : "";
}

std::string run_openscad(const Case& one) {
  const auto result =
      support::ask_openscad(one.design, one.format, one.arguments);
  return result.output.empty() ? ""
                               : support::read_file(result.output.string());
}

}  // namespace lamina::conformance
