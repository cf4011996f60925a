// The map of docs/design.md, held against the sources: which folder includes
// which, where packages have their homes, and that detail/ stays private.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;    // relative to the project, "csg/tree.h"
  std::string target;  // as written, "base/vec.h" or "fmt/format.h"
  bool is_quoted = false;
};

using lamina::testing::kRoot;

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

// All includes of C++ files below `folders`.
std::vector<Include> includes_below(const std::vector<std::string>& folders) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream text(entry.path());
      std::string line;
      std::smatch match;
      while (std::getline(text, line)) {
        if (!std::regex_search(line, match, pattern)) continue;
        includes.push_back({fs::relative(entry.path(), kRoot).string(),
                            match[2].str(), match[1].str() == "\""});
      }
    }
  }
  return includes;
}

// The top folders, each before those that may include it.
const std::vector<std::string> kProduct = {
    "base",   "plane",    "parser", "csg", "ldni",
    "slicer", "compiler", "serve",  "api", "cli"};

// The rooms, each before those that may include it. A room is a folder with the
// `detail/` in it.
const std::vector<std::string> kRooms = {"base",
                                         "base/file",
                                         "plane",
                                         "plane/program",
                                         "plane/order",
                                         "plane/sweep",
                                         "plane/cascade",
                                         "plane/region",
                                         "parser",
                                         "parser/customizer",
                                         "csg",
                                         "csg/mesh",
                                         "csg/import",
                                         "csg/import/freecad",
                                         "csg/eval/value",
                                         "csg/eval/code",
                                         "csg/eval/run",
                                         "csg/eval/builtin",
                                         "csg/eval/resolve",
                                         "csg/eval",
                                         "csg/text",
                                         "csg/cad",
                                         "csg/boundary",
                                         "csg/minkowski",
                                         "csg/roof",
                                         "csg/lower",
                                         "ldni/section",
                                         "ldni/gl",
                                         "ldni/image",
                                         "slicer/contour",
                                         "slicer/plan",
                                         "slicer/machine",
                                         "slicer/check/thin",
                                         "slicer/thickness",
                                         "slicer/casting",
                                         "slicer/check/print",
                                         "slicer/supports",
                                         "slicer/plate",
                                         "slicer/check/compare",
                                         "slicer/check/defects",
                                         "slicer/pixels",
                                         "slicer/formats",
                                         "slicer/picture",
                                         "slicer/slice",
                                         "slicer/hollow",
                                         "slicer/bleed",
                                         "slicer/dump",
                                         "compiler",
                                         "api/lamina",
                                         "compiler/tasks",
                                         "api",
                                         "api/python",
                                         "serve/http",
                                         "serve/run",
                                         "serve/shop",
                                         "serve/studio",
                                         "cli/process",
                                         "cli/options",
                                         "cli/report",
                                         "cli/pieces",
                                         "cli/commands",
                                         "cli/pages",
                                         "cli"};

std::string room_of(const std::string& path) {
  fs::path folder = fs::path(path).parent_path();
  if (folder.filename() == "detail") folder = folder.parent_path();
  return folder.string();
}

std::string top_folder_of(const std::string& path) {
  return path.substr(0, path.find('/'));
}

std::size_t place_of(const std::string& room) {
  return static_cast<std::size_t>(
      std::find(kRooms.begin(), kRooms.end(), room) - kRooms.begin());
}

using Arrows = std::map<std::string, std::set<std::string>>;

// What each part of the product includes of the others, where `part_of` says to
// which part a file belongs.
Arrows arrows(std::string (*part_of)(const std::string& path)) {
  Arrows arrows;
  for (const Include& include : includes_below(kProduct)) {
    if (!include.is_quoted || room_of(include.target).empty()) continue;
    const std::string to = part_of(include.target);
    const std::string from = part_of(include.file);
    if (to != from) arrows[from].insert(to);
  }
  return arrows;
}

std::string table_of(const std::string& head, const Arrows& arrows,
                     const std::vector<std::string>& parts) {
  std::string table = "| " + head + " | includes |\n|---|---|\n";
  for (const std::string& part : parts) {
    table += "| `" + part + "` |";
    std::string mark = " ";
    for (const std::string& other : parts) {
      if (!arrows.contains(part) || !arrows.at(part).contains(other)) continue;
      table += mark;
      table += other;
      mark = ", ";
    }
    table += " |\n";
  }
  return table;
}

TEST(Includes, FollowTheArrowsOfTheMap) {
  for (const Include& include : includes_below(kProduct)) {
    if (!include.is_quoted) continue;
    const std::string from = room_of(include.file);
    const std::string to = room_of(include.target);
    ASSERT_LT(place_of(from), kRooms.size())
        << include.file << " stands in a room that is on no map";
    if (to.empty()) {
      // Bison and Flex write the parser's own headers.
      EXPECT_EQ(from, "parser")
          << include.file << " includes " << include.target
          << ": write paths from the project's root";
      continue;
    }
    EXPECT_LE(place_of(to), place_of(from))
        << include.file << " includes " << include.target << ": " << from
        << " must not know " << to;
  }
}

