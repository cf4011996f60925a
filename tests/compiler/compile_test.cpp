// From a design to an output: what appears, what is said, how it ends.

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include "plane/contours.h"
#include "plane/loop_area.h"
#include "slicer/formats/slc_reader.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
using support::read_file;
using support::TemporaryFolder;

std::vector<slicer::SlcLayer> read_slc(const std::string& path) {
  slicer::SlcReader reader(path);
  std::vector<slicer::SlcLayer> layers;
  slicer::SlcLayer layer;
  while (reader.read_layer(layer)) layers.push_back(layer);
  return layers;
}

double volume(const std::vector<slicer::SlcLayer>& layers) {
  double sum = 0;
  for (const slicer::SlcLayer& layer : layers) {
    for (const auto& boundary : layer.boundaries) {
      sum += layer.thickness * signed_area(boundary.points);
    }
  }
  return sum;
}

TEST(Compile, WithoutAnOutputTheSlcLiesBesideTheDesign) {
  const TemporaryFolder folder;
  folder.write("box.v2.scad", "cube([4, 5, 2]);");
  const auto result = run(folder, {"box.v2.scad"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.output, "");
  EXPECT_TRUE(has(result.errors, "40 layers")) << result.errors;
  const auto layers = read_slc(folder.file("box.v2.slc"));
  EXPECT_EQ(layers.size(), 40U);
  EXPECT_NEAR(volume(layers), 40, 1e-4);
  EXPECT_EQ(folder.entry_count(), 2U);
}

// What runs decides the language where the text leaves it open.
TEST(Compile, ReadsWhatDoesNothingIn2021AsWritten) {
  const TemporaryFolder folder;
  folder.write("used.scad", "function twice(x) = $f(x);");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"$f = function(x) 2 * x; cube($f(1));", "1: call of a function in a $"},
      {"use <used.scad>\n$f = function(x) 2 * x; cube(twice(1));",
       "used.scad:1: call of a function in a $ variable"},
      {"\nassert(version()[0] > 2022); cube(2);",
       "2: assert() of a newer version"},
      {"linear_extrude(h = 2) square(2);", "1: an argument that 2021.01 does"},
      {"linear_extrude(2) fill() square(2);", "1: fill"},
      {"x = [2, 3].xy; cube(x[0]);", "1: several members"},
      {"s = object(a = 2); cube(s.a);", "1: object"}};
  for (const auto& [text, what] : cases) {
    folder.write("a.scad", "echo(1);" + text);
    const auto found = run(folder, {"a.scad"});
    EXPECT_EQ(found.status, 0) << found.errors;
    EXPECT_TRUE(has(found.errors, "read as OpenSCAD 2026 (")) << found.errors;
    EXPECT_TRUE(has(found.errors, what)) << found.errors;
    // Nothing is said twice.
    EXPECT_EQ(found.errors.find("ECHO: 1"), found.errors.rfind("ECHO: 1"));
    EXPECT_NEAR(volume(read_slc(folder.file("a.slc"))), 8, 1e-4) << text;
    const auto told = run(folder, {"a.scad", "--language", "2021"});
    EXPECT_FALSE(has(told.errors, "read as OpenSCAD 2026")) << told.errors;
  }
}

TEST(Compile, SaysWhereTheLanguagesMayGiveOtherLayers) {
  const TemporaryFolder folder;
  folder.write("used.scad", "$fn = 9;\nmodule pin() cylinder(2, 2);");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"use <used.scad>\npin();", "used.scad:1: only 2021.01 sets it"},
      {"module m() { $x = 2; children(); }\nm() { y = $x; cube(y); }",
       "a.scad:2: in 2021.01 it does not see"},
      {"module m() children($fn = 1);\nm() { cube(1); cube(2); }",
       "a.scad:1: arguments of children()"},
      {"union($fn = 5) cylinder(2, 2);", "a.scad:1: arguments of a Boolean"}};
  const std::string remark = "newer ones may give other layers (";
  for (const auto& [text, what] : cases) {
    folder.write("a.scad", "$x = 1;" + text);
    const auto open = run(folder, {"a.scad"});
    EXPECT_TRUE(has(open.errors, remark)) << open.errors;
    EXPECT_TRUE(has(open.errors, what)) << open.errors;
    for (const std::string language : {"2021", "2026"}) {
      EXPECT_FALSE(
          has(run(folder, {"a.scad", "--language", language}).errors, remark));
    }
  }
  folder.write("a.scad", "$fn = 9; union() cylinder(2, 2);");
  EXPECT_FALSE(has(run(folder, {"a.scad"}).errors, remark));
}

