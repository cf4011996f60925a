// lamina compare, as a user runs it: files of one design in all formats, wrong
// designs, shifted parts, broken files.

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
using support::ProcessResult;
using support::TemporaryFolder;

// A ring with a bore through its head; faces between the layers' sections.
constexpr const char* kRing = R"(
  size = 8;
  difference() {
    union() {
      cylinder(r = size, h = 3.01, $fn = 60);
      translate([size - 1, 0, 1.505]) rotate([0, 90, 0])
        cylinder(r = 1.4, h = 3, $fn = 30);
    }
    translate([0, 0, -1]) cylinder(r = size - 1.5, h = 6, $fn = 60);
    translate([0, 0, 1.505]) rotate([0, 90, 0]) cylinder(r = 0.5, h = 20, $fn = 20);
  }
)";

class Compare : public ::testing::Test {
 protected:
  ProcessResult compare(std::vector<std::string> words) const {
    words.insert(words.begin(), "compare");
    return run(folder, std::move(words));
  }
  void slice(const std::string& output,
             std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"ring.scad", "-q", "-o", output});
    ASSERT_EQ(run(folder, std::move(options)).status, 0) << output;
  }
  nlohmann::json report() const {
    return nlohmann::json::parse(support::read_file(folder.file("r.json")));
  }

  TemporaryFolder folder;
  const std::string design = folder.write("ring.scad", kRing);
};

TEST_F(Compare, AFileEqualsItselfToTheLastDigit) {
  slice("ring.slc");
  const ProcessResult result =
      compare({"ring.slc", "ring.slc", "--tolerance", "0"});
  EXPECT_EQ(result.status, 0) << result.output << result.errors;
  EXPECT_TRUE(has(result.output, "distance  none"));
  EXPECT_TRUE(has(result.output, "equal     within 0 mm in all 60 layers"))
      << result.output;
}

TEST_F(Compare, AllFormatsHoldTheSameLayers) {
  const std::vector<std::string> files = {
      "ring.slc", "ring.cli",        "ascii.cli",
      "ring.svg", "ring.slices.3mf", "ring.layers.json"};
  for (const std::string& file : files) {
    slice(file, file == "ascii.cli" ? std::vector<std::string>{"--cli", "ascii"}
                                    : std::vector<std::string>{});
  }
  for (const std::string& a : files) {
    for (const std::string& b : files) {
      // float32 has steps of 1e-6 at 10 mm.
      const ProcessResult result = compare({a, b, "--tolerance", "1e-6"});
      EXPECT_EQ(result.status, 0) << a << ' ' << b << '\n'
                                  << result.output << result.errors;
    }
  }
}

TEST_F(Compare, ADesignEqualsItsFilesWithinWhatTheyStateEitherWayRound) {
  slice("ring.slc");
  slice("exact.layers.json", {"--tolerance", "0"});
  EXPECT_EQ(compare({"ring.scad", "ring.slc"}).status, 0);
  EXPECT_EQ(compare({"ring.slc", "ring.scad"}).status, 0);
  EXPECT_EQ(
      compare({"exact.layers.json", "ring.scad", "--tolerance", "1e-9"}).status,
      0);
}

TEST_F(Compare, ShowsWhatSimplificationDid) {
  folder.write("round.scad", "cylinder(r = 5, h = 0.5, $fn = 700);");
  ASSERT_EQ(run(folder, {"round.scad", "-q", "-o", "round.slc"}).status, 0);
  EXPECT_EQ(compare({"round.slc", "round.scad"}).status, 0);
  EXPECT_EQ(compare({"round.slc", "round.scad", "--tolerance", "5e-4",
                     "--report", "r.json"})
                .status,
            1);
  const nlohmann::json shown = report();
  for (const auto& layer : shown["layers"]) {
    EXPECT_GT(layer["distance"], 5e-4);
    EXPECT_LE(layer["distance"], 0.001002);
  }
}

TEST_F(Compare, AnotherDesignDiffersByAsMuchAsItIsLarger) {
  slice("ring.slc");
  const ProcessResult result = compare(
      {"ring.slc", "ring.scad", "-D", "size=8.25", "--report", "r.json"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.output, "different in 60 of 60 layers"))
      << result.output;
  const nlohmann::json shown = report();
  EXPECT_EQ(shown["equal"], false);
  EXPECT_EQ(shown["layers_outside"], 60);
  // Of a ring alone; the chord's middle is cos(3°) as far out.
  const auto& first = shown["layers"][0];
  EXPECT_NEAR(first["distance"], 0.25, 0.002);
  // (r + 0.25)² - r² of polygons of 60 corners, outside less inside.
  const double share = 60 * std::sin(2 * std::numbers::pi / 60) / 2;
  EXPECT_NEAR(first["only_b"], share * (8.25 * 8.25 - 64), 0.01);
  EXPECT_NEAR(first["only_a"], share * (6.75 * 6.75 - 6.5 * 6.5), 0.01);
}

