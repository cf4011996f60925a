// Prints the rows that geometry_test left as one Markdown table, a line for
// each folder, and below it every design that is no plain "equal".

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace {

namespace fs = std::filesystem;

struct Row {
  std::string name;
  std::string verdict;
  double distance = 0;
  bool is_exception = false;
  std::string complaint;
};

struct Tally {
  int designs = 0;
  std::map<std::string, int> verdicts;
  int exceptions = 0;
  double distance = 0;
};

std::vector<Row> read_rows(const fs::path& folder) {
  std::vector<Row> rows;
  for (const auto& entry : fs::directory_iterator(folder)) {
    Row row;
    row.name = entry.path().filename().string();
    std::replace(row.name.begin(), row.name.end(), ':', '/');
    std::ifstream file(entry.path());
    std::string exception;
    file >> row.verdict >> row.distance >> exception;
    row.is_exception = exception == "true";
    file.ignore();
    std::getline(file, row.complaint);
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.name < b.name; });
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: geometry_table <rows> <table.md>\n";
    return 2;
  }
  const std::vector<Row> rows = read_rows(argv[1]);
  std::map<std::string, Tally> folders;
  std::string list;
  for (const Row& row : rows) {
    Tally& tally = folders[fs::path(row.name).parent_path().string()];
    ++tally.designs;
    ++tally.verdicts[row.verdict];
    tally.exceptions += row.is_exception ? 1 : 0;
    if (row.verdict == "equal") {
      tally.distance = std::max(tally.distance, row.distance);
    } else if (row.verdict != "empty") {
      list +=
          fmt::format("- {} {}: {}\n", row.verdict, row.name, row.complaint);
    }
  }
  std::string table =
      "| folder | designs | equal | greatest difference / perimeter, mm | both "
      "empty | openscad's mesh is no judge | openscad fails | openscad over "
      "the limit | differ | of these, exceptions "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (auto& [folder, tally] : folders) {
    auto& v = tally.verdicts;
    table += fmt::format(
        "| {} | {} | {} | {:.1e} | {} | {} | {} | {} | {} | {} |\n", folder,
        tally.designs, v["equal"], tally.distance, v["empty"], v["no-judge"],
        v["failed"], v["slow"], v["differs"], tally.exceptions);
  }
  std::ofstream(argv[2]) << table << '\n' << list;
  std::cout << table << '\n' << list;
  return 0;
}
