// `--compensate`, as a user of the program meets it: contours, the foot, and
// light that bleeds.

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"
#include "tests/cli/run_report.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using nlohmann::json;
using support::has;
using support::read_file;
using support::TemporaryFolder;

// With a plate over 6 mm by 4 mm of air.
const char* const kBridge =
    "module part(rise = 0) {\n"
    "  cube([2, 4, 3]);\n"
    "  translate([8, 0, 0]) cube([2, 4, 3]);\n"
    "  translate([0, 0, 2 + rise]) cube([10, 4, 1 - rise]);\n"
    "}\n";

class Compensate : public ::testing::Test {
 protected:
  Compensate() {
    folder_.write("part.scad", kBridge);
    folder_.write("a.scad", "use <part.scad>\npart();\n");
  }

  // Slices a.scad to a.slc.
  support::ProcessResult slice(std::vector<std::string> options) const {
    options.insert(options.begin(), {"a.scad", "-o", "a.slc"});
    return run(folder_, options);
  }

  // The report of that.
  json report_of(std::vector<std::string> options) const {
    options.insert(options.begin(), {"a.scad", "-o", "a.slc"});
    return cli::report_of(folder_, std::move(options));
  }

  // Whether the two have equal layers.
  bool agree(const std::string& a, const std::string& b,
             std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"compare", a, b});
    const auto compared = run(folder_, options);
    EXPECT_LE(compared.status, 1) << compared.errors;
    return compared.status == 0;
  }

  TemporaryFolder folder_;
};

TEST_F(Compensate, NothingIsTheDefault) {
  ASSERT_EQ(slice({}).status, 0);
  const std::string plain = read_file(folder_.file("a.slc"));
  for (const char* words : {"0", "foot=0", "bleed=0", "0,foot=0x9,bleed=0"}) {
    ASSERT_EQ(slice({"--compensate", words}).status, 0) << words;
    EXPECT_EQ(read_file(folder_.file("a.slc")), plain) << words;
    EXPECT_FALSE(report_of({"--compensate", words}).contains("compensation"));
  }
}

TEST_F(Compensate, TheReportAndTheSummarySayWhatWasDone) {
  const auto made = slice({"--compensate", "0.03,foot=0.1x4,bleed=0.05"});
  EXPECT_TRUE(has(made.errors,
                  "\ncompensated: contours 0.03 mm, foot 0.1 mm over 4 layers, "
                  "bleed 0.05 mm\n"))
      << made.errors;
  const json done =
      report_of({"--compensate", "0.03,foot=0.1x4,bleed=0.05"})["compensation"];
  EXPECT_EQ(done["contour_mm"], 0.03);
  EXPECT_EQ(done["foot_mm"], 0.1);
  EXPECT_EQ(done["foot_layers"], 4);
  EXPECT_EQ(done["bleed_mm"], 0.05);
  EXPECT_EQ(done["low_walls"]["layers"], 0);
  EXPECT_EQ(
      report_of({"--compensate", "foot=0.1"})["compensation"]["foot_layers"],
      3);
}

TEST_F(Compensate, WordsThatMeanNothingAreUsageErrors) {
  for (const char* words : {"",
                            ",",
                            "foot",
                            "foot=",
                            "foot=-0.1",
                            "foot=11",
                            "foot=0.1x",
                            "foot=0.1x0",
                            "foot=0.1x101",
                            "foot=0.1x2.5",
                            "foot=0.1x-3",
                            "bleed=-0.1",
                            "bleed=11",
                            "bleed=x",
                            "0.1,0.2",
                            "foot=0.1,foot=0.1",
                            "bleed=0.1,bleed=0.1",
                            "sink=0.1",
                            "0.1;bleed=0.1",
                            "nan",
                            "bleed=nan"}) {
    const auto made = slice({"--compensate", words});
    EXPECT_EQ(made.status, 2) << words;
    EXPECT_TRUE(has(made.errors, "--compensate")) << words << made.errors;
  }
}

// The layers are those of a design that has been mended by hand; a printer
// that bleeds by as much, drawn as a design too, makes the nominal one of them.
TEST_F(Compensate, APrintThatBleedsHasNominalSize) {
  folder_.write("mended.scad", "use <part.scad>\npart(0.1);\n");
  folder_.write("printed.scad",
                "use <part.scad>\npart(0.1);\nintersection() {\n"
                "  translate([0, 0, -0.1]) part(0.1);\n  cube(20);\n}\n");
  ASSERT_EQ(slice({"--compensate", "bleed=0.1", "--layer", "0.025"}).status, 0);
  EXPECT_TRUE(agree("mended.scad", "a.slc"));
  EXPECT_FALSE(agree("a.scad", "a.slc"));
  EXPECT_TRUE(agree("printed.scad", "a.scad", {"--layer", "0.025"}));
}

