// lamina check, and what runs say of the print.

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
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

const char* const kFloating = "cube(10);\ntranslate([20, 0, 5]) cube(4);\n";

TEST(Check, EndsWellWhereNothingGoesWrong) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  const auto result = run(folder, {"check", "a.scad"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(
      result.output,
      "print: no problems found\npeel: largest cured area 100 mm² (layer 1)\n");
}

TEST(Check, NamesTheLineOfAnIsland) {
  const TemporaryFolder folder;
  folder.write("a.scad", kFloating);
  const auto result = run(folder, {"check", "a.scad"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.output, "print: 1 loose part\n")) << result.output;
  EXPECT_TRUE(has(result.output,
                  "64 mm³, 16 mm² at most\n      by "
                  "a.scad:2:23\n"))
      << result.output;
}

TEST(Check, NamesAWeakBond) {
  const TemporaryFolder folder;
  const auto overhang = [&](const std::string& text) {
    folder.write("a.scad", text);
    const auto result = run(folder, {"check", "a.scad", "--json"});
    const json print = json::parse(result.output);
    for (const json& finding : print["findings"]) {
      if (finding["kind"] == "overhang") return finding;
    }
    return json();
  };
  // 121 mm² on 1 mm², 121 mm² on 49 mm², and a beam that is held at both ends.
  const json weak =
      overhang("cube([1, 1, 6]); translate([-5, -5, 5]) cube([11, 11, 1]);");
  EXPECT_TRUE(weak["is_weak"]);
  EXPECT_NEAR(weak["bond"].get<double>(), 1 / 121.0, 1e-6);
  EXPECT_TRUE(has(run(folder, {"check", "a.scad"}).output,
                  "1 % of its layer holds it"));
  const json held =
      overhang("cube([7, 7, 6]); translate([0, 0, 5]) cube([11, 11, 1]);");
  EXPECT_FALSE(held["is_weak"]);
  EXPECT_NEAR(held["bond"].get<double>(), 49 / 121.0, 1e-6);
  EXPECT_FALSE(
      overhang("cube([7, 4, 6]); translate([14, 0, 0]) "
               "cube([7, 4, 6]); translate([0, 0, 5]) "
               "cube([21, 4, 1]);")["is_weak"]);
}

TEST(Check, FailsOnWhatItIsTold) {
  const TemporaryFolder folder;
  folder.write("a.scad", kFloating);
  const auto status = [&](const std::string& kinds) {
    return run(folder, {"check", "a.scad", "--fail-on", kinds}).status;
  };
  EXPECT_EQ(status("loose-parts"), 1);
  EXPECT_EQ(status("islands,loose-parts"), 1);
  EXPECT_EQ(status("all"), 1);
  EXPECT_EQ(status("islands,overhangs"), 0);
}

TEST(Check, KeepsAPrintThatWouldFailFromBeingWritten) {
  const TemporaryFolder folder;
  folder.write("a.scad", kFloating);
  const auto result = run(
      folder, {"a.scad", "-o", "a.slc", "--fail-on", "islands,loose-parts"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors, "error: not written: 1 loose part (--fail-on)\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.slc")));
  EXPECT_EQ(
      run(folder, {"a.scad", "-o", "a.slc", "--fail-on", "islands"}).status, 0);
  EXPECT_EQ(
      run(folder, {"a.scad", "--layers", "1:3", "--fail-on", "all"}).status, 2);
}

TEST(Check, SaysTheSameOfAFileAndOfItsDesign) {
  const TemporaryFolder folder;
  folder.write("a.scad", kFloating);
  const json of_design =
      json::parse(run(folder, {"check", "a.scad", "--json"}).output);
  for (const std::string format :
       {"slc", "cli", "svg", "slices.3mf", "layers.json"}) {
    ASSERT_EQ(run(folder, {"a.scad", "-q", "-o", "a." + format}).status, 0);
    const auto result = run(folder, {"check", "a." + format, "--json"});
    EXPECT_EQ(result.status, 1) << format;
    const json of_file = json::parse(result.output);
    ASSERT_EQ(of_file.at("findings").size(), of_design.at("findings").size());
    for (std::size_t i = 0; i < of_file.at("findings").size(); ++i) {
      const json& mine = of_file.at("findings")[i];
      const json& other = of_design.at("findings")[i];
      EXPECT_EQ(mine.at("kind"), other.at("kind")) << format;
      EXPECT_EQ(mine.at("first_layer"), other.at("first_layer")) << format;
      EXPECT_EQ(mine.at("last_layer"), other.at("last_layer")) << format;
    }
  }
}

