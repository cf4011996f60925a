// Conformance with OpenSCAD 2021.01: compares what lamina writes for every text
// test of OpenSCAD's suite, and for every design that comes with OpenSCAD, with
// the suite's expected files and the installed program.
//
// Where an expected file has drifted from the program of its own distribution,
// that program decides. docs/conformance.md holds the table that this test
// makes, and the cases that may fail, each with its reason: a failure that is
// not on that page fails the test, and so does a line there that is not true
// any more.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/conformance/page.h"
#include "tests/conformance/programs.h"
#include "tests/conformance/suite.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

enum class Verdict { kPassed, kDrifted, kFailed };

// kDrifted: as the installed program writes it, not as the suite expects.
Verdict judge(const Case& one) {
  const std::string ours = normalized(run_lamina(one));
  if (!one.expectation.empty() &&
      ours == normalized(support::read_file(one.expectation.string()))) {
    return Verdict::kPassed;
  }
  if (ours != normalized(run_openscad(one))) return Verdict::kFailed;
  return one.expectation.empty() ? Verdict::kPassed : Verdict::kDrifted;
}

std::vector<Verdict> judge_all(const std::vector<Case>& cases) {
  std::vector<Verdict> verdicts(cases.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < cases.size(); i = next++) {
      verdicts[i] = judge(cases[i]);
    }
  };
  std::vector<std::future<void>> workers;
  const unsigned count = std::max(1U, std::thread::hardware_concurrency());
  for (unsigned i = 0; i < count; ++i) {
    workers.push_back(std::async(std::launch::async, work));
  }
  for (std::future<void>& worker : workers) worker.get();
  return verdicts;
}

struct Row {
  std::string category;
  int passed = 0;
  int drifted = 0;
  int failed = 0;
};

std::string line_of(const Row& row) {
  return fmt::format("| {} | {} | {} | {} |", row.category, row.passed,
                     row.drifted, row.failed);
}

std::vector<Row> count(const std::vector<Case>& cases,
                       const std::vector<Verdict>& verdicts) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (rows.empty() || rows.back().category != cases[i].category) {
      rows.push_back({cases[i].category});
    }
    Row& row = rows.back();
    ++(verdicts[i] == Verdict::kPassed    ? row.passed
       : verdicts[i] == Verdict::kDrifted ? row.drifted
                                          : row.failed);
  }
  return rows;
}

TEST(Conformance, IsWhatItsPageSays) {
  const Suite suite = collect_suite(LAMINA_OPENSCAD_DATA);
  const std::vector<Verdict> verdicts = judge_all(suite.cases);

  std::string table = "| category | passed | passed, drifted | failed |\n";
  table += "|---|---|---|---|\n";
  for (const Row& row : count(suite.cases, verdicts)) {
    table += line_of(row) + "\n";
    EXPECT_TRUE(page_has_line(line_of(row)))
        << "docs/conformance.md lacks: " << line_of(row);
  }
  std::printf("%s%zu expected files without a design\n", table.c_str(),
              suite.without_design.size());
  std::ofstream(LAMINA_LANGUAGE_TABLE) << table;

  for (std::size_t i = 0; i < suite.cases.size(); ++i) {
    const std::string name = suite.cases[i].name();
    const bool has_failed = verdicts[i] == Verdict::kFailed;
    EXPECT_EQ(has_failed, is_exception(name))
        << name << (has_failed ? " fails" : " is listed but passes");
    if (verdicts[i] != Verdict::kDrifted) continue;
    EXPECT_TRUE(page_names(name)) << name << " has drifted and is not listed";
  }
}

TEST(Conformance, CountsWhatThePackageShips) {
  const Suite suite = collect_suite(LAMINA_OPENSCAD_DATA);
  EXPECT_GE(suite.cases.size(), 1500U);
  EXPECT_LE(suite.without_design.size(), 40U);
}

}  // namespace
}  // namespace lamina::conformance
