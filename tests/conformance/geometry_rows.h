#pragma once
// The designs whose geometry is compared. The case of each leaves its outcome
// in a file, for the table.

#include <filesystem>
#include <string>
#include <vector>

namespace lamina::conformance {

// The designs of OpenSCAD's test data and examples, as paths below `data`.
std::vector<std::string> geometry_designs(const std::filesystem::path& data);

struct GeometryRow {
  std::string design;
  std::string verdict;    // equal, empty, no-judge, differs
  std::string complaint;  // where it is neither equal nor empty
};

void write_row(const std::filesystem::path& folder, const GeometryRow& row);

// The rows there are, by design.
std::vector<GeometryRow> read_rows(const std::filesystem::path& folder,
                                   const std::vector<std::string>& designs);

}  // namespace lamina::conformance