TEST(Check, IsInSummariesReportsAndInspections) {
  const TemporaryFolder folder;
  folder.write("a.scad", kFloating);
  const auto result = run(folder, {"a.scad", "--report", "a.json"});
  EXPECT_TRUE(has(result.errors,
                  "print: 1 loose part; for where, run:\n"
                  "  lamina check a.scad\n"))
      << result.errors;
  const json report = json::parse(read_file(folder.file("a.json")));
  EXPECT_EQ(report.at("print").at("findings")[0].at("kind"), "loose part");
  EXPECT_EQ(report.at("print").at("findings")[0].at("made_by")[0].at("place"),
            "a.scad:2:23");
  EXPECT_EQ(report.at("print").at("peel").at("jump_layer"), 101);
  EXPECT_TRUE(
      has(run(folder, {"inspect", "a.slc"}).output, "print: 1 loose part\n"));
}

// The run's own words, as a shell takes them.
TEST(Check, IsNamedWithTheOptionsOfTheRun) {
  const TemporaryFolder folder;
  folder.write("a b.scad",
               "size = 1; cube(10); translate([20, 0, 5]) cube(4);");
  const auto result =
      run(folder, {"a b.scad", "-o", "x/a.slc", "-D", "size=[1, 2]", "--layer",
                   "0.1", "--place-on-bed", "--printer", "elegoo-mars-3"});
  for (const char* const words :
       {"\n  lamina check 'a b.scad' ", " -D 'size=[1, 2]'", " --layer 0.1",
        " --place-on-bed", " --printer elegoo-mars-3"}) {
    EXPECT_TRUE(has(result.errors, words)) << words << '\n' << result.errors;
  }
  EXPECT_FALSE(has(result.errors, "check 'a b.scad' -o")) << result.errors;
}

TEST(Check, SaysWhatFitsWhatItTakesAndWhatIsThin) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  folder.write("b.scad", "cube([1, 10, 400]); cube([10, 0.2, 5]);");
  const auto result =
      run(folder, {"check", "a.scad", "b.scad", "--printer", "elegoo-mars-3",
                   "--material", "gold-18k-yellow", "--min-feature", "0.5"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(
      has(result.output, "a.scad\nfits: 10 x 10 x 10 mm on Elegoo Mars 3\n"))
      << result.output;
  EXPECT_TRUE(has(result.output, "b.scad\ndoes not fit: The design is "))
      << result.output;
  EXPECT_TRUE(has(result.output, "1 wall")) << result.output;
  EXPECT_EQ(folder.entry_count(), 2U);
  EXPECT_EQ(
      run(folder, {"check", "a.scad", "--printer", "elegoo-mars-3"}).status, 0);
}

// A row for each source line, then one for what is left; 80 columns.
TEST(Check, ListsTheWorstFirst) {
  const TemporaryFolder folder;
  folder.write(
      "a.scad",
      "cube([200, 10, 1]); for (i = [1 : 12]) translate([10 * i, 0, 5])"
      "cube([2, 2, i]);");
  ASSERT_EQ(run(folder, {"a.scad", "-q", "-o", "a.slc"}).status, 0);
  const std::string of_design = run(folder, {"check", "a.scad"}).output;
  EXPECT_TRUE(has(of_design, " 12 loose parts   101-340 ")) << of_design;
  EXPECT_TRUE(has(of_design, "greatest in 101: 48 mm³")) << of_design;
  const std::string of_file = run(folder, {"check", "a.slc"}).output;
  EXPECT_LT(of_file.find(" 48 mm³"), of_file.find(" 44 mm³")) << of_file;
  EXPECT_TRUE(has(of_file, " 7 loose parts   101-240 ")) << of_file;
  std::istringstream lines(of_file + of_design);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(
        std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }),
        80)
        << line;
  }
}

// Its area is the same in all layers, but for rounding.
TEST(Check, EveryCommandSaysWhatAFileHoldsBesideContours) {
  const TemporaryFolder folder;
  folder.write("a.svg",
               "<svg><g slic3r:z=\"0.5\"><polygon slic3r:type=\"contour\" "
               "points=\"0,0 9,0 9,9 0,9\"/><circle r=\"1\"/></g></svg>");
  const std::vector<std::string> commands[] = {{"check", "a.svg"},
                                               {"inspect", "a.svg"},
                                               {"view", "a.svg", "-o", "a.png"},
                                               {"compare", "a.svg", "a.svg"}};
  for (const std::vector<std::string>& words : commands) {
    const auto result = run(folder, words);
    EXPECT_EQ(result.status, 0) << words[0] << result.errors;
    EXPECT_TRUE(has(result.output + result.errors, "1 circle element"))
        << words[0] << result.output << result.errors;
  }
}