TEST_F(Compensate, AFootIsAStackOfSmallerLayers) {
  folder_.write("a.scad", "cube([10, 8, 2]);\n");
  folder_.write(
      "mended.scad",
      "for (i = [0 : 39]) translate([0, 0, i / 20])\n"
      "  linear_extrude(1 / 20) offset(delta = -max(0, 0.1 - i / 40))\n"
      "    square([10, 8]);\n");
  ASSERT_EQ(slice({"--compensate", "foot=0.1x4"}).status, 0);
  EXPECT_TRUE(agree("mended.scad", "a.slc"));
  // What the printer makes of it: the foot grows back.
  folder_.write("printed.scad",
                "for (i = [0 : 39]) translate([0, 0, i / 20]) linear_extrude(1 "
                "/ 20)\n  offset(delta = max(0, 0.1 - i / 40))\n"
                "    offset(delta = -max(0, 0.1 - i / 40)) square([10, 8]);\n");
  EXPECT_TRUE(agree("printed.scad", "a.scad"));
}

// A ring that lies on its side: the file is that of the design with the same
// options, at all its heights.
TEST_F(Compensate, CompareKnowsAllOfIt) {
  folder_.write("a.scad",
                "translate([0, 0, 9.5]) rotate([90, 0, 0]) rotate_extrude($fn "
                "= 80) translate([8, 0]) scale([1, 2]) circle(1.5, $fn = "
                "30);\n");
  const std::string words = "0.02,foot=0.1x5,bleed=0.06";
  ASSERT_EQ(slice({"--compensate", words, "-q"}).status, 0);
  EXPECT_TRUE(agree("a.scad", "a.slc", {"--compensate", words}));
  EXPECT_FALSE(agree("a.scad", "a.slc", {"--compensate", "0.02,bleed=0.06"}));
  EXPECT_FALSE(agree("a.scad", "a.slc", {"--compensate", "0.02,foot=0.1x5"}));
}

TEST_F(Compensate, EachLayerOfTheFootHasARowInAnSlc) {
  ASSERT_EQ(slice({"--compensate", "0.02,foot=0.08x4"}).status, 0);
  const auto inspected = run(folder_, {"inspect", "a.slc", "--json"});
  const json rows = json::parse(inspected.output)["sampling"];
  ASSERT_EQ(rows.size(), 5U) << inspected.output;
  const double expected[] = {0.1, 0.08, 0.06, 0.04, 0.02};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i]["compensation"].get<double>(), expected[i], 1e-6);
  }
}

TEST_F(Compensate, TheProfileGivesWhatTheOptionDoesNot) {
  folder_.write("resin.json",
                R"({"name": "r", "density": 1.1, "compensation": {
                    "contour_mm": 0.02, "foot_mm": 0.1, "foot_layers": 5,
                    "bleed_mm": 0.04, "source": "a test print"}})");
  const auto done = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--material", "resin.json"});
    const json report = report_of(std::move(options));
    if (!report.contains("compensation")) return std::string("none");
    const json& what = report["compensation"];
    std::ostringstream text;
    text << what["contour_mm"].get<double>() << ' '
         << what["foot_mm"].get<double>() << ' '
         << what["foot_layers"].get<int>() << ' '
         << what["bleed_mm"].get<double>();
    return text.str();
  };
  EXPECT_EQ(done({}), "0.02 0.1 5 0.04");
  EXPECT_EQ(done({"--compensate", "0.05"}), "0.05 0.1 5 0.04");
  EXPECT_EQ(done({"--compensate", "foot=0.2"}), "0.02 0.2 3 0.04");
  EXPECT_EQ(done({"--compensate", "bleed=0"}), "0.02 0.1 5 0");
  EXPECT_EQ(done({"--compensate", "0,bleed=0.1"}), "0 0.1 5 0.1");
  EXPECT_EQ(done({"--compensate", "0"}), "none");
}

TEST_F(Compensate, ProfilesWithOtherFiguresAreRefused) {
  for (const char* what : {R"({"foot_mm": -1})", R"({"foot_layers": 0})",
                           R"({"foot_layers": 2.5})", R"({"bleed_mm": 11})",
                           R"({"depth": 1})", R"({"contour_mm": "x"})"}) {
    folder_.write("resin.json",
                  std::string(R"({"name": "r", "density": 1.1, )") +
                      R"("compensation": )" + what + "}");
    EXPECT_EQ(slice({"--material", "resin.json"}).status, 1) << what;
  }
}