// Messages point at no import() that nobody wrote.
TEST(Compile, NamesAFileThatItSlicesWithoutALine) {
  const TemporaryFolder folder;
  folder.write("part.stl", "junk");
  EXPECT_EQ(run(folder, {"part.stl"}).errors,
            "part.stl: error: STL file is neither text nor a whole header "
            "importing file '" +
                folder.file("part.stl") +
                "'\nerror: Current top level object is empty.\n");
  EXPECT_TRUE(run(folder, {"none.stl"})
                  .errors.starts_with("none.stl: warning: Can't open import "
                                      "file '" +
                                      folder.file("none.stl") + "'\n"));
}

// From 2^13 mm on, float32 numbers are 2^-10 mm apart; from 2^14 mm on, 2^-9.
TEST(Compile, WarnsOfDesignsTooFarFromTheOriginForSlc) {
  const TemporaryFolder folder;
  folder.write("far.scad", "translate([0, 20000, 0]) cube(1);");
  const auto far = run(folder, {"far.scad"});
  EXPECT_EQ(far.status, 0);
  EXPECT_TRUE(has(far.errors,
                  "20001 mm from the origin, the 32-bit numbers of SLC are "
                  "0.002 mm apart"))
      << far.errors;
  EXPECT_FALSE(
      has(run(folder, {"far.scad", "-o", "a.layers.json"}).errors, "apart"));
  folder.write("near.scad", "translate([-8000, 0, 0]) cube(1);");
  EXPECT_FALSE(has(run(folder, {"near.scad"}).errors, "apart"));
}