TEST(Check, APrismThatLeansHasNoJump) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "multmatrix([[1, 0, 0.37, 0], [0, 1, 0.21, 0], [0, 0, 1, 0]])"
               " cylinder(r = 5, h = 10, $fn = 50);");
  const auto result = run(folder, {"check", "a.scad"});
  EXPECT_TRUE(has(result.output, "peel: ")) << result.output;
  EXPECT_FALSE(has(result.output, "largest jump")) << result.output;
}

TEST(Machine, APartThatDoesNotFitIsAnError) {
  const TemporaryFolder folder;
  folder.write("a.scad", "$fn = 40; cylinder(r = 2, h = 500);");
  for (const std::string output : {"a.sl1", "a.slc"}) {
    const auto result =
        run(folder, {"a.scad", "-o", output, "--printer", "prusa-sl1"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(
        has(result.errors,
            "error: The design is 4 x 4 x 500 mm, larger than what prusa-sl1 "
            "builds: 120.96 x 68.04 x 150 mm; lamina knows no printer that "
            "is large enough\n"))
        << result.errors;
    EXPECT_EQ(folder.entry_count(), 1U);
  }
}

TEST(Machine, WarnsOfArchivesAndExposuresForOthers) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  const auto archive =
      run(folder, {"a.scad", "-o", "a.sl1", "--printer", "elegoo-mars-3"});
  EXPECT_EQ(archive.status, 0);
  EXPECT_TRUE(has(archive.errors,
                  "warning: an .sl1 archive for elegoo-mars-3 is for programs "
                  "that convert it, such as UVtools: the printer does not read "
                  "it\n"))
      << archive.errors;
  const auto exposure = run(folder, {"a.scad", "-o", "b.sl1", "--layer", "0.07",
                                     "--material", "prusa-orange-tough"});
  EXPECT_TRUE(has(exposure.errors,
                  "warning: the exposure of Prusa Orange Tough is for layers "
                  "of 0.05 mm; a profile of your own can have yours\n"))
      << exposure.errors;
}

// In 80 columns, and in full on request.
TEST(Machine, IsListed) {
  const TemporaryFolder folder;
  const std::string printers = run(folder, {"printers"}).output;
  const std::string materials = run(folder, {"materials"}).output;
  EXPECT_TRUE(has(printers, "elegoo-mars-3 ")) << printers;
  EXPECT_TRUE(has(materials, "sterling-silver ")) << materials;
  EXPECT_FALSE(has(printers, "UVtools")) << printers;
  std::istringstream lines(printers + materials);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(
        std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }),
        80)
        << line;
  }
  const auto some = run(folder, {"printers", "elegoo", "saturn4"});
  EXPECT_EQ(some.status, 0);
  EXPECT_EQ(std::ranges::count(some.output, '\n'), 4) << some.output;
  EXPECT_TRUE(has(some.output, "elegoo-saturn-4-ultra-16k ")) << some.output;
  const auto one = run(folder, {"printers", "mars", "3", "--all"});
  EXPECT_TRUE(has(one.output, "elegoo-mars-3: Elegoo Mars 3\n")) << one.output;
  EXPECT_TRUE(has(one.output, "source: UVtools")) << one.output;
  const auto none = run(folder, {"materials", "kryptonite"});
  EXPECT_EQ(none.status, 1);
  EXPECT_EQ(none.errors, "error: no name has 'kryptonite'\n");
}

// 1 cm³ of resin of 1.1 g/cm³ and of gold of 15.4 g/cm³.
TEST(Machine, PrintsInResinAndCastsInMetal) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  const auto result =
      run(folder, {"a.scad", "-o", "a.sl1", "--printer", "sl1s", "--material",
                   "liqcreate wax", "--metal", "gold 750", "--price", "300/l",
                   "--price", "60 EUR/g", "--report", "a.json"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.errors,
                  "\n1 ml of Liqcreate Wax Castable, 1.1 g, 0.30, cast in 15.4 "
                  "g of yellow gold 750 (18 k), 924.00 EUR, "))
      << result.errors;
  EXPECT_TRUE(has(result.errors, " on Original Prusa SL1S SPEED\n"))
      << result.errors;
  const json report = json::parse(read_file(folder.file("a.json")));
  EXPECT_EQ(report["material"], "liqcreate-wax-castable");
  EXPECT_EQ(report["metal"], "gold-18k-yellow");
  EXPECT_NEAR(report["metal_price"], 924, 1e-6);
  EXPECT_EQ(report["metal_currency"], "EUR");
  EXPECT_EQ(report["exposure_s"], 4.5);
  EXPECT_EQ(report["exposure_is_assumed"], false);
  EXPECT_TRUE(has(run(folder, {"a.scad", "-o", "b.slc", "--metal", "bronze",
                               "--material", "brass"})
                      .errors,
                  "error: 'brass' and 'bronze' are both metals"));
  EXPECT_TRUE(has(
      run(folder, {"a.scad", "-o", "b.slc", "--metal", "casting wax"}).errors,
      "Can't use metal 'casting wax': casting wax is not a metal"));
}

