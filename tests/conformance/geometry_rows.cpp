#include "tests/conformance/geometry_rows.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

fs::path path_of(const fs::path& folder, std::string design) {
  std::replace(design.begin(), design.end(), '/', ':');
  return folder / design;
}

}  // namespace

std::vector<std::string> geometry_designs(const fs::path& data) {
  std::vector<std::string> designs;
  for (const char* folder :
       {"examples", "testdata/scad/2D", "testdata/scad/3D", "testdata/scad/svg",
        "testdata/scad/dxf", "testdata/scad/stl", "testdata/scad/amf",
        "testdata/scad/3mf"}) {
    for (const auto& entry : fs::recursive_directory_iterator(data / folder)) {
      if (entry.path().extension() != ".scad") continue;
      designs.push_back(entry.path().lexically_relative(data).string());
    }
  }
  std::sort(designs.begin(), designs.end());
  return designs;
}

void write_row(const fs::path& folder, const GeometryRow& row) {
  fs::create_directories(folder);
  std::ofstream(path_of(folder, row.design)) << row.verdict << '\n'
                                             << row.complaint;
}

std::vector<GeometryRow> read_rows(const fs::path& folder,
                                   const std::vector<std::string>& designs) {
  std::vector<GeometryRow> rows;
  for (const std::string& design : designs) {
    std::ifstream file(path_of(folder, design));
    if (!file) continue;
    GeometryRow row{design, "", ""};
    std::getline(file, row.verdict);
    row.complaint = {std::istreambuf_iterator<char>(file), {}};
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lamina::conformance