TEST(Includes, DetailIsPrivateToItsRoom) {
  for (const Include& include : includes_below(kProduct)) {
    if (include.target.find("/detail/") == std::string::npos) continue;
    EXPECT_EQ(room_of(include.file), room_of(include.target))
        << include.file << " includes " << include.target;
  }
}

TEST(Includes, TopFoldersFormNoCircle) {
  for (const auto& [from, targets] : arrows(top_folder_of)) {
    for (const std::string& to : targets) {
      EXPECT_LT(std::find(kProduct.begin(), kProduct.end(), to),
                std::find(kProduct.begin(), kProduct.end(), from))
          << from << "/ must not know " << to << "/";
    }
  }
}

// docs/design.md shows the arrows as this test finds them. Where they have
// changed, the table that the test prints goes there.
TEST(Includes, AreTheTablesOfTheDesign) {
  std::ifstream file(kRoot / "docs" / "design.md");
  const std::string design((std::istreambuf_iterator<char>(file)),
                           std::istreambuf_iterator<char>());
  for (const std::string& table :
       {table_of("folder", arrows(top_folder_of), kProduct),
        table_of("room", arrows(room_of), kRooms)}) {
    EXPECT_NE(design.find(table), std::string::npos)
        << "docs/design.md should have this table:\n"
        << table;
  }
}

// More than that nobody reads as a list. Profiles of machines are data.
TEST(Rooms, HoldAtMostThirtyFiles) {
  for (const std::string& stage : kProduct) {
    std::map<std::string, int> counts;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / stage)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".cpp" || extension == ".h" || extension == ".js") {
        ++counts[entry.path().parent_path()];
      }
    }
    for (const auto& [folder, count] : counts) {
      EXPECT_LE(count, 30) << folder;
    }
  }
}

TEST(Includes, PackagesKeepToTheirHomes) {
  struct Home {
    std::string package;              // prefix of the include
    std::vector<std::string> places;  // prefixes of files that may use it
  };
  const std::vector<Home> homes = {
      {"polyclipping/", {}},
      {"GL/", {"ldni/gl/gl_platforms.cpp", "ldni/gl/detail/gl_functions.h"}},
      {"EGL/", {"ldni/gl/gl_platforms.cpp"}},
      {"CGAL/", {}},
      {"gtest/", {}},
      {"tbb/", {"base/parallel", "slicer/slice/"}},
      {"oneapi/tbb", {"base/parallel", "slicer/slice/"}},
      {"png", {"base/file/", "slicer/picture/"}},
      {"pugixml",
       {"base/file/", "csg/import/", "slicer/dump/", "slicer/formats/"}},
      {"minizip/", {"base/file/"}},
      {"CLI/", {"cli/options/option_list.cpp"}},
      {"fontconfig/", {"csg/text/"}},
      {"ft2build.h", {"csg/text/"}},
      {"hb", {"csg/text/"}},
      {"OpenMesh/", {"csg/import/decimate_module.cpp"}},
      {"boost/", {"serve/http/beast_server.cpp"}},
      {"nanoflann", {"slicer/thickness/ball_finder.cpp"}},
      {"pybind11/", {"api/python/"}},
  };
  for (const Include& include : includes_below(kProduct)) {
    for (const Home& home : homes) {
      if (!starts_with(include.target, home.package)) continue;
      const bool is_at_home =
          std::any_of(home.places.begin(), home.places.end(),
                      [&](const std::string& place) {
                        return starts_with(include.file, place);
                      });
      EXPECT_TRUE(is_at_home) << include.file << " includes " << include.target;
    }
  }
}

TEST(Includes, OpenCascadeStaysInItsModule) {
  for (const Include& include : includes_below(kProduct)) {
    if (!include.target.ends_with(".hxx")) continue;
    EXPECT_TRUE(starts_with(include.file, "csg/cad/"))
        << include.file << " includes " << include.target;
  }
}

TEST(Includes, CgalStaysInTheOracle) {
  for (const Include& include : includes_below({"tests", "bench"})) {
    if (!starts_with(include.target, "CGAL/")) continue;
    EXPECT_TRUE(starts_with(include.file, "tests/oracle/") ||
                starts_with(include.file, "bench/"))
        << include.file << " includes " << include.target;
  }
}

TEST(TopLevel, HoldsWhatTheMapNames) {
  const std::vector<std::string> known = {"CMakeLists.txt",
                                          "base",
                                          "plane",
                                          "compiler",
                                          "serve",
                                          "parser",
                                          "csg",
                                          "csg/mesh",
                                          "ldni",
                                          "slicer",
                                          "tests",
                                          "examples",
                                          "grammar",
                                          "README.md",
                                          "cli",
                                          "bench",
                                          "scripts",
                                          "docs",
                                          "cmake",
                                          "LICENSE",
                                          "CMakePresets.json",
                                          "CHANGELOG.md",
                                          "CONTRIBUTING.md",
                                          "CONTRIBUTING.md",
                                          "SECURITY.md",
                                          "build",
                                          "api"};
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    if (name.front() == '.') continue;
    // What the README's first commands write.
    const fs::path extension = entry.path().extension();
    if (extension == ".slc" || extension == ".html") continue;
    EXPECT_NE(std::find(known.begin(), known.end(), name), known.end())
        << name << " stands at the top level and on no map";
  }
}

}  // namespace