// A face in its own plane may reach farther than its coordinates.
TEST(Compile, DesignsTooLargeToFindTheirFacesAreAtFault) {
  const TemporaryFolder folder;
  folder.write("huge.scad",
               "rotate(45) linear_extrude(2, twist = 20, slices = 3) "
               "square(6e8);");
  const std::vector<std::string> words = {"huge.scad", "--layer", "1"};
  EXPECT_EQ(run(folder, words).status, 0);
  std::filesystem::remove(folder.file("huge.slc"));
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return run(folder, all);
  };
  // Its height is that of its corners, which need no faces.
  EXPECT_EQ(with({"--place-on-bed"}).status, 0);
  std::filesystem::remove(folder.file("huge.slc"));
  const auto result = with({"--hollow", "0.5"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors,
            "error: Coordinates beyond 1e9 mm: too large for exact layers\n");
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(Compile, QuietSaysNothing) {
  const TemporaryFolder folder;
  folder.write("a.scad", "echo(1); cube(1); foo();");
  const auto result = run(folder, {"-q", "a.scad"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(result.output, "");
}

TEST(Compile, StandardOutputCarriesTheOutputAlone) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "echo(\"hello\"); difference() { cube(3);"
               "translate([1, 1, -1]) cube([1, 1, 9]); }");
  const auto result = run(folder, {"a.scad", "-o", "-", "--export-format",
                                   "layers.json", "--heights", "0.5,1,9"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.errors, "ECHO: \"hello\""));
  const auto json = nlohmann::json::parse(result.output);
  ASSERT_EQ(json["layers"].size(), 3U);
  EXPECT_EQ(json["layers"][0]["z"], 0.5);
  EXPECT_EQ(json["layers"][0]["top"], 0.5);
  EXPECT_EQ(json["layers"][0]["contours"].size(), 2U);
  EXPECT_EQ(json["layers"][1]["z"], 1.0);
  EXPECT_TRUE(json["layers"][2]["contours"].empty());
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(Compile, AFileWhoseNameSaysNothingGetsWhatStandardOutputGets) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(3, $fn = 30);");
  std::vector<std::string> words = {"a.scad", "--export-format", "layers.json",
                                    "-o", "-"};
  const std::string output = run(folder, words).output;
  EXPECT_TRUE(has(output, "layers"));
  words.back() = "x";
  ASSERT_EQ(run(folder, words).status, 0);
  EXPECT_EQ(read_file(folder.file("x")), output);
}

TEST(Compile, DefinitionsOverrideTheDesign) {
  const TemporaryFolder folder;
  folder.write("a.scad", "w = 1; h = 1; cube([w, 1, h]);");
  ASSERT_EQ(run(folder, {"a.scad", "-D", "w=3", "-D", "h=2*w"}).status, 0);
  EXPECT_NEAR(volume(read_slc(folder.file("a.slc"))), 18, 1e-4);
}

TEST(Compile, ADefinitionTakesOneWordOnly) {
  const TemporaryFolder folder;
  folder.write("a.scad", "w = 1; h = 1; cube([w, 1, h]);");
  ASSERT_EQ(run(folder, {"-D", "w=3", "-D", "h=2*w", "a.scad"}).status, 0);
  EXPECT_NEAR(volume(read_slc(folder.file("a.slc"))), 18, 1e-4);
}

// Names are looked up, and scopes opened, at every level.
TEST(Compile, NestsAHundredThousandModules) {
  const TemporaryFolder folder;
  std::string design;
  for (int level = 0; level < 100000; ++level) design += "translate([0, 0]) ";
  folder.write("a.scad", design + "cube(1);");
  ASSERT_EQ(run(folder, {"a.scad"}).status, 0);
  EXPECT_NEAR(volume(read_slc(folder.file("a.slc"))), 1, 1e-4);
}

TEST(Compile, EveryAxisKeepsVolumeAndTurnsRightHanded) {
  const TemporaryFolder folder;
  // Three arms of different length show each turn.
  folder.write("a.scad",
               "cube([4, 0.5, 0.5]); cube([0.5, 3, 0.5]);"
               "cube([0.5, 0.5, 2]);");
  const std::vector<std::pair<std::string, double>> heights = {
      {"z", 2}, {"x", 4}, {"y", 3}, {"-x", 4}, {"-y", 3}, {"-z", 2}};
  for (const auto& [axis, height] : heights) {
    ASSERT_EQ(run(folder, {"a.scad", "--axis", axis}).status, 0) << axis;
    slicer::SlcReader reader(folder.file("a.slc"));
    const auto z = (*reader.facts().extents)[2];
    EXPECT_NEAR(z.y - z.x, height, 1e-4) << axis;
    EXPECT_NEAR(volume(read_slc(folder.file("a.slc"))), 2, 1e-4) << axis;
  }
  // (x, y, z) → (y, z, x): the arm along y lies along x now.
  ASSERT_EQ(run(folder, {"a.scad", "--axis", "x"}).status, 0);
  slicer::SlcReader reader(folder.file("a.slc"));
  EXPECT_NEAR((*reader.facts().extents)[0].y, 3, 1e-6);
  EXPECT_NEAR((*reader.facts().extents)[1].y, 2, 1e-6);
}

TEST(Compile, EmptyLayersInsideStayAndOutsideGo) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "intersection() { cube(10); union() {"
               "translate([0, 0, 1]) cube(1);"
               "translate([0, 0, 3]) cube(1); } }");
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.5"}).status, 0);
  const auto layers = read_slc(folder.file("a.slc"));
  ASSERT_EQ(layers.size(), 6U);
  EXPECT_NEAR(layers.front().z, 1, 1e-6);
  EXPECT_TRUE(layers[2].boundaries.empty());
  EXPECT_TRUE(layers[3].boundaries.empty());
  EXPECT_EQ(layers[5].boundaries.size(), 1U);
}

TEST(Compile, OneAndManyThreadsWriteTheSameBytes) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "difference() { rotate([10, 20, 0]) sphere(5, $fn = 60);"
               "for (i = [0 : 20]) rotate([0, 0, 17 * i])"
               "translate([3, 0, 0]) cylinder(r = 0.3, h = 20, center = true,"
               "$fn = 24); }");
  const auto bytes_with = [&](const char* threads, const char* mode) {
    EXPECT_EQ(
        run(folder, {"a.scad", "-o", "a.slc", "--threads", threads, "--contour",
                     mode, "--compensate", "0.02", "--tolerance", "0.01"})
            .status,
        0);
    return read_file(folder.file("a.slc"));
  };
  for (const char* const mode : {"faithful", "paper"}) {
    const std::string one = bytes_with("1", mode);
    EXPECT_GT(one.size(), 10000U) << mode;
    EXPECT_EQ(bytes_with("2", mode), one) << mode;
    EXPECT_EQ(bytes_with("7", mode), one) << mode;
  }
}

