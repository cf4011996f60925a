// Hollow parts, as a user of the program meets them.

#include <cmath>
#include <string>
#include <utility>
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

const char* const kBox = "cube([20, 16, 10]);\n";
constexpr double kCavity = 18 * 14 * 8;  // of the box with walls of 1 mm [mm³]

// How many findings of a kind are large enough to matter.
std::size_t count_of(const json& print, const std::string& kind) {
  std::size_t count = 0;
  for (const json& finding : print["findings"]) {
    count += finding["kind"] == kind && finding["is_minor"] == false ? 1 : 0;
  }
  return count;
}

// A folder with the box as a.scad.
class Hollow : public ::testing::Test {
 protected:
  Hollow() { folder_.write("a.scad", kBox); }

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

  TemporaryFolder folder_;
};

TEST_F(Hollow, TheSummarySaysWhatIsSaved) {
  const auto made =
      slice({"--hollow", "1", "--material", "bluecast-x10", "--price", "60/l"});
  EXPECT_EQ(made.status, 0);
  EXPECT_TRUE(has(made.errors,
                  "\nhollow: 1 cavity, saves 2016 mm³ (63 %), 2.22 g, 0.12; 2 "
                  "drains of 1.2 mm\n"))
      << made.errors;
  const auto with_currency =
      slice({"--hollow", "1", "--drain", "none", "--material", "bluecast-x10",
             "--price", "60 EUR/l"});
  EXPECT_TRUE(has(with_currency.errors, "(63 %), 2.22 g, 0.12 EUR\n"))
      << with_currency.errors;
  EXPECT_FALSE(has(slice({}).errors, "hollow"));
}

TEST_F(Hollow, TheReportHasCavitiesAndDrains) {
  const json report =
      report_of({"--hollow", "1", "--material", "bluecast-x10"});
  const json& hollow = report["hollow"];
  EXPECT_EQ(hollow["cavities"], 1);
  EXPECT_EQ(hollow["filled"], 0);
  EXPECT_NEAR(hollow["saved_mm3"], kCavity, 1e-3);
  EXPECT_NEAR(hollow["solid_mm3"], 3200, 1e-3);
  ASSERT_EQ(hollow["drains"].size(), 2U);
  for (const json& drain : hollow["drains"]) {
    EXPECT_EQ(drain["diameter_mm"], 1.2);
    EXPECT_EQ(drain["from"].size(), 3U);
    EXPECT_EQ(drain["to"].size(), 3U);
  }
  // Drains are polygons of 32 corners, each 1 mm deep. The lower one lies
  // beside the floor, and takes some of it.
  const double drain = 16 * std::sin(2 * M_PI / 32) * 0.36;
  const double volume = report["volume_mm3"];
  EXPECT_NEAR(volume, 3200 - kCavity - 2 * drain, 1);
  const double solid = report_of({"--material", "bluecast-x10"})["grams"];
  EXPECT_NEAR(report["grams"].get<double>() / solid, volume / 3200, 1e-4);
  EXPECT_FALSE(report_of({}).contains("hollow"));
}

TEST_F(Hollow, BadValuesAreRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes =
      {
          {{"--hollow", "0"},
           "--hollow: must be a wall of 0.1 mm or more, not 0"},
          {{"--hollow", "-1"},
           "--hollow: must be a wall of 0.1 mm or more, not -1"},
          {{"--hollow", "x"},
           "--hollow: a number was expected, such as 0.05, without a unit, not "
           "'x'"},
          {{"--hollow", "nan"},
           "--hollow: a number was expected, such as 0.05, without a unit, not "
           "'nan'"},
          {{"--hollow", "1", "--drain", "0.1"},
           "--drain: expected a diameter of 0.3 to 20 mm, X,Y,Z,DIAMETER or "
           "none, not '0.1'"},
          {{"--hollow", "1", "--drain", "1,2"},
           "--drain: expected a diameter of 0.3 to 20 mm, X,Y,Z,DIAMETER or "
           "none, not '1,2'"},
          {{"--hollow", "1", "--drain", "1,1,1,x"},
           "--drain: expected a diameter, X,Y,Z,DIAMETER or none, not "
           "'1,1,1,x'"},
          {{"--drain", "1"},
           "--hollow-closing, --drain and --drain-plug need --hollow"},
          {{"--drain-plug"},
           "--hollow-closing, --drain and --drain-plug need --hollow"},
          {{"--hollow", "1", "--drain", "none", "--drain", "1"},
           "--drain none goes with no other --drain"},
          {{"--hollow", "1", "--drain-plug", "--drain", "none"},
           "--drain-plug needs drains, not --drain none"},
          {{"--hollow", "1", "--drain", "5,5,10,1", "--axis", "auto"},
           "--drain X,Y,Z,D needs an axis, not --axis auto"},
          {{"--hollow", "1", "--heights", "1,2"},
           "--hollow needs layers, not --heights"},
      };
  for (const auto& [options, message] : mistakes) {
    const auto result = slice(options);
    EXPECT_EQ(result.status, 2) << message;
    EXPECT_EQ(result.errors, "lamina: " + message +
                                 "\nRun 'lamina --help' for the options.\n");
  }
  EXPECT_EQ(folder_.entry_count(), 1U);
}

TEST_F(Hollow, AFlatDesignWarns) {
  folder_.write("flat.scad", "square(4);\n");
  const auto made = run(folder_, {"flat.scad", "--hollow", "1", "-o", "f.svg"});
  EXPECT_EQ(made.status, 0);
  EXPECT_TRUE(
      has(made.errors, "warning: --hollow needs a solid; the design is flat\n"))
      << made.errors;
}

