// The parser against the installed openscad: the same trees, the same warnings
// of the parser, the same first error, for all files that come with it and for
// random programs.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "parser/customizer/program_printer.h"
#include "parser/loader.h"
#include "random_programs.h"
#include "tests/parser/parsed.h"
#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

namespace fs = std::filesystem;

using support::read_file;
using support::TemporaryFolder;

// What a parser makes of a file.
struct Outcome {
  std::string ast;
  std::string messages;  // those of the parser, one a line

  bool operator==(const Outcome&) const = default;
};

std::string quote(const fs::path& path) {
  return fmt::format("'{}'", path.string());
}

// Keeps the parser's lines of a log. Of its errors only the first counts: the
// installed openscad ends there.
std::string filter_messages(const std::string& log) {
  std::string kept;
  std::istringstream lines(log);
  bool has_error = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_error = line.starts_with("ERROR: Parser error: ");
    const bool is_warning =
        line.find(" was assigned on line ") != std::string::npos ||
        line.starts_with("WARNING: Can't open include file") ||
        line.starts_with("WARNING: Can't open library");
    if (is_warning || (is_error && !has_error)) kept += line + "\n";
    has_error = has_error || is_error;
  }
  return kept;
}

// Runs openscad in the folder of `design`.
Outcome ask_openscad(const fs::path& design, const fs::path& scratch) {
  const fs::path tree = scratch.string() + ".ast";
  const fs::path log = scratch.string() + ".log";
  const std::string command =
      fmt::format("cd {} && timeout 60 {} -o {} {} >/dev/null 2>{}",
                  quote(design.parent_path()), LAMINA_OPENSCAD_PROGRAM,
                  quote(tree), quote(design.filename()), quote(log));
  const int status = std::system(command.c_str());
  Outcome outcome;
  if (status == 0) outcome.ast = read_file(tree.string());
  outcome.messages = filter_messages(read_file(log.string()));
  return outcome;
}

// Parses `design` as if the program had been started in its folder.
Outcome ask_lamina(const fs::path& design) {
  const fs::path start = fs::current_path();
  fs::current_path(design.parent_path());
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, library_folders());
  Outcome outcome;
  run_on_large_stack([&] {
    try {
      outcome.ast = ast::print(loader.load(design.filename().string()));
    } catch (const SyntaxError&) {
    }
  });
  std::string log;
  for (const Diagnostic& message : diagnostics.all()) {
    log += openscad_line(message, "");
  }
  outcome.messages = filter_messages(log);
  fs::current_path(start);
  return outcome;
}

// Openscad's outcomes, several runs at a time.
std::vector<Outcome> ask_openscad(const std::vector<fs::path>& designs,
                                  const TemporaryFolder& scratch) {
  std::vector<Outcome> outcomes(designs.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < designs.size(); i = next++) {
      outcomes[i] =
          ask_openscad(designs[i], scratch.file(fmt::format("run{}", i)));
    }
  };
  std::vector<std::future<void>> workers;
  const unsigned count = std::max(1U, std::thread::hardware_concurrency());
  for (unsigned i = 0; i < count; ++i) {
    workers.push_back(std::async(std::launch::async, work));
  }
  for (std::future<void>& worker : workers) worker.get();
  return outcomes;
}

void print_score(const char* what, std::size_t passed, std::size_t all) {
  std::printf("%-44s %5zu passed %5zu failed\n", what, passed, all - passed);
}

// Compares both programs on all of `designs` and prints the score.
void expect_agreement(const char* what, const std::vector<fs::path>& designs) {
  const TemporaryFolder scratch;
  const std::vector<Outcome> expected = ask_openscad(designs, scratch);
  std::size_t passed = 0;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const Outcome outcome = ask_lamina(designs[i]);
    EXPECT_EQ(outcome.messages, expected[i].messages) << designs[i];
    EXPECT_TRUE(outcome.ast == expected[i].ast) << designs[i];
    if (outcome == expected[i]) ++passed;
  }
  print_score(what, passed, designs.size());
}

std::vector<fs::path> find_files(const fs::path& folder,
                                 const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name.ends_with(ending)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<fs::path> find_design(const std::string& name) {
  for (const fs::path& path :
       find_files(fs::path(LAMINA_OPENSCAD_DATA) / "testdata", ".scad")) {
    if (path.stem() == name) return path;
  }
  return std::nullopt;
}

TEST(AstPrinter, PrintsTheTreesThatOpenscadsOwnTestsExpect) {
  const std::string ending = "-expected.ast";
  const std::vector<fs::path> trees = find_files(
      fs::path(LAMINA_OPENSCAD_DATA) / "regression" / "astdumptest", ending);
  ASSERT_GE(trees.size(), 20u);
  std::size_t passed = 0;
  for (const fs::path& tree : trees) {
    const std::string file = tree.filename().string();
    const std::string name = file.substr(0, file.size() - ending.size());
    const std::optional<fs::path> design = find_design(name);
    ASSERT_TRUE(design) << name;
    const bool is_equal = ask_lamina(*design).ast == read_file(tree.string());
    EXPECT_TRUE(is_equal) << name;
    std::printf("%-44s %s\n", name.c_str(), is_equal ? "passed" : "failed");
    if (is_equal) ++passed;
  }
  print_score("astdumptest", passed, trees.size());
}

TEST(Parser, AgreesWithOpenscadOnAllFilesThatComeWithIt) {
  for (const char* folder : {"examples", "libraries", "testdata"}) {
    const std::vector<fs::path> designs =
        find_files(fs::path(LAMINA_OPENSCAD_DATA) / folder, ".scad");
    ASSERT_FALSE(designs.empty()) << folder;
    expect_agreement(folder, designs);
  }
}

TEST(Parser, AgreesWithOpenscadOnRandomPrograms) {
  const TemporaryFolder folder;
  std::vector<fs::path> designs;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    designs.emplace_back(folder.write(fmt::format("r{}.scad", seed),
                                      RandomPrograms(seed).program(300)));
  }
  expect_agreement("random programs", designs);
}

TEST(Parser, AgreesWithOpenscadOnDamagedPrograms) {
  const TemporaryFolder folder;
  std::vector<fs::path> designs;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    RandomPrograms programs(seed);
    designs.emplace_back(folder.write(fmt::format("d{}.scad", seed),
                                      programs.damage(programs.program(6))));
  }
  expect_agreement("damaged programs", designs);
}

}  // namespace
}  // namespace lamina
