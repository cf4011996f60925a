// Against OpenSCAD's own test suite, as its package openscad-testing-data
// ships it, and against the installed openscad for libraries and examples.
//
// The suite's expectations are compared first; where a file has drifted from
// the program of the same distribution, that program decides. The counts stand
// in the output.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/csg/eval/evaluate_text.h"

namespace lamina::csg {
namespace {

namespace fs = std::filesystem;

const std::string kInstalled = LAMINA_OPENSCAD_DATA;

std::string ours(const fs::path& design, const std::string& kind) {
  const bool check_ranges =
      design.filename() == "builtin-invalid-range-test.scad";
  const Evaluated result = evaluate_file(design.string(), "", check_ranges);
  return normalized(kind == "echo" ? result.echo : result.csg);
}

std::string theirs(const fs::path& design, const std::string& kind) {
  const fs::path folder = fs::path(testing::TempDir());
  const fs::path output = folder / ("conformance." + kind);
  fs::remove(output);
  const std::string command = "openscad -o '" + output.string() + "' '" +
                              design.string() + "' >/dev/null 2>&1";
  if (std::system(command.c_str()) < 0) return "no openscad";
  return normalized(read_text(output.string()));
}

// All designs below a folder by their names without suffix.
std::multimap<std::string, fs::path> designs_below(const fs::path& folder) {
  std::multimap<std::string, fs::path> designs;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".scad") {
      designs.emplace(entry.path().stem().string(), entry.path());
    }
  }
  return designs;
}

struct Score {
  int passed = 0;
  std::vector<std::string> failed;
  std::vector<std::string> without_design;
};

Score run_suite(const std::string& suite, const std::string& kind,
                const fs::path& designs_folder) {
  const std::string ending = "-expected." + kind;
  const auto designs = designs_below(designs_folder);
  Score score;
  std::vector<fs::path> expectations;
  for (const auto& entry :
       fs::directory_iterator(kInstalled + "/regression/" + suite)) {
    expectations.push_back(entry.path());
  }
  std::sort(expectations.begin(), expectations.end());
  for (const fs::path& expectation : expectations) {
    const std::string file = expectation.filename().string();
    if (!file.ends_with(ending)) continue;
    const std::string name = file.substr(0, file.size() - ending.size());
    const auto [first, last] = designs.equal_range(name);
    if (first == last) {
      score.without_design.push_back(name);
      continue;
    }
    const std::string expected = normalized(read_text(expectation.string()));
    const bool has_passed = std::any_of(first, last, [&](const auto& design) {
      const std::string text = ours(design.second, kind);
      return text == expected || text == theirs(design.second, kind);
    });
    if (has_passed) {
      ++score.passed;
    } else {
      score.failed.push_back(name);
    }
  }
  std::cout << suite << ": " << score.passed << " passed, "
            << score.failed.size() << " failed, " << score.without_design.size()
            << " without a design in the package\n";
  return score;
}

TEST(Conformance, EchoesAsTheSuiteExpects) {
  const Score score =
      run_suite("echotest", "echo", kInstalled + "/testdata/scad");
  EXPECT_EQ(score.failed, std::vector<std::string>());
  EXPECT_GE(score.passed, 100);
}

TEST(Conformance, MakesTheCsgThatTheSuiteExpects) {
  const Score score =
      run_suite("dumptest", "csg", kInstalled + "/testdata/scad");
  EXPECT_EQ(score.failed, std::vector<std::string>());
  EXPECT_GE(score.passed, 110);
}

TEST(Conformance, MakesTheCsgOfTheExamples) {
  const Score score =
      run_suite("dumptest-examples", "csg", kInstalled + "/examples");
  EXPECT_EQ(score.failed, std::vector<std::string>());
  EXPECT_GE(score.passed, 48);
}

TEST(Conformance, AgreesWithOpenScadOnLibrariesAndExamples) {
  int passed = 0;
  for (const char* folder : {"/libraries/MCAD", "/examples"}) {
    for (const auto& [name, design] : designs_below(kInstalled + folder)) {
      for (const char* kind : {"echo", "csg"}) {
        EXPECT_EQ(ours(design, kind), theirs(design, kind)) << design;
        ++passed;
      }
    }
  }
  std::cout << "libraries and examples: " << passed << " outputs compared\n";
  EXPECT_GT(passed, 150);
}

}  // namespace
}  // namespace lamina::csg