// Not even the box that the layers start from.
TEST(Compile, AFacetOfAFileThatIsNowhereChangesNoLayer) {
  const auto facet = [](const std::string& a, const std::string& b,
                        const std::string& c) {
    return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b +
           "\nvertex " + c + "\nendloop\nendfacet\n";
  };
  const std::string a = "20 20 20";
  const std::string b = "24 20 20";
  const std::string c = "20 24 20";
  const std::string top = "20 20 23.3";
  const std::string text = "solid\n" + facet(a, c, b) + facet(a, b, top) +
                           facet(b, c, top) + facet(c, a, top);
  const TemporaryFolder folder;
  folder.write("whole.stl", text + "endsolid\n");
  folder.write("more.stl", text + facet(a, b, "nan 1 1") + "endsolid\n");
  for (const std::string name : {"whole", "more"}) {
    folder.write(name + ".scad", "import(\"" + name + ".stl\");");
    ASSERT_EQ(run(folder, {name + ".scad", "--layer", "0.3"}).status, 0);
  }
  EXPECT_EQ(read_file(folder.file("more.slc")),
            read_file(folder.file("whole.slc")));
}

TEST(Compile, ScaleIsScaleOfTheDesign) {
  const TemporaryFolder folder;
  const std::string text =
      "module it() { translate([1, 2, 3]) { cube(10, center = true);"
      "translate([0, 0, 4]) sphere(4, $fn = 30); } }";
  folder.write("a.scad", text + "it();");
  folder.write("b.scad", text + "scale(1.02) it();");
  for (const char* const axis : {"z", "-x"}) {
    ASSERT_EQ(run(folder, {"a.scad", "--scale", "1.02", "--axis", axis}).status,
              0);
    ASSERT_EQ(run(folder, {"b.scad", "--axis", axis}).status, 0);
    EXPECT_EQ(read_file(folder.file("a.slc")), read_file(folder.file("b.slc")))
        << axis;
  }
}

TEST(Compile, ScaleLeavesTheThicknessOfLayers) {
  const TemporaryFolder folder;
  folder.write("c.scad", "cube(10);");
  ASSERT_EQ(run(folder, {"c.scad", "--scale", "1.02", "--layer", "0.1"}).status,
            0);
  EXPECT_EQ(read_slc(folder.file("c.slc")).size(), 102U);
  slicer::SlcReader reader(folder.file("c.slc"));
  EXPECT_EQ(reader.facts().sampling.front().thickness, 0.1F);
  EXPECT_NEAR((*reader.facts().extents)[0].y, 10.2, 1e-6);
}

TEST(Compile, ScaleIsOfOutlinesToo) {
  const TemporaryFolder folder;
  folder.write("flat.scad", "square(10);");
  ASSERT_EQ(run(folder, {"flat.scad", "--scale", "1.5", "-o", "a.layers.json"})
                .status,
            0);
  EXPECT_NE(read_file(folder.file("a.layers.json")).find("[15,15]"),
            std::string::npos);
  ASSERT_EQ(run(folder, {"flat.scad", "-o", "a.svg"}).status, 0);
  EXPECT_NE(read_file(folder.file("a.svg")).find(" 10,-10 "),
            std::string::npos);
}

TEST(Compile, CompensationIsInTheLayersAndInTheTable) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([10, 10, 1]); translate([20, 0]) cube(0.1);");
  const auto result = run(folder, {"a.scad", "--layer", "0.05", "--compensate",
                                   "0.05", "--report", "r.json"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.errors.find("2 regions and 0 walls of 0.1 mm or less"),
            std::string::npos)
      << result.errors;
  const auto json = nlohmann::json::parse(read_file(folder.file("r.json")));
  EXPECT_EQ(json.at("vanished_regions"), 2);
  slicer::SlcReader reader(folder.file("a.slc"));
  EXPECT_EQ(reader.facts().sampling.front().line_width_compensation, 0.05F);
  EXPECT_NEAR(volume(read_slc(folder.file("a.slc"))), 9.9 * 9.9, 1e-4);
}

TEST(Compile, NegativeCompensationMovesContoursOutwards) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([10, 10, 1]);");
  ASSERT_EQ(run(folder, {"a.scad", "--compensate", "-0.05"}).status, 0);
  slicer::SlcReader outwards(folder.file("a.slc"));
  EXPECT_EQ(outwards.facts().sampling.front().line_width_compensation, -0.05F);
  EXPECT_NEAR((*outwards.facts().extents)[0].x, -0.05, 1e-6);
}

