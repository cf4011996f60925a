// Supports, as a user of the program meets them.

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

const char* const kTable =
    "translate([0, 0, 8])\n  cube([14, 14, 2]);\ncube([3, 3, 9]);\n";

TEST(SupportsCommand, WritesADesignThatNamesTheLinesItHolds) {
  const TemporaryFolder folder;
  folder.write("table.scad", kTable);
  const auto made = run(folder, {"supports", "table.scad", "-o", "held.scad"});
  EXPECT_EQ(made.status, 0) << made.errors;
  const std::string text = read_file(folder.file("held.scad"));
  EXPECT_TRUE(has(text, "include <table.scad>\n")) << text;
  EXPECT_TRUE(has(text, "]);  // table.scad:2:3\n")) << text;
  // What a user edits is still known as supports.
  const auto checked = run(folder, {"check", "held.scad", "--json"});
  const json supports = json::parse(checked.output)["supports"];
  EXPECT_GT(supports["volume_mm3"], 0);
  for (const json& contact : supports["contacts"]) {
    const std::string place = contact["made_by"][0]["place"];
    EXPECT_TRUE(place.starts_with("table.scad:")) << place;
  }
  std::size_t lines = 0;
  for (std::size_t at = text.find("\n  support_of(["); at != std::string::npos;
       at = text.find("\n  support_of([", at + 1)) {
    ++lines;
  }
  EXPECT_EQ(supports["contacts"].size(), lines);
}

// The file of lines and the option make the same layers.
TEST(SupportsCommand, MakesTheLayersOfTheOption) {
  const TemporaryFolder folder;
  folder.write("table.scad", kTable);
  ASSERT_EQ(run(folder, {"supports", "table.scad", "-o", "held.scad",
                         "--supports=light,raft"})
                .status,
            0);
  ASSERT_EQ(run(folder, {"held.scad", "-q", "-o", "a.slc"}).status, 0);
  ASSERT_EQ(
      run(folder, {"table.scad", "--supports=light,raft", "-q", "-o", "b.slc"})
          .status,
      0);
  EXPECT_EQ(run(folder, {"compare", "a.slc", "b.slc"}).status, 0);
}

std::vector<double> places_of(const TemporaryFolder& folder,
                              std::vector<std::string> options) {
  options.insert(options.begin(), {"table.scad", "--supports"});
  const json report = report_of(folder, options);
  std::vector<double> places;
  if (!report["supports"].contains("contacts")) return places;
  for (const json& contact : report["supports"]["contacts"]) {
    places.push_back(contact["x"]);
  }
  return places;
}

TEST(SupportLines, DecideWhatIsHeld) {
  const TemporaryFolder folder;
  folder.write("lib.scad", "module shelf() cube([10, 10, 2]);\n");
  folder.write("table.scad",
               "use <lib.scad>\n"
               "translate([0, 0, 8]) shelf();\n"
               "translate([20, 0, 8]) shelf();\n");
  const auto only = [](const std::vector<double>& places, bool is_left) {
    bool is_so = !places.empty();
    for (const double x : places) is_so = is_so && (x < 15) == is_left;
    return is_so;
  };
  EXPECT_TRUE(only(places_of(folder, {"--support-on", "2"}), true));
  EXPECT_TRUE(only(places_of(folder, {"--no-support-on", "2"}), false));
  EXPECT_TRUE(
      only(places_of(folder, {"--no-support-on", "table.scad:3"}), true));
  EXPECT_TRUE(places_of(folder, {"--no-support-on", "lib.scad:1"}).empty());
  const json report = json::parse(read_file(folder.file("report.json")));
  EXPECT_EQ(report["supports"]["count"], 0);
  EXPECT_EQ(report["supports"]["unwanted"], 2);
}

TEST(SupportSizes, AreThoseOfTheMaterialWhereNoneAreGiven) {
  const TemporaryFolder folder;
  folder.write("table.scad", kTable);
  folder.write("wax.json",
               R"({"name": "wax", "density": 1, "support_tip_mm": 0.6})");
  const auto tip_of = [&](const std::string& supports) {
    const json report =
        report_of(folder, {"table.scad", supports, "--material", "wax.json"});
    return report["supports"]["tip_mm"].get<double>();
  };
  EXPECT_EQ(tip_of("--supports"), 0.6);
  EXPECT_EQ(tip_of("--supports=raft"), 0.6);
  EXPECT_EQ(tip_of("--supports=light"), 0.25);
}

