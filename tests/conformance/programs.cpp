#include "tests/conformance/programs.h"

#include <cstdint>
#include <regex>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

using support::ProcessResult;
using support::TemporaryFolder;

// Endless recursion takes openscad half a minute.
constexpr const char* kTimeLimit = "120";

// Runs `program` on the case and returns what it wrote.
std::string run_program(const std::string& program, const Case& one) {
  const TemporaryFolder folder;
  const std::string output = folder.file("output." + one.format);
  std::vector<std::string> command = {"timeout", kTimeLimit, program};
  command.insert(command.end(), one.arguments.begin(), one.arguments.end());
  command.insert(command.end(), {"-o", output, one.design.string()});
  support::run_process(command, folder.path());
  return fs::exists(output) ? support::read_file(output) : "";
}

// FNV-1a.
std::uint64_t hash(const std::string& text) {
  std::uint64_t value = 0xcbf29ce484222325;
  for (const char c : text) {
    value ^= static_cast<unsigned char>(c);
    value *= 0x100000001b3;
  }
  return value;
}

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
  return run_program(LAMINA_PROGRAM, one);
}

OpenScad::OpenScad(fs::path cache) : cache_(std::move(cache)) {
  const ProcessResult result = support::run_process({"openscad", "--version"});
  if (result.status != 0) throw std::runtime_error("openscad does not run");
  version_ = result.output + result.errors;
  fs::create_directories(cache_);
}

std::string OpenScad::run(const Case& one) const {
  std::string key =
      version_ + one.design.string() + support::read_file(one.design.string());
  for (const std::string& argument : one.arguments) key += '\0' + argument;
  const fs::path kept =
      cache_ / fmt::format("{:016x}.{}", hash(key), one.format);
  if (!fs::exists(kept)) {
    const TemporaryFolder folder;
    const std::string beside =
        folder.write("output", run_program("openscad", one));
    const fs::path unique = kept.string() + fmt::format(".{}", ::getpid());
    fs::copy_file(beside, unique, fs::copy_options::overwrite_existing);
    fs::rename(unique, kept);
  }
  return support::read_file(kept.string());
}

}  // namespace lamina::conformance