TEST(Compile, CompensationThatLeavesNothingIsAnError) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([10, 10, 1]);");
  const auto nothing = run(folder, {"a.scad", "--compensate", "6"});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_NE(nothing.errors.find("Nothing is left of the design"),
            std::string::npos)
      << nothing.errors;
}

TEST(Compile, CompensationIsOfOutlinesToo) {
  const TemporaryFolder folder;
  folder.write("flat.scad", "square(10);");
  ASSERT_EQ(
      run(folder, {"flat.scad", "--compensate", "1", "-o", "flat.layers.json"})
          .status,
      0);
  EXPECT_NE(read_file(folder.file("flat.layers.json")).find("[9,9]"),
            std::string::npos);
}

TEST(Compile, ReportHoldsTimesAndCounts) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(3);");
  ASSERT_EQ(run(folder, {"a.scad", "--report", "r.json"}).status, 0);
  const auto json = nlohmann::json::parse(read_file(folder.file("r.json")));
  double sum = 0;
  for (const char* const key :
       {"load_seconds", "evaluate_seconds", "lower_seconds", "section_seconds",
        "sweep_seconds", "output_seconds"}) {
    EXPECT_GT(json.at(key).get<double>(), 0) << key;
    sum += json.at(key).get<double>();
  }
  EXPECT_LE(sum, json.at("total_seconds").get<double>());
  EXPECT_EQ(json.at("layers"), read_slc(folder.file("a.slc")).size());
  EXPECT_GT(json.at("peak_memory_bytes").get<double>(), 1e6);
  EXPECT_EQ(json.at("repaired_clusters"), 0);
}

TEST(Compile, PeakMemoryOfAReportIsNotThatOfTheCaller) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  const std::vector<char> much(64'000'000, 'a');
  ASSERT_EQ(run(folder, {"a.scad", "--report", "r.json"}).status, 0);
  EXPECT_EQ(much.back(), 'a');
  const auto json = nlohmann::json::parse(read_file(folder.file("r.json")));
  EXPECT_LT(json.at("peak_memory_bytes").get<double>(), 64e6);
}

// Two cubes of 2 mm in a box of 10 mm: each is sampled in its own box, or in
// the whole, where the rays beside it find nothing.
TEST(Compile, ReportCountsTheDepthImages) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(2); translate([8, 0, 0]) cube(2);");
  const auto images = [&](const std::string& boxes) {
    EXPECT_EQ(run(folder, {"a.scad", "--contour", "paper", "--layer", "0.1",
                           "--boxes", boxes, "--report", "r.json"})
                  .status,
              0);
    return nlohmann::json::parse(read_file(folder.file("r.json")));
  };
  const auto local = images("local");
  const auto global = images("global");
  EXPECT_EQ(local.at("image_samples"), 2 * 2 * 20 * 20);
  EXPECT_EQ(global.at("image_samples"), local.at("image_samples"));
  EXPECT_NEAR(local.at("image_pixels").get<double>(), 2 * 20 * 20, 100);
  EXPECT_NEAR(global.at("image_pixels").get<double>(), 2 * 100 * 20, 100);
  EXPECT_GT(global.at("image_bytes"), local.at("image_bytes"));
  // A depth and a colour, 7 bytes, for each of two peels.
  for (const auto& report : {local, global}) {
    EXPECT_EQ(report.at("dense_image_bytes").get<std::uint64_t>(),
              2 * 7 * report.at("image_pixels").get<std::uint64_t>());
  }
}

// --- What goes wrong ------------------------------------------------------

TEST(Compile, FaultyDesignsEndWithOneAndMakeNothing) {
  struct Case {
    std::string text;
    std::string words;
  };
  const std::vector<Case> cases = {
      {"cube(1", "syntax error"},
      {"assert(1 == 2); cube(1);", "Assertion '(1 == 2)' failed"},
      {"module f() { f(); } f(); cube(1);", "Recursion detected"},
      {"function f(x) = 1 + f(x); echo(f(1)); cube(1);", "Recursion detected"},
      {"", "Current top level object is empty."},
      {"translate([1, 2, 3]) {}", "Current top level object is empty."},
      {"intersection() { cube(1); translate([5, 0, 0]) cube(1); }",
       "Current top level object is empty."},
      {"square(3);", "Current top level object is not a 3D object."},
  };
  for (const Case& each : cases) {
    const TemporaryFolder folder;
    folder.write("a.scad", each.text);
    const auto result = run(folder, {"a.scad"});
    EXPECT_EQ(result.status, 1) << each.text;
    EXPECT_TRUE(has(result.errors, each.words)) << each.text << result.errors;
    EXPECT_EQ(result.output, "");
    EXPECT_EQ(folder.entry_count(), 1U) << each.text;
  }
}

