// Supports, as a user of the program meets them.

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"
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
  for (std::size_t at = text.find("\nsupport_of(["); at != std::string::npos;
       at = text.find("\nsupport_of([", at + 1)) {
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
  options.insert(options.begin(), {"table.scad", "--supports", "-q", "-o",
                                   "x.slc", "--report", "x.json"});
  EXPECT_EQ(run(folder, options).status, 0);
  const json report = json::parse(read_file(folder.file("x.json")));
  std::vector<double> places;
  if (!report.contains("supports")) return places;
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

TEST(SupportVariable, IsWarnedOfWhereItIsNone) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10, $support = \"strong\");\n");
  const auto result = run(folder, {"a.scad", "-o", "a.slc"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.errors,
                  "a.scad:1:1: warning: $support is \"strong\"; expected "
                  "\"none\", \"light\", \"medium\", \"heavy\" or a number from "
                  "0.1 to 2"))
      << result.errors;
}

}  // namespace
}  // namespace lamina::cli
