// lamina sprue, --sprue and lamina tree.

#include <cmath>
#include <filesystem>
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

// Two balls on a rod that freezes first.
constexpr const char* kDumbbell =
    "for (x = [-8, 8]) translate([x, 0, 0]) sphere(3, $fn = 64);\n"
    "rotate([0, 90, 0]) cylinder(r = 1, h = 16, center = true, $fn = 64);\n";

bool exists(const TemporaryFolder& folder, const std::string& name) {
  return std::filesystem::exists(folder.file(name));
}

TEST(Sprue, WritesADesignThatIsFed) {
  const TemporaryFolder folder;
  folder.write("a.scad", kDumbbell);
  const auto result = run(folder, {"sprue", "a.scad", "-o", "b.scad"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.errors, "2 sprues")) << result.errors;
  EXPECT_TRUE(has(result.errors, "with them: all is fed from the root"));
  EXPECT_TRUE(has(result.errors, "a.scad:1:40"));
  const std::string text = read_file(folder.file("b.scad"));
  EXPECT_TRUE(text.starts_with("include <a.scad>\n"));
  // The run that adds them itself makes the same bytes.
  ASSERT_EQ(run(folder, {"b.scad", "-o", "b.slc"}).status, 0);
  ASSERT_EQ(run(folder, {"a.scad", "--sprue", "-o", "a.slc"}).status, 0);
  EXPECT_EQ(read_file(folder.file("a.slc")), read_file(folder.file("b.slc")));
  // Preflight sees it, too, and takes the root for the gate.
  EXPECT_EQ(run(folder, {"preflight", "a.scad", "--metal", "sterling-silver",
                         "-o", "a.json"})
                .status,
            0);
  EXPECT_EQ(json::parse(read_file(folder.file("a.json")))["unfed"].size(), 1U);
  run(folder,
      {"preflight", "b.scad", "--metal", "sterling-silver", "-o", "b.json"});
  EXPECT_TRUE(json::parse(read_file(folder.file("b.json")))["unfed"].empty());
  // A second set of sprues is not what one means.
  EXPECT_EQ(run(folder, {"sprue", "b.scad", "-o", "c.scad"}).status, 1);
}

// Options that would change nothing about what is written.
TEST(Sprue, RefusesWhatItHasNoUseFor) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(5);");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--scale", "1.02"},
                                             {"--layer", "0.1"},
                                             {"--orient", "1,0,1"},
                                             {"--compensate", "0.1"},
                                             {"--hollow", "1"}}) {
    std::vector<std::string> sprue = {"sprue", "a.scad", "-o", "b.scad"};
    std::vector<std::string> tree = {"tree",   "a.scad",  "-o",
                                     "b.scad", "--flask", "80,100"};
    for (std::vector<std::string>* const all : {&sprue, &tree}) {
      all->insert(all->end(), words.begin(), words.end());
      const auto result = run(folder, *all);
      EXPECT_EQ(result.status, 2) << words[0];
      EXPECT_TRUE(has(result.errors, "not expected: " + words[0]))
          << result.errors;
    }
  }
}

TEST(Sprue, IsReportedAndSized) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(5);");
  const json plain = report_of(folder, {"a.scad"});
  const json sprued = report_of(folder, {"a.scad", "--sprue=7,9,disc"});
  EXPECT_FALSE(plain.contains("sprues"));
  const json& sprues = sprued["sprues"];
  EXPECT_EQ(sprues["root_diameter_mm"], 7);
  EXPECT_EQ(sprues["sprues"].size(), 1U);
  EXPECT_NEAR(sprues["sprues"][0]["feeds_mm3"].get<double>(), 125, 4);
  EXPECT_TRUE(sprues["unfed"].empty());
  const double added =
      sprued["volume_mm3"].get<double>() - plain["volume_mm3"].get<double>();
  EXPECT_NEAR(sprues["volume_mm3"].get<double>(), added, 0.04 * added);
  // It comes out of one of the sides.
  double beyond = -1;
  for (const json& at : sprues["sprues"][0]["exit"]) {
    beyond = std::max({beyond, at.get<double>() - 5, -at.get<double>()});
  }
  EXPECT_NEAR(beyond, 0, 0.1);
}

// Of the examples, which have small heavy places where wires cross; what is
// seen of a ring stays whole.
TEST(Sprue, FindsAWayInAllExamples) {
  const TemporaryFolder folder;
  for (const char* name : {"solitaire", "eternity", "signet", "hoop", "pendant",
                           "filigree", "braid", "medal"}) {
    const std::string design = LAMINA_EXAMPLES + ("/" + std::string(name));
    const auto result =
        run(folder, {"sprue", design + ".scad", "-o", "a.scad"});
    EXPECT_EQ(result.status, 0) << name << result.errors;
    EXPECT_FALSE(has(result.errors, "warning")) << name << result.errors;
    if (std::string(name) == "signet") {
      EXPECT_TRUE(has(result.errors, "all is fed from the root"));
    }
  }
}