TEST(Compile, MissingInputsAreErrorsWithTheirName) {
  const TemporaryFolder folder;
  for (const auto& arguments :
       {std::vector<std::string>{"nofile.scad"},
        std::vector<std::string>{"nofile.scad", "-o", "a.echo"},
        std::vector<std::string>{"inspect", "nofile.slc"},
        std::vector<std::string>{"view", "nofile.slc", "-o", "a.png"},
        std::vector<std::string>{"view", "nofile.scad", "-o", "a.png"}}) {
    const auto result = run(folder, arguments);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(has(result.errors, "nofile")) << result.errors;
  }
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(Compile, OutputsThatCannotBeWrittenAreErrorsWithTheirName) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const char* const output : {"a.scad/b.slc", "/proc/a.slc",
                                   "a.scad/b.echo", "a.scad/b.layers.json"}) {
    const auto result = run(folder, {"a.scad", "-o", output});
    EXPECT_EQ(result.status, 1) << output;
    EXPECT_TRUE(has(result.errors, output)) << result.errors;
  }
  EXPECT_EQ(run(folder, {"a.scad", "-o", "/dev/full", "--export-format", "slc"})
                .status,
            1);
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(Compile, AnOldOutputSurvivesAFailedRun) {
  const TemporaryFolder folder;
  folder.write("a.scad", "assert(false);");
  folder.write("a.slc", "old");
  EXPECT_EQ(run(folder, {"a.scad"}).status, 1);
  EXPECT_EQ(read_file(folder.file("a.slc")), "old");
}

TEST(Compile, WarningsGoOnUnlessTheyAreHard) {
  for (const char* const text :
       {"foo(); cube(1);", "x = y; cube(1);", "x = f(1); cube(1);",
        "include <nothing.scad>\ncube(1);", "use <nothing.scad>\ncube(1);"}) {
    const TemporaryFolder folder;
    folder.write("a.scad", text);
    const auto soft = run(folder, {"a.scad", "-o", "soft.slc"});
    EXPECT_EQ(soft.status, 0) << text;
    EXPECT_TRUE(has(soft.errors, "warning: ")) << soft.errors;
    const auto hard = run(folder, {"a.scad", "--hardwarnings"});
    EXPECT_EQ(hard.status, 1) << text;
    EXPECT_TRUE(has(hard.errors, "warning: ")) << hard.errors;
    EXPECT_EQ(folder.entry_count(), 2U) << text;
  }
}

TEST(Compile, EqualWarningsAreShownOnceWithTheirNumber) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "for (i = [1 : 7]) foo(); for (i = [1 : 5]) echo(1);"
               "cube(1);");
  const auto result = run(folder, {"a.scad"});
  EXPECT_EQ(result.status, 0);
  std::size_t count = 0;
  for (std::size_t at = 0; (at = result.errors.find("Ignoring unknown module",
                                                    at)) != std::string::npos;
       ++at) {
    ++count;
  }
  EXPECT_EQ(count, 2U) << result.errors;
  EXPECT_TRUE(has(result.errors, "(7 times in all)")) << result.errors;
  EXPECT_TRUE(has(result.errors, "ECHO: 1\n  (5 times)\n")) << result.errors;
}

// --- Texts, which end as openscad's do -------------------------------------

TEST(Compile, TextsEndWellWhereTheDesignFails) {
  const TemporaryFolder folder;
  folder.write("a.scad", "echo(5); assert(false); cube(1);");
  const auto echo = run(folder, {"a.scad", "-o", "a.echo"});
  EXPECT_EQ(echo.status, 0) << echo.errors;
  EXPECT_EQ(read_file(folder.file("a.echo")),
            "ECHO: 5\n"
            "ERROR: Assertion 'false' failed in file a.scad, line 1\n"
            "TRACE: called by 'assert' in file a.scad, line 1\n");
  EXPECT_EQ(run(folder, {"a.scad", "-o", "a.csg"}).status, 0);
  EXPECT_EQ(read_file(folder.file("a.csg")), "\n");
  EXPECT_EQ(run(folder, {"a.scad", "-o", "a.ast"}).status, 0);
  EXPECT_TRUE(has(read_file(folder.file("a.ast")), "assert(false);"));
}