// A time that rests on an exposure that nobody found says so.
TEST(Machine, SaysThatAnExposureIsAssumed) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  const std::vector<std::string> words = {"a.scad", "-o", "a.goo", "--printer",
                                          "Elegoo Mars 4"};
  const auto result = run(folder, words);
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.errors,
                  "no exposure is known for a resin that --material names: 8 s "
                  "a layer and 35 s for the first are assumed\n"))
      << result.errors;
  EXPECT_TRUE(
      has(result.errors, "on Elegoo Mars 4 if a layer is exposed for 8 s\n"))
      << result.errors;
  const auto checked = run(folder, {"check", "a.scad", "--printer", "mars3"});
  EXPECT_TRUE(
      has(checked.output, "on Elegoo Mars 3 if a layer is exposed for 8 s\n"))
      << checked.output;
  folder.write("mine.json", R"({"name": "mine", "density": 1.1, "exposures":
      [{"exposure_s": 2.5, "printer": "elegoo-mars-4"}]})");
  auto with_mine = words;
  with_mine.insert(with_mine.end(), {"--material", "mine.json"});
  const auto known = run(folder, with_mine);
  EXPECT_FALSE(has(known.errors, "if a layer")) << known.errors;
  EXPECT_FALSE(has(known.errors, "assumed")) << known.errors;
}

TEST(Machine, OfContoursGetsContours) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  EXPECT_EQ(run(folder, {"a.scad", "-q", "--printer", "b9creator"}).status, 0);
  EXPECT_FALSE(read_file(folder.file("a.slc")).empty());
  const auto images =
      run(folder, {"a.scad", "-o", "a.goo", "--printer", "b9creator"});
  EXPECT_EQ(images.status, 1);
  EXPECT_TRUE(
      has(images.errors, "error: B9Creator has no panel to show images on"))
      << images.errors;
  EXPECT_EQ(run(folder, {"check", "a.scad", "--printer", "b9creator"}).status,
            0);
}

// A plate 0.5 mm thick is as thin however it lies. Upright, its layers show it.
TEST(Check, FindsThinPlatesThatNoLayerShows) {
  const TemporaryFolder folder;
  for (const auto& [turn, is_hidden] :
       {std::pair{"[0, 0, 0]", true}, std::pair{"[60, 0, 0]", false},
        std::pair{"[30, 0, 0]", true}, std::pair{"[90, 0, 0]", false}}) {
    folder.write("a.scad", "rotate(" + std::string(turn) +
                               ") cube([9, 7, 0.5], center = true);");
    const auto result = run(folder, {"check", "a.scad", "--min-feature", "0.7",
                                     "--fail-on", "islands"});
    EXPECT_EQ(has(result.output, "flat or leaning: 1 place"), is_hidden)
        << turn << result.output;
    EXPECT_EQ(has(result.output, "thinner than 0.7 mm: 1 wall"), !is_hidden)
        << turn << result.output;
    if (is_hidden) {
      EXPECT_EQ(result.status, 1);
      EXPECT_TRUE(has(result.output, "     wall  ")) << result.output;
    }
  }
  folder.write("a.scad", "cube([9, 7, 2]);");
  EXPECT_EQ(run(folder, {"check", "a.scad", "--min-feature", "0.7"}).status, 0);
  // A file has layers alone; a large part is not searched, and told so.
  EXPECT_FALSE(has(
      run(folder, {"check", "a.scad", "--min-feature", "0.7"}).output, "flat"));
  folder.write("a.scad", "cube([900, 700, 20]);");
  EXPECT_TRUE(
      has(run(folder, {"check", "a.scad", "--min-feature", "0.2"}).output,
          "not looked for"));
}

}  // namespace
}  // namespace lamina::cli