TEST_F(Compensate, LowWallsAreWarnedOf) {
  folder_.write("a.scad",
                "cube([2, 4, 4]); translate([0, 0, 2]) cube([10, 4, 0.1]);\n");
  const auto made = slice({"--compensate", "bleed=0.15"});
  EXPECT_EQ(made.status, 0);
  EXPECT_TRUE(has(made.errors, "walls lower than 0.15 mm vanish"))
      << made.errors;
  const json done = report_of({"--compensate", "bleed=0.15"})["compensation"];
  EXPECT_GT(done["low_walls"]["layers"], 0);
  EXPECT_EQ(slice({"--compensate", "bleed=0.15", "--strict"}).status, 1);
}

TEST_F(Compensate, OutlinesHaveNeitherFootNorBleed) {
  folder_.write("a.scad", "square(10);\n");
  const auto made = run(folder_, {"a.scad", "-o", "a.svg", "--compensate",
                                  "0.5,foot=0.1,bleed=0.1"});
  EXPECT_EQ(made.status, 0);
  EXPECT_TRUE(has(made.errors,
                  "foot and bleed of the compensation need a "
                  "solid; the design is flat"))
      << made.errors;
  EXPECT_TRUE(has(made.errors, "compensated: contours 0.5 mm\n"))
      << made.errors;
  folder_.write("b.scad", "translate([0.5, 0.5]) square(9);\n");
  EXPECT_TRUE(agree("a.svg", "b.scad"));
}

TEST_F(Compensate, CeilingsOfCavitiesRiseToo) {
  folder_.write("a.scad", "cube([20, 16, 10]);\n");
  const double hollow =
      report_of({"--hollow", "1", "--drain", "none"})["volume_mm3"];
  const double bled = report_of({"--hollow", "1", "--drain", "none",
                                 "--compensate", "bleed=0.2"})["volume_mm3"];
  EXPECT_NEAR(hollow - bled, 18 * 14 * 0.2, 1e-3);
}

// Thin places are those of the contours before they move: with a foot as
// without.
TEST_F(Compensate, ThinPlacesAreFoundBeforeTheFoot) {
  folder_.write("a.scad", "cube([0.5, 6, 3]); cube([4, 4, 1]);\n");
  const json plain = report_of({"--min-feature", "0.6"});
  const json foot =
      report_of({"--min-feature", "0.6", "--compensate", "foot=0.05"});
  ASSERT_GT(plain["features"].size(), 0U);
  EXPECT_EQ(plain["features"], foot["features"]);
}

TEST_F(Compensate, SupportsKeepTheirContacts) {
  folder_.write("a.scad",
                "translate([0, 0, 8]) cube([14, 14, 2]);\ncube([3, 3, 9]);\n");
  const json before = report_of({"--supports"});
  const json after =
      report_of({"--supports", "--compensate", "foot=0.1,bleed=0.1"});
  EXPECT_GT(before["supports"]["contacts"].size(), 0U);
  EXPECT_EQ(before["supports"]["contacts"].size(),
            after["supports"]["contacts"].size());
  EXPECT_EQ(before["supports"]["count"], after["supports"]["count"]);
  const auto islands = [](const json& report) {
    std::size_t count = 0;
    for (const json& finding : report["print"]["findings"]) {
      count += finding["kind"] == "island" && finding["is_minor"] == false;
    }
    return count;
  };
  EXPECT_EQ(islands(before), islands(after));
}

// What a caster asks is asked of the piece that comes out.
TEST_F(Compensate, PreflightLooksAtTheDesign) {
  const std::vector<std::string> asked = {
      "preflight", "a.scad", "--metal", "sterling-silver", "-o", "p.json"};
  run(folder_, asked);
  const std::string plain = read_file(folder_.file("p.json"));
  std::vector<std::string> with = asked;
  with.insert(with.end(), {"--compensate", "0.05,foot=0.1,bleed=0.1"});
  run(folder_, with);
  EXPECT_EQ(read_file(folder_.file("p.json")), plain);
}

TEST_F(Compensate, BatchesSayItInTheirLastColumns) {
  folder_.write("t.csv", "name\nx\n");
  ASSERT_EQ(run(folder_, {"batch", "a.scad", "--table", "t.csv", "-o",
                          "{name}.slc", "--report", "r.csv", "--compensate",
                          "0.03,foot=0.1x4,bleed=0.05"})
                .status,
            0);
  const std::string table = read_file(folder_.file("r.csv"));
  EXPECT_TRUE(has(table, ",contour_mm,foot_mm,foot_layers,bleed_mm\r\n"))
      << table;
  EXPECT_TRUE(has(table, ",0.03,0.1,4,0.05\r\n")) << table;
}

}  // namespace
}  // namespace lamina::cli
