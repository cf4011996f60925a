// The same design and options give the same bytes: however many threads there
// are, whenever, wherever and in whatever surroundings the program runs. What
// runs of a debug build and of other compilers give is compared by
// scripts/check-determinism.

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::read_file;
using support::run_process;
using support::TemporaryFolder;

namespace fs = std::filesystem;

// Something of all that could let chance in: random numbers, a font, files,
// tables of names, each kind of solid that is built, and messages.
const std::string kDesign = R"(
use <parts/part.scad>
echo(rands(0, 1, 3), search("b", "abc"), 1.5, 1 / 3, version());
difference() {
  union() {
    for (at = rands(-8, 8, 12)) translate([at, -at, 0]) part(2 + at / 8);
    hull() { sphere(3, $fn = 17); translate([6, 2, 4]) cube(2); }
    minkowski() { cube([9, 2, 1]); cylinder(r = 0.7, h = 1, $fn = 9); }
    translate([-8, 5, 0]) linear_extrude(3) text("Qa1", size = 5);
    translate([0, 0, 2]) import("parts/tetrahedron.stl");
    translate([8, 0, 3]) rotate([80, 0, 20]) scale(0.4)
      import("parts/cylinder.step");
  }
  rotate([70, 10, 5]) cylinder(r = 1, h = 40, center = true, $fn = 31);
  nothing_known();
  projection() cube(1);
}
)";
const std::string kPart =
    "module part(r) rotate_extrude($fn = 13) translate([r, 1]) circle(1);\n";
const std::string kTetrahedron = R"(solid t
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 0 3.25 0
vertex 4.5 0 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 4.5 0 0
vertex 0 0 5.75
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex 0 0 5.75
vertex 0 3.25 0
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 4.5 0 0
vertex 0 3.25 0
vertex 0 0 5.75
endloop
endfacet
endsolid t
)";

void write_design(const fs::path& folder) {
  fs::create_directories(folder / "parts");
  const TemporaryFolder scratch;
  const auto put = [&](const std::string& name, const std::string& bytes) {
    fs::copy_file(scratch.write("file", bytes), folder / name,
                  fs::copy_options::overwrite_existing);
  };
  put("design.scad", kDesign);
  put("parts/part.scad", kPart);
  put("parts/tetrahedron.stl", kTetrahedron);
  fs::copy_file(LAMINA_SEEDS "/step/cylinder", folder / "parts/cylinder.step");
}

// One way to run the program.
struct Surroundings {
  std::string name;
  std::vector<std::string> before;   // words before the program's own
  std::vector<std::string> options;  // behind the design's
  std::string design = "design.scad";
  std::string start_in = ".";  // from the design's folder
};

// What the program writes in each format, and says on the terminal. A folder's
// files are joined.
using Results = std::map<std::string, std::string>;

std::string bytes_of(const fs::path& output) {
  if (!fs::is_directory(output)) return read_file(output.string());
  std::vector<fs::path> files(fs::directory_iterator(output),
                              fs::directory_iterator{});
  std::sort(files.begin(), files.end());
  std::string bytes;
  for (const fs::path& file : files) {
    bytes += file.filename().string() + '\n' + read_file(file.string());
  }
  return bytes;
}

const std::vector<std::vector<std::string>> kOutputs = {
    {"a.slc"},
    {"a.cli"},
    {"ascii.cli", "--cli", "ascii"},
    {"a.svg"},
    {"a.slices.3mf"},
    {"a.layers.json"},
    {"a.png/", "--layer", "1"},
    {"a.sl1", "--layer", "1"},
    {"a.zip", "--layer", "1"},
    {"paper.slc", "--contour", "paper"},
    {"adaptive.slc", "--adaptive", "0.1"},
    {"thinned.slc", "--compensate", "0.05", "--min-feature", "0.3"},
    {"a.csg"},
    {"a.ast"},
    {"a.echo"},
};

Results results_of(const fs::path& folder, const Surroundings& how) {
  Results results;
  for (const std::vector<std::string>& each : kOutputs) {
    const TemporaryFolder made;
    std::vector<std::string> words = how.before;
    words.insert(words.end(),
                 {LAMINA_PROGRAM, how.design, "-q", "-o", made.file(each[0])});
    words.insert(words.end(), each.begin() + 1, each.end());
    words.insert(words.end(), how.options.begin(), how.options.end());
    const auto run =
        run_process(words, (folder / how.start_in).lexically_normal());
    EXPECT_EQ(run.status, 0)
        << how.name << ", " << each[0] << ": " << run.errors;
    if (run.status == 0) results[each[0]] = bytes_of(made.file(each[0]));
  }
  return results;
}

void expect_same(const Results& results, const Results& expected,
                 const std::string& name) {
  ASSERT_EQ(results.size(), expected.size()) << name;
  for (const auto& [output, bytes] : results) {
    EXPECT_GT(bytes.size(), 0U) << output;
    EXPECT_TRUE(bytes == expected.at(output)) << output << ", " << name;
  }
}

class Determinism : public testing::Test {
 protected:
  Determinism() { write_design(folder_.path()); }

  void expect_same_in(const std::vector<Surroundings>& all) const {
    const Results expected =
        results_of(folder_.path(), {"plainly", {}, {"--threads", "1"}});
    for (const Surroundings& how : all) {
      expect_same(results_of(folder_.path(), how), expected, how.name);
    }
  }

  const TemporaryFolder folder_;
};

TEST_F(Determinism, AnyNumberOfThreadsGivesTheSameBytes) {
  std::vector<Surroundings> all;
  for (const std::string threads : {"2", "3", "7", "16"}) {
    all.push_back({threads + " threads", {}, {"--threads", threads}});
  }
  expect_same_in(all);
}

// Memory lies elsewhere in each run: at random places, at the same ones, and
// behind an environment of another length.
TEST_F(Determinism, PlacesInMemoryDoNotMatter) {
  expect_same_in(
      {{"again", {}, {}},
       {"fixed places", {"setarch", "-R"}, {}},
       {"long environment", {"env", "LONG=" + std::string(5000, 'x')}, {}}});
}

TEST_F(Determinism, LanguageTimeZoneAndUserDoNotMatter) {
  const TemporaryFolder locales;
  const auto made = run_process(
      {"localedef", "-i", "de_DE", "-f", "UTF-8", locales.file("de_DE.UTF-8")});
  ASSERT_EQ(made.status, 0) << made.errors;  // Debian's package locales
  expect_same_in({{"commas as decimal points",
                   {"env", "LOCPATH=" + locales.path(), "LC_ALL=de_DE.UTF-8",
                    "LANG=de_DE.UTF-8"},
                   {}},
                  {"another time zone", {"env", "TZ=Pacific/Kiritimati"}, {}},
                  {"nobody's", {"env", "-i"}, {}}});
}

// Messages name files as the user does, so they are not compared here.
TEST_F(Determinism, FoldersAndSpellingsDoNotMatter) {
  const std::string elsewhere = "another folder/ünder it";
  write_design(fs::path(folder_.path()) / elsewhere);
  expect_same_in({{"a dot", {}, {}, "./design.scad"},
                  {"its whole name", {}, {}, folder_.file("design.scad")},
                  {"from below", {}, {}, "../design.scad", "parts"},
                  {"from above", {}, {}, elsewhere + "/design.scad"},
                  {"elsewhere", {}, {}, "design.scad", elsewhere}});
}

}  // namespace
}  // namespace lamina::cli