TEST(Compile, SyntaxErrorsWriteAnEchoButNothingElse) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1;");
  EXPECT_EQ(run(folder, {"a.scad", "-o", "a.csg"}).status, 1);
  EXPECT_EQ(run(folder, {"a.scad", "-o", "a.ast"}).status, 1);
  EXPECT_EQ(folder.entry_count(), 1U);
  EXPECT_EQ(run(folder, {"a.scad", "-o", "a.echo"}).status, 1);
  EXPECT_EQ(read_file(folder.file("a.echo")),
            "ERROR: Parser error: syntax error in file a.scad, line 1\n"
            "Can't parse file 'a.scad'!\n\n");
}

TEST(Compile, EmptyAndFlatDesignsHaveTexts) {
  const TemporaryFolder folder;
  folder.write("a.scad", "");
  folder.write("b.scad", "square(3);");
  for (const char* const extension : {"echo", "csg", "ast"}) {
    for (const char* const design : {"a", "b"}) {
      EXPECT_EQ(run(folder, {std::string(design) + ".scad", "-o",
                             std::string(design) + "." + extension})
                    .status,
                0);
    }
  }
  EXPECT_EQ(read_file(folder.file("b.csg")),
            "square(size = [3, 3], center = false);\n\n");
}

TEST(Compile, FlatDesignsHaveOneLayerInJson) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "difference() { square(3); translate([1, 1])"
               "square(1); }");
  ASSERT_EQ(run(folder, {"a.scad", "-o", "a.layers.json"}).status, 0);
  const auto json =
      nlohmann::json::parse(read_file(folder.file("a.layers.json")));
  ASSERT_EQ(json["layers"].size(), 1U);
  EXPECT_EQ(json["layers"][0]["z"], 0.0);
  EXPECT_EQ(json["layers"][0]["contours"].size(), 2U);
}

TEST(Compile, CsgTextSlicesToTheSameBytes) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "difference() { sphere(3); rotate([30, 0, 0])"
               "cylinder(r = 1, h = 9, center = true); }");
  ASSERT_EQ(run(folder, {"a.scad"}).status, 0);
  ASSERT_EQ(run(folder, {"a.scad", "-o", "b.csg"}).status, 0);
  ASSERT_EQ(run(folder, {"b.csg"}).status, 0);
  const auto a = read_slc(folder.file("a.slc"));
  const auto b = read_slc(folder.file("b.slc"));
  EXPECT_EQ(a.size(), b.size());
  EXPECT_NEAR(volume(a), volume(b), 1e-3);
}

// --- Interruption -----------------------------------------------------------

TEST(Compile, InterruptedRunsEndWith130AndLeaveNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const TemporaryFolder streams;
    const std::string errors = streams.write("errors", "");
    // Slices for minutes, once it has spoken.
    folder.write("a.scad",
                 "echo(1); for (x = [0 : 40]) for (y = [0 : 40])"
                 "translate([x, y, 0]) sphere(0.7, $fn = 60);");
    support::BackgroundProcess process(
        command({"a.scad", "--layer", "0.00002"}), folder.path(), errors);
    ASSERT_TRUE(
        support::wait_until([&] { return !read_file(errors).empty(); }));
    process.send(signal);
    EXPECT_EQ(process.wait(), 130);
    EXPECT_EQ(folder.entry_count(), 1U);
  }
}

// In the folder and all below it.
std::size_t file_count(const TemporaryFolder& folder) {
  std::size_t count = 0;
  std::error_code error;
  std::filesystem::recursive_directory_iterator at(folder.path(), error);
  for (; !error && at != end(at); at.increment(error)) ++count;
  return count;
}

// Files go on being made while the folder is emptied.
TEST(Compile, AnInterruptedFolderOfImagesLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([1, 1, 100]);");
  folder.write("tiny.json", R"({"name":"tiny","pixels":[8,8],"pixel_mm":[1,1],)"
                            R"("right":"+x","up":"+y"})");
  for (int i = 0; i < 3; ++i) {
    support::BackgroundProcess process(
        command({"a.scad", "-o", "a.png", "--printer", "tiny.json", "--layer",
                 "0.0001"}),
        folder.path());
    ASSERT_TRUE(support::wait_until([&] { return file_count(folder) > 100; }));
    process.send(SIGINT);
    EXPECT_EQ(process.wait(), 130);
    EXPECT_EQ(folder.entry_count(), 2U);
  }
}

