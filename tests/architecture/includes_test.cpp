// The map of docs/design.md, held against the sources: which folder includes
// which, where packages have their homes, and that detail/ stays private.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;    // relative to the project, "ldni/ray.cpp"
  std::string target;  // as written, "base/vec.h" or "fmt/format.h"
  bool is_quoted = false;
};

const fs::path kRoot = LAMINA_SOURCE_DIR;

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

const std::vector<std::string> kProduct = {"parser", "csg", "ldni",
                                           "slicer", "api", "cli"};

// The library that a path belongs to: "csg/solid", "csg", "ldni", …
std::string library_of(const std::string& path) {
  static const std::vector<std::string> libraries = {
      "csg/eval", "csg/planar", "csg/solid", "csg/text", "csg/import", "csg",
      "parser",   "ldni",       "slicer",    "cli",      "api"};
  for (const std::string& library : libraries) {
    if (starts_with(path, library + "/")) return library;
  }
  return "";
}

TEST(Includes, FollowTheArrowsOfTheMap) {
  const std::vector<std::string> geometry = {"parser", "csg"};
  std::map<std::string, std::vector<std::string>> allowed;
  allowed["parser"] = {};
  allowed["csg"] = {"parser"};
  // dxf_dim() and dxf_cross() measure what import() draws.
  allowed["csg/eval"] = {"parser", "csg", "csg/import"};
  allowed["csg/text"] = geometry;
  allowed["csg/import"] = geometry;
  allowed["csg/planar"] = {"parser", "csg", "csg/import", "csg/text"};
  allowed["csg/solid"] = {"parser", "csg", "csg/import", "csg/text",
                          "csg/planar"};
  allowed["ldni"] = {"parser", "csg", "csg/solid"};
  allowed["slicer"] = {"parser",     "csg",       "csg/import",
                       "csg/planar", "csg/solid", "ldni"};
  allowed["cli"] = {"parser",     "csg",       "csg/eval",
                    "csg/planar", "csg/solid", "csg/import",
                    "csg/text",   "ldni",      "slicer"};
  allowed["api"] = {"parser",    "csg",      "csg/eval", "csg/planar",
                    "csg/solid", "csg/text", "ldni",     "slicer"};
  for (const Include& include : includes_below(kProduct)) {
    if (!include.is_quoted) continue;
    const std::string from = library_of(include.file);
    const std::string to = library_of(include.target);
    ASSERT_NE(from, "") << include.file;
    if (to == from) continue;
    if (to == "") {
      // What Bison and Flex make of grammar/ is the parser's own.
      EXPECT_EQ(from, "parser")
          << include.file << " includes " << include.target
          << ": write paths from the project's root";
      continue;
    }
    const auto& targets = allowed.at(from);
    EXPECT_NE(std::find(targets.begin(), targets.end(), to), targets.end())
        << include.file << " includes " << include.target << ": " << from
        << " must not know " << to;
  }
}

TEST(Includes, DetailIsPrivateToItsLibrary) {
  for (const Include& include : includes_below(kProduct)) {
    if (include.target.find("/detail/") == std::string::npos) continue;
    EXPECT_EQ(library_of(include.file), library_of(include.target))
        << include.file << " includes " << include.target;
  }
}

TEST(Includes, PackagesKeepToTheirHomes) {
  struct Home {
    std::string package;              // prefix of the include
    std::vector<std::string> places;  // prefixes of files that may use it
  };
  const std::vector<Home> homes = {
      {"polyclipping/", {"csg/planar/"}},
      {"clipper.hpp", {"csg/planar/"}},
      {"libqhull", {"csg/solid/"}},
      {"GL/", {"ldni/gl/gl_platforms.cpp", "ldni/gl/detail/gl_functions.h"}},
      {"EGL/", {"ldni/gl/gl_platforms.cpp"}},
      {"CGAL/", {}},
      {"gtest/", {}},
      {"tbb/", {"slicer/"}},
      {"oneapi/tbb", {"slicer/"}},
      {"png", {"slicer/", "csg/import/"}},
      {"pugixml", {"csg/import/", "slicer/formats/"}},
      {"minizip/", {"csg/import/", "slicer/formats/"}},
      {"CLI/", {"cli/"}},
      {"fontconfig/", {"csg/text/"}},
      {"ft2build.h", {"csg/text/"}},
      {"hb", {"csg/text/"}},
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

TEST(Includes, CgalStaysInTheOracle) {
  for (const Include& include : includes_below({"tests", "bench"})) {
    if (!starts_with(include.target, "CGAL/")) continue;
    EXPECT_TRUE(starts_with(include.file, "tests/oracle/") ||
                starts_with(include.file, "bench/"))
        << include.file << " includes " << include.target;
  }
}

TEST(TopLevel, HoldsWhatTheMapNames) {
  const std::vector<std::string> known = {
      "CMakeLists.txt", "parser", "csg",      "ldni",
      "slicer",         "tests",  "examples", "grammar",
      "README.md",      "cli",    "bench",    "scripts",
      "docs",           "cmake",  "LICENSE",  "CMakePresets.json",
      "CHANGELOG.md",   "build",  "api"};
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