TEST_F(Compare, AFileThatEndsEarlyDiffers) {
  slice("ring.slc");
  folder.write("taller.scad", "size = 8;\n" + std::string(kRing) +
                                  "translate([0, 0, 3]) cube([1, 1, 0.2]);");
  const ProcessResult result = compare({"ring.slc", "taller.scad", "--all"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.output, "missing")) << result.output;
}

TEST_F(Compare, TellsTheShiftThatWouldMakeThemEqual) {
  slice("ring.slc");
  folder.write("moved.scad",
               "translate([3, -2, 1.5]) union() {" + std::string(kRing) + "}");
  const ProcessResult result = compare({"ring.slc", "moved.scad"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.output, "--align")) << result.output;
  const ProcessResult aligned =
      compare({"ring.slc", "moved.scad", "--align", "--report", "r.json"});
  EXPECT_EQ(aligned.status, 0) << aligned.output;
  EXPECT_NEAR(report()["shift"][0], -3, 1e-3);
  EXPECT_NEAR(report()["shift"][2], -1.5, 1e-5);
}

TEST_F(Compare, RefusesFilesOfOtherHeights) {
  slice("ring.slc");
  slice("thick.slc", {"--layer", "0.1"});
  const ProcessResult result = compare({"ring.slc", "thick.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.output, "");
  EXPECT_TRUE(has(result.errors, "layers of different heights"))
      << result.errors;
  // The design has all heights.
  EXPECT_EQ(compare({"thick.slc", "ring.scad"}).status, 0);
}

TEST_F(Compare, LayersAtChosenHeightsAreComparedThere) {
  for (const char* file : {"h.slc", "h.cli", "h.svg", "h.layers.json"}) {
    slice(file, {"--heights", "0.5,1.505,2.9"});
    EXPECT_EQ(compare({file, "ring.scad"}).status, 0) << file;
  }
}

TEST_F(Compare, AFaceInTheSectionsPlaneIsNoDifference) {
  // 0.725 becomes 0.72500002 in an SLC file's float32 numbers.
  folder.write("step.scad",
               "cube([8, 8, 1]); translate([0, 0, 0.725]) cube([5, 12, 1]);");
  ASSERT_EQ(run(folder, {"step.scad", "-q", "-o", "step.slc"}).status, 0);
  const ProcessResult result = compare({"step.slc", "step.scad", "--all"});
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_TRUE(has(result.output, "lie in a horizontal face"));
}

TEST_F(Compare, MeshesAreCut) {
  // A tetrahedron, once as a mesh and once as a design.
  folder.write("a.stl",
               "solid a\n"
               "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 4 0\n"
               "vertex 4 0 0\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 4 0 0\n"
               "vertex 0 0 4\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 4\n"
               "vertex 0 4 0\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 4 0 0\nvertex 0 4 0\n"
               "vertex 0 0 4\nendloop\nendfacet\nendsolid a\n");
  folder.write("a.scad",
               "polyhedron([[0,0,0],[4,0,0],[0,4,0],[0,0,4]],"
               "[[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);");
  const ProcessResult result =
      compare({"a.stl", "a.scad", "--tolerance", "1e-9"});
  EXPECT_EQ(result.status, 0) << result.output << result.errors;
  EXPECT_TRUE(has(result.output, "in all 80 layers")) << result.output;
  EXPECT_EQ(compare({"a.stl", "a.scad", "--axis", "x", "--scale", "2"}).status,
            0);
}

TEST_F(Compare, OutlinesAreComparedToo) {
  folder.write("flat.scad",
               "w = 4; difference() { square([w, 6]); circle(1); }");
  ASSERT_EQ(run(folder, {"flat.scad", "-q", "-o", "flat.svg"}).status, 0);
  EXPECT_EQ(compare({"flat.svg", "flat.scad"}).status, 0);
  EXPECT_EQ(compare({"flat.svg", "flat.scad", "-D", "w=5"}).status, 1);
}

TEST_F(Compare, DrawsTheWorstLayer) {
  slice("ring.slc");
  EXPECT_EQ(compare({"ring.slc", "ring.scad", "-q", "--png", "d.png"}).status,
            0);
  EXPECT_TRUE(support::read_file(folder.file("d.png")).starts_with("\x89PNG"));
  const ProcessResult beyond = compare({"ring.slc", "ring.scad", "-q", "--png",
                                        "e.png", "--layer-number", "62"});
  EXPECT_EQ(beyond.status, 1);
  EXPECT_TRUE(has(beyond.errors, "there is no layer 62 to draw"));
}

TEST_F(Compare, BrokenFilesAreNamed) {
  slice("ring.cli");
  const std::string bytes = support::read_file(folder.file("ring.cli"));
  folder.write("cut.cli", bytes.substr(0, bytes.size() / 2));
  folder.write("bad.scad", "cube(;");
  folder.write("empty.scad", "");
  for (const char* bad : {"cut.cli", "bad.scad", "empty.scad", "none.slc"}) {
    for (const auto& words : {std::vector<std::string>{"ring.cli", bad},
                              std::vector<std::string>{bad, "ring.cli"}}) {
      const ProcessResult result = compare(words);
      EXPECT_EQ(result.status, 1) << bad;
      EXPECT_EQ(result.output, "") << bad;
      EXPECT_TRUE(has(result.errors, "error: ")) << bad;
    }
  }
}

// The error for another file names all that can be compared, in brackets.
TEST_F(Compare, HelpNamesEveryKindOfFileThatTheErrorNames) {
  const std::string help = compare({"--help"}).output;
  const std::string error = compare({"ring.scad", "ring.txt"}).errors;
  std::istringstream named(error.substr(
      error.find(" (") + 2, error.find(')') - error.find(" (") - 2));
  std::size_t count = 0;
  for (std::string extension; named >> extension; ++count) {
    EXPECT_TRUE(has(help, extension)) << extension;
  }
  EXPECT_EQ(count, 24U) << error;
}

TEST_F(Compare, ChecksItsUsage) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{
           {"ring.scad"},
           {"ring.scad", "ring.txt"},
           {"ring.scad", "ring.scad", "--against", "openscad"},
           {"ring.slc", "--against", "openscad"},
           {"ring.scad", "--against", "slic3r"},
           {"ring.scad", "--against", "openscad", "--chordal-error", "0.01"},
           {"ring.scad", "ring.slc", "--time-limit", "3"},
           {"ring.scad", "ring.slc", "--layer-number", "3"},
           {"ring.scad", "ring.slc", "--png", "a.jpg"},
           {"ring.scad", "ring.slc", "--tolerance", "-1"},
           {"ring.scad", "ring.slc", "--contour", "paper", "--sampler",
            "gl"}}) {
    EXPECT_EQ(compare(words).status, 2) << words.back();
  }
}