TEST(Compile, AReaderThatLeavesIsAnErrorNotADeath) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(5, $fn = 200);");
  const std::string line = std::string(LAMINA_PROGRAM) +
                           " a.scad -o - --export-format layers.json "
                           "--tolerance 0 -q | true; exit ${PIPESTATUS[0]}";
  const auto result = support::run_process({"bash", "-c", line}, folder.path());
  EXPECT_EQ(result.status, 1);
}

TEST(Compile, AFileLargerThanTheUserMayWriteLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(5, $fn = 200);");
  for (const char* const output : {"a.slc", "a.sl1", "a.png"}) {
    const std::string line = std::string("ulimit -f 1; ") + LAMINA_PROGRAM +
                             " a.scad --tolerance 0 -o " + output;
    const auto result =
        support::run_process({"bash", "-c", line}, folder.path());
    EXPECT_EQ(result.status, 1) << output;
    EXPECT_NE(result.errors.find("File too large"), std::string::npos)
        << result.errors;
    EXPECT_EQ(folder.entry_count(), 1U) << output;
  }
}

TEST(Compile, ASetThatCannotBeUsedMakesNoLayers) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; echo(size); cube(size);");
  folder.write("sets.json", R"({"parameterSets": {"big": {"size": "3"}}})");
  const auto good = run(folder, {"a.scad", "-p", "sets.json", "-P", "big"});
  EXPECT_EQ(good.status, 0) << good.errors;
  EXPECT_NEAR(volume(read_slc(folder.file("a.slc"))), 27, 1e-4);
  std::filesystem::remove(folder.file("a.slc"));
  for (const char* const set : {"small", ""}) {
    const auto bad = run(folder, {"a.scad", "-p", "sets.json", "-P", set});
    EXPECT_NE(bad.status, 0) << bad.errors;
  }
  const auto none = run(folder, {"a.scad", "-p", "none.json", "-P", "big"});
  EXPECT_EQ(none.status, 1);
  EXPECT_TRUE(has(none.errors,
                  "error: Cannot open Parameter Set 'none.json': none.json: "
                  "cannot open file"))
      << none.errors;
  folder.write("sets.json", R"({"parameterSets": {"big": {"size": 1e400}}})");
  const auto huge = run(folder, {"a.scad", "-p", "sets.json", "-P", "big"});
  EXPECT_EQ(huge.status, 1);
  EXPECT_TRUE(has(huge.errors, "sets.json(1): number overflow parsing '1e400'"))
      << huge.errors;
  EXPECT_EQ(folder.entry_count(), 2U);
}

TEST(Compile, TheSeedChangesUnseededRandomNumbers) {
  const TemporaryFolder folder;
  folder.write("a.scad", "echo(rands(0, 1, 3)); echo(rands(0, 1, 1, 7));");
  const auto echo = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(),
                     {"a.scad", "-q", "-o", "-", "--export-format", "echo"});
    return run(folder, arguments).output;
  };
  const std::string first = echo({});
  EXPECT_EQ(first, echo({"--seed", "0"}));
  const std::string second = echo({"--seed", "1"});
  EXPECT_EQ(second, echo({"--seed", "1"}));
  const auto line = [](const std::string& text) { return text.find('\n'); };
  EXPECT_NE(first.substr(0, line(first)), second.substr(0, line(second)));
  EXPECT_EQ(first.substr(line(first)), second.substr(line(second)));
}

TEST(Compile, DependenciesOfLayersAreThoseOfTheDesign) {
  const TemporaryFolder folder;
  folder.write("a.scad", "include <b.scad>\nuse <missing.scad>\ncube(size);");
  folder.write("b.scad", "size = 2;");
  const auto result = run(folder, {"a.scad", "-q", "-d", "a.d"});
  EXPECT_EQ(result.status, 0) << result.errors;
  const std::string b =
      std::filesystem::canonical(folder.file("b.scad")).string();
  const std::string rule = read_file(folder.file("a.d"));
  EXPECT_TRUE(rule.starts_with("a.slc: \\\n\t")) << rule;
  EXPECT_TRUE(has(rule, " \\\n\ta.scad")) << rule;
  EXPECT_TRUE(has(rule, " \\\n\t" + b)) << rule;
  EXPECT_FALSE(has(rule, "missing")) << rule;
}

}  // namespace
}  // namespace lamina::cli