TEST(SupportVariable, DecidesInTheDesign) {
  const TemporaryFolder folder;
  const auto held = [&](const std::string& text) {
    folder.write("table.scad", text);
    return places_of(folder, {});
  };
  // As an argument, as an assignment, and computed.
  for (const char* const right : {
           "translate([20, 0, 8]) cube([10, 10, 2], $support = \"none\");",
           "translate([20, 0, 8]) { $support = 0; cube([10, 10, 2]); }",
           "module part() cube([10, 10, 2]);\n"
           "translate([20, 0, 8]) part($support = 1 > 0 ? \"none\" : 1);",
       }) {
    const auto places =
        held(std::string("translate([0, 0, 8]) cube([10, 10, 2]);\n") + right);
    EXPECT_FALSE(places.empty()) << right;
    for (const double x : places) EXPECT_LT(x, 15) << right;
  }
}

TEST(SupportVariable, IsWarnedOfWhereItMeansNothing) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10, $support = \"strong\");\n");
  // It is the design's own as long as nobody asks for supports.
  EXPECT_EQ(run(folder, {"a.scad", "--strict", "-o", "a.slc"}).status, 0);
  const auto result = run(folder, {"a.scad", "--supports", "-o", "a.slc"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.errors,
                  "warning: $support is not \"none\", \"light\", \"medium\", "
                  "\"heavy\" or a number from 0.1 to 2, at a.scad:1:1"))
      << result.errors;
}

// Names of the design keep their meaning.
TEST(SupportsCommand, LeavesTheDesignAsItIs) {
  const TemporaryFolder folder;
  folder.write("own.scad",
               "support_tip = 5;\n"
               "module support_rod(from, to, d1, d2) translate(from) "
               "cube([4, 4, 8]);\n"
               "support_rod([0, 0, 0], [0, 0, 1], 1, 1);\n"
               "translate([10, 0, 6]) cube([6, 6, 1]);\n"
               "translate([20, 0, 0]) cube(support_tip);\n");
  const json report = report_of(folder, {"own.scad", "--supports"});
  EXPECT_NEAR(report["volume_mm3"].get<double>() -
                  report["supports"]["volume_mm3"].get<double>(),
              128 + 36 + 125, 1e-3);
}

TEST(SupportsCommand, JudgesTheWrittenDesignAsItsMaker) {
  const TemporaryFolder folder;
  folder.write("ball.scad", "sphere(5, $fn = 60);\n");
  ASSERT_EQ(run(folder, {"supports", "ball.scad", "--supports=heavy", "-o",
                         "held.scad"})
                .status,
            0);
  EXPECT_EQ(run(folder, {"check", "held.scad"}).status, 0);
  // It has them now.
  const auto again = run(folder, {"supports", "held.scad", "-o", "twice.scad"});
  EXPECT_EQ(again.status, 1);
  EXPECT_TRUE(has(again.errors, "The design has supports already"))
      << again.errors;
}

TEST(SupportsCommand, FailsWhereTheDesignForbidsWhatItNeeds) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10, $support = \"none\");\n");
  const auto result = run(folder, {"supports", "a.scad", "-o", "b.scad"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors,
                  "needs a support, but the design or an option forbids it"))
      << result.errors;
}

TEST(SupportLines, AreRefusedWhereTheyMeanNothing) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);\n");
  const auto errors_of = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"a.scad", "-o", "a.slc"});
    return run(folder, options).errors;
  };
  EXPECT_TRUE(has(errors_of({"--supports", "--support-on", "a"}),
                  "expected lines such as 12 or lib.scad:12, not 'a'"));
  EXPECT_TRUE(has(errors_of({"--support-on", "1"}), "need --supports"));
  EXPECT_TRUE(has(errors_of({"--supports", "--no-support-on", "9"}),
                  "no solid comes from line a.scad:9"));
  EXPECT_TRUE(has(errors_of({"--supports=light,heavy"}),
                  "there are two sizes in 'light,heavy'"));
  EXPECT_TRUE(has(errors_of({"--supports=thick"}),
                  "expected light, medium, heavy or 0.1 to 2 (mm), and ,raft "
                  "for a raft; got 'thick'"));
}

TEST(Supports, AreRefusedToWhatNoPrinterBuilds) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([1500, 20, 1]);\n");
  const auto result = run(folder, {"a.scad", "--supports", "-o", "a.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(
      has(result.errors, "The design is 1500 x 20 mm, too wide for supports"))
      << result.errors;
}

// Tips are enlarged with the print, and so is what they hold.
TEST(Supports, HoldAnEnlargedPrint) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "cube([4, 4, 12]); translate([0, 0, 10]) cube([20, 12, 2]);");
  for (const char* scale : {"1", "1.5", "2"}) {
    const auto result =
        run(folder, {"a.scad", "-o", "a.slc", "--supports", "--scale", scale,
                     "--fail-on", "islands,overhangs"});
    EXPECT_EQ(result.status, 0) << result.errors;
  }
}

}  // namespace
}  // namespace lamina::cli