// Supports hold sprues as well, and scales enlarge them.
TEST(Sprue, GoesWithSupportsScalesAndDirections) {
  const TemporaryFolder folder;
  folder.write("a.scad", kDumbbell);
  const json report =
      report_of(folder, {"a.scad", "--sprue", "--supports", "--scale", "1.02",
                         "--orient", "1,0,1", "--layer", "0.1"});
  EXPECT_EQ(report["sprues"]["sprues"].size(), 2U);
  EXPECT_GT(report["supports"]["count"].get<int>(), 0);
  EXPECT_EQ(report["supports"]["unheld"], 0);
}

TEST(Sprue, RefusesWhatHasNoWayOutOrNoVolume) {
  const TemporaryFolder folder;
  folder.write("flat.scad", "square(5);");
  folder.write(
      "shell.scad",
      "$fn = 48; difference() { sphere(10); sphere(9.5); } sphere(5);");
  folder.write("wrong.scad", "cube(;");
  folder.write("tiny.scad", "cube(1e-5);");
  for (const char* design : {"flat", "shell", "wrong", "tiny"}) {
    const auto result =
        run(folder, {"sprue", std::string(design) + ".scad", "-o", "o.scad"});
    EXPECT_EQ(result.status, 1) << design;
    EXPECT_FALSE(result.errors.empty());
    EXPECT_FALSE(exists(folder, "o.scad")) << design;
  }
  folder.write("a.scad", "cube(5);");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{
           {"sprue", "a.scad", "-o", "o.slc"},
           {"a.scad", "--sprue=0.1"},
           {"a.scad", "--sprue=4,8,9"},
           {"a.scad", "--sprue=thick"},
           {"a.scad", "--sprue", "--hollow", "1"},
           {"a.scad", "--scale", "1,2"},
           {"a.scad", "--scale", "1,1,2", "--axis", "auto"},
           {"tree", "a.scad", "-o", "t.scad"},
           {"tree", "a.scad", "-o", "t.scad", "--flask", "20,20"},
           {"tree", "a.scad", "-o", "t.scad", "--flask", "80"},
           {"tree", "a.scad", "-o", "t.slc", "--flask", "80,100"},
           {"tree", "a.scad", "-o", "{name}.scad", "--flask", "80,100"},
           {"tree", "-o", "t.scad", "--flask", "80,100"},
       }) {
    EXPECT_EQ(run(folder, words).status, 2) << words.back();
  }
}

// Every piece is there once, and the written tree slices to what was told,
// but for where its rods meet.
TEST(Tree, WritesADesignWithAllPieces) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 5; cube([size, 4, 8]);");
  folder.write("orders.csv",
               "name,design,quantity,size\nAda,a.scad,2,5\nBo,a.scad,1,8\n");
  const auto result =
      run(folder, {"tree", "--table", "orders.csv", "--flask", "80,100", "-o",
                   "tree.scad", "--metal", "sterling-silver"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.errors, "3 pieces on a trunk")) << result.errors;
  EXPECT_TRUE(has(result.errors, "g of it pieces"));
  const std::string text = read_file(folder.file("tree.scad"));
  EXPECT_TRUE(has(text, "// Ada\nmodule piece_1()"));
  EXPECT_TRUE(has(text, "// Bo\nmodule piece_2()"));
  const json report = report_of(folder, {"tree.scad", "--layer", "0.1"});
  const std::size_t at = result.errors.find(" mm³");
  const std::size_t begin = result.errors.rfind(' ', at - 1);
  const double told =
      std::stod(result.errors.substr(begin + 1, at - begin - 1));
  EXPECT_NEAR(report["volume_mm3"].get<double>(), told, 0.06 * told);
  // No piece leaves the flask's walls.
  EXPECT_LE(report["box_mm"]["high"][0].get<double>(), 30.0);
  EXPECT_LE(report["box_mm"]["high"][2].get<double>(), 85.0);
}

TEST(Tree, WeighsThePieces) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  const auto result = run(folder, {"tree", "a.scad", "--flask", "80,110", "-o",
                                   "t.scad", "--metal", "sterling-silver"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.errors, ", 10.36 g of it pieces")) << result.errors;
  for (const char* other : {"unobtainium", "bluecast-x10"}) {
    EXPECT_EQ(run(folder, {"tree", "a.scad", "--flask", "80,110", "-o",
                           "u.scad", "--metal", other})
                  .status,
              1);
    EXPECT_FALSE(exists(folder, "u.scad"));
  }
}

TEST(Tree, TakesTheNextFlaskWhereOneIsFull) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([8, 6, 12]);");
  const std::vector<std::string> words = {"tree", "a.scad",      "--copies",
                                          "30",   "--flask",     "80,90",
                                          "-o",   "t{tree}.scad"};
  const auto result = run(folder, words);
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(exists(folder, "t1.scad"));
  EXPECT_TRUE(exists(folder, "t2.scad"));
  auto one = words;
  one.back() = "t.scad";
  EXPECT_EQ(run(folder, one).status, 2);
  EXPECT_FALSE(exists(folder, "t.scad"));
  folder.write("a.scad", "cube(60);");
  const auto large = run(folder, words);
  EXPECT_EQ(large.status, 1);
  EXPECT_TRUE(has(large.errors, "does not fit a flask")) << large.errors;
}

}  // namespace
}  // namespace lamina::cli