TEST_F(Compare, AMissingOpenscadIsAClearError) {
  const ProcessResult result =
      support::run_process({"env", "PATH=/nowhere", LAMINA_PROGRAM, "compare",
                            "ring.scad", "--against", "openscad"},
                           folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "openscad is not installed")) << result.errors;
}

// The middle of the box is at x = y = 0, where readers put the panel's middle;
// turned over or round, the piece would be another one.
TEST(Images, AreReadBackToATenthOfAPixel) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "translate([-5, -3, 0]) cube([10, 6, 2]);"
               "translate([2, -1, 2]) cube([2.7, 3.3, 1]);"
               "translate([-3, 1, 2]) cylinder(r = 1, h = 2, $fn = 40);");
  struct Case {
    const char* output;
    const char* printer;
  };
  for (const Case& one :
       {Case{"a.sl1", "prusa-sl1"}, Case{"b.sl1", "elegoo-mars-3"},
        Case{"a.zip", "wanhao-d7"}, Case{"b.nanodlp", "concepts3d-athena-8k"},
        Case{"a.png", "plain"}, Case{"b.png", "plain"}}) {
    ASSERT_EQ(run(folder, {"a.scad", "-q", "-o", one.output, "--printer",
                           one.printer, "--layer", "0.2"})
                  .status,
              0);
    // Half of a corner's pixel is rounded off.
    const ProcessResult result =
        run(folder, {"compare", one.output, "a.scad", "--tolerance", "0.03"});
    EXPECT_EQ(result.status, 0) << one.output << result.output << result.errors;
    const ProcessResult found = run(folder, {"inspect", one.output});
    EXPECT_EQ(found.status, 0) << found.output;
    EXPECT_TRUE(has(found.output, "20 images of")) << found.output;
  }
}

TEST(Images, ThatAreNoneAreErrors) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  ASSERT_EQ(run(folder, {"a.scad", "-q", "-o", "a.sl1"}).status, 0);
  const std::string bytes = support::read_file(folder.file("a.sl1"));
  folder.write("a.sl1", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(run(folder, {"inspect", "a.sl1"}).status, 1);
  folder.write("b.zip", "PK");
  EXPECT_EQ(run(folder, {"inspect", "b.zip"}).status, 1);
}

}  // namespace
}  // namespace lamina::cli
