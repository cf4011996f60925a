// Prints the rows that the oracle tests left as one Markdown table, and fails
// where a scene has none or its row is no pass.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace {

namespace fs = std::filesystem;

struct Row {
  int heights = 0;
  int regions = 0;
  int holes = 0;
  std::string distance = "-";
  std::string allowed = "-";
  int settled = 0;
  std::string verdict = "missing";
};

Row read_row(const fs::path& path) {
  Row row;
  std::ifstream(path) >> row.heights >> row.regions >> row.holes >>
      row.distance >> row.allowed >> row.settled >> row.verdict;
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: oracle_table <scenes> <rows> <table.md>\n";
    return 2;
  }
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(argv[1])) {
    if (entry.path().extension() == ".scad") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());

  // Distances are symmetric differences over perimeters, the largest of all
  // heights and pitches; regions and holes are summed over the heights.
  std::string table =
      "| scene | heights | regions | holes | from exact sections, mm | allowed "
      "| verdict | from openscad, mm | allowed | verdict "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  bool passed = true;
  for (const std::string& name : names) {
    const Row exact = read_row(fs::path(argv[2]) / (name + ".exact"));
    const Row openscad = read_row(fs::path(argv[2]) / (name + ".openscad"));
    table +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
                    name, exact.heights, exact.regions, exact.holes,
                    exact.distance, exact.allowed, exact.verdict,
                    openscad.distance, openscad.allowed, openscad.verdict);
    passed = passed && exact.verdict == "equal" && openscad.verdict == "equal";
  }
  std::ofstream(argv[3]) << table;
  std::cout << table;
  return passed ? 0 : 1;
}
