// Makes a table of the rows that geometry_test left, a line for each folder,
// and expects docs/conformance.md to hold it. Below the table stands every
// design that is neither equal nor empty in both programs.

#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/conformance/geometry_rows.h"
#include "tests/conformance/page.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

using Tally = std::map<std::string, int>;  // designs of each verdict

std::string line_of(const std::string& folder, Tally tally) {
  return fmt::format("| {} | {} | {} | {} | {} |", folder, tally["equal"],
                     tally["empty"], tally["no-judge"], tally["differs"]);
}

TEST(GeometryTable, IsWhatItsPageSays) {
  const std::vector<std::string> designs =
      geometry_designs(LAMINA_OPENSCAD_DATA);
  const std::vector<GeometryRow> rows =
      read_rows(LAMINA_GEOMETRY_ROWS, designs);
  std::map<std::string, Tally> folders;
  std::string list;
  for (const GeometryRow& row : rows) {
    ++folders[fs::path(row.design).parent_path().string()][row.verdict];
    if (row.verdict == "equal" || row.verdict == "empty") continue;
    list +=
        fmt::format("- {} {}: {}\n", row.verdict, row.design, row.complaint);
  }
  std::string table =
      "| folder | equal | both empty | openscad's mesh is no judge | differ |\n"
      "|---|---|---|---|---|\n";
  for (const auto& [folder, tally] : folders) {
    table += line_of(folder, tally) + '\n';
  }
  std::printf("%s\n%s", table.c_str(), list.c_str());
  std::ofstream(LAMINA_GEOMETRY_TABLE) << table << '\n' << list;

  ASSERT_EQ(rows.size(), designs.size())
      << "designs have no row: geometry_test has not judged them";
  for (const auto& [folder, tally] : folders) {
    EXPECT_TRUE(page_has_line(line_of(folder, tally)))
        << "docs/conformance.md lacks: " << line_of(folder, tally);
  }
}

}  // namespace
}  // namespace lamina::conformance