TEST_F(Hollow, StrictRunsMustHollow) {
  EXPECT_EQ(slice({"--hollow", "9"}).status, 0);
  const auto strict = slice({"--hollow", "9", "--strict"});
  EXPECT_EQ(strict.status, 1);
  EXPECT_TRUE(has(strict.errors,
                  "error: not written: 1 warning (first: nothing is hollowed: "
                  "no place is farther than 9 mm from the surface)"))
      << strict.errors;
}

// Like all lengths of options: those of the print.
TEST_F(Hollow, TheWallIsThatOfThePrint) {
  const json report = report_of(
      {"--hollow", "1", "--scale", "2", "--drain", "none", "--layer", "0.1"});
  EXPECT_NEAR(report["hollow"]["saved_mm3"], 38 * 30 * 18, 1e-2);
  EXPECT_NEAR(report["volume_mm3"], 40 * 32 * 20 - 38 * 30 * 18, 1e-2);
}

TEST_F(Hollow, SupportsHoldItInsideToo) {
  const auto findings_of = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--hollow", "1", "--supports"});
    return report_of(std::move(options))["print"];
  };
  const json print = findings_of({});
  for (const char* const kind :
       {"island", "loose part", "resin trap", "suction cup", "overhang"}) {
    EXPECT_EQ(count_of(print, kind), 0U) << kind << print.dump(1);
  }
  // The supports are found for the part in the design's own size, and its
  // drains are where they are in the print.
  const json larger = findings_of({"--scale", "2", "--layer", "0.1", "--drain",
                                   "10,0,2,2", "--drain", "10,16,8,2"});
  for (const char* const kind : {"island", "loose part", "resin trap"}) {
    EXPECT_EQ(count_of(larger, kind), 0U) << kind << larger.dump(1);
  }
}

TEST_F(Hollow, PlacesOfDrainsAreThoseOfTheDesign) {
  for (const std::string axis : {"z", "x", "-y"}) {
    for (const std::string scale : {"1", "2"}) {
      const json report =
          report_of({"--hollow", "1", "--drain", "10,8,10,1", "--axis", axis,
                     "--scale", scale, "--layer", "0.1"});
      const json& drains = report["hollow"]["drains"];
      ASSERT_EQ(drains.size(), 1U) << axis << scale;
      // It goes through the wall of z = 10.
      const json& from = drains[0]["from"];
      const json& to = drains[0]["to"];
      const std::size_t along = axis == "z" ? 2 : 1;
      for (std::size_t i = 0; i < 3; ++i) {
        const double length =
            std::abs(from[i].get<double>() - to[i].get<double>());
        if (i == along) {
          EXPECT_GT(length, 0.9) << axis << scale << drains;
        } else {
          EXPECT_LT(length, 0.2) << axis << scale << drains;
        }
      }
    }
  }
}

TEST_F(Hollow, AFarDrainIsWarnedOf) {
  const auto made =
      slice({"--hollow", "1", "--drain", "90,8,5,1", "--drain", "10,8,10,1"});
  EXPECT_EQ(made.status, 0);
  EXPECT_TRUE(has(made.errors, "warning: the drain at 90, 8, 5 is 71"))
      << made.errors;
  EXPECT_TRUE(has(made.errors, "; 1 drain of 1 mm\n")) << made.errors;
}

TEST_F(Hollow, OtherCommandsTakeIt) {
  const auto checked = run(folder_, {"check", "a.scad", "--hollow", "1",
                                     "--drain", "none", "--json"});
  EXPECT_EQ(count_of(json::parse(checked.output), "resin trap"), 1U)
      << checked.output;
  EXPECT_EQ(run(folder_,
                {"view", "a.scad", "--hollow", "1", "--at", "5", "-o", "a.png"})
                .status,
            0);
  folder_.write("b.scad", "h = 10; cube([20, 16, h]);\n");
  folder_.write("t.csv", "name,h\nlow,10\nhigh,20\nthin,1\n");
  const auto batch =
      run(folder_, {"batch", "b.scad", "--table", "t.csv", "-o", "{name}.slc",
                    "--hollow", "1", "--report", "r.json"});
  EXPECT_EQ(batch.status, 1);
  EXPECT_TRUE(has(batch.errors, "t.csv:4: thin: warning: nothing is hollowed"))
      << batch.errors;
  const json pieces = json::parse(read_file(folder_.file("r.json")))["pieces"];
  EXPECT_NEAR(pieces[0]["report"]["hollow"]["saved_mm3"], kCavity, 1e-3);
  EXPECT_NEAR(pieces[1]["report"]["hollow"]["saved_mm3"], 18 * 14 * 18, 1e-3);
}

TEST_F(Hollow, IsTheSameForAnyNumberOfThreads) {
  folder_.write("a.scad",
                "cylinder(r = 6, h = 9, $fn = 60);\n"
                "translate([0, 0, 8]) cube([9, 4, 7], center = true);\n");
  std::vector<std::string> bytes;
  for (const std::string threads : {"1", "4"}) {
    ASSERT_EQ(slice({"--hollow", "0.8", "--drain-plug", "--supports", "-q",
                     "--threads", threads})
                  .status,
              0);
    bytes.push_back(read_file(folder_.file("a.slc")));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

}  // namespace
}  // namespace lamina::cli
