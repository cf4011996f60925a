// lamina orient, and slicing as it says.

#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using nlohmann::json;
using support::has;
using support::read_file;
using support::TemporaryFolder;

// A T that lies flat with a thin foot: standing on its head nothing hangs.
constexpr const char* kTee =
    "translate([-10, -10, 10]) cube([20, 20, 2]); translate([-1, -1, 0]) "
    "cube([2, 2, 11]);";

json listed(const TemporaryFolder& folder, const std::string& design,
            const std::vector<std::string>& options = {}) {
  folder.write("a.scad", design);
  std::vector<std::string> words = {"orient",       "a.scad",  "-o",
                                    "o.json",       "--layer", "0.2",
                                    "--directions", "60"};
  words.insert(words.end(), options.begin(), options.end());
  const auto result = run(folder, words);
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(read_file(folder.file("o.json")));
}

TEST(Orient, ATableStandsOnItsHead) {
  const TemporaryFolder folder;
  const json found = listed(folder, kTee);
  EXPECT_EQ(found["judged"], 60 - (60 - 39) % 8) << found["judged"];
  const json& best = found["listed"][0];
  EXPECT_EQ(best["orient"], json({0.0, 0.0, -1.0}));
  EXPECT_EQ(best["contacts"], 0);
  EXPECT_EQ(best["contact_area_mm2"], 0.0);
  EXPECT_NEAR(best["height_mm"].get<double>(), 12, 1e-9);
  EXPECT_EQ(best["unheld"], 0);
  EXPECT_GT(found["drawn"]["contacts"], 5);
  EXPECT_NEAR(found["drawn"]["overhang_mm2"].get<double>(), 396, 60);
}

// No row of the list beats another one in everything.
TEST(Orient, ItsListIsAParetoFront) {
  const TemporaryFolder folder;
  const json found = listed(
      folder,
      "rotate([20, 35, 0]) difference() { cube([20, 14, 9], center = true); "
      "translate([0, 0, 3]) cube([12, 8, 9], center = true); }");
  const std::vector<std::string> figures = {
      "unheld",   "contact_area_mm2", "seen_area_mm2", "support_volume_mm3",
      "cups_mm3", "height_mm"};
  const json& rows = found["listed"];
  ASSERT_GE(rows.size(), 2U);
  for (const json& a : rows) {
    for (const json& b : rows) {
      bool is_no_worse = true;
      bool is_better = false;
      for (const std::string& figure : figures) {
        is_no_worse = is_no_worse && a[figure] <= b[figure];
        is_better = is_better || a[figure] < b[figure];
      }
      EXPECT_FALSE(is_no_worse && is_better) << a << b;
    }
    const auto& up = a["orient"];
    EXPECT_NEAR(std::hypot(up[0].get<double>(), up[1].get<double>(),
                           up[2].get<double>()),
                1, 2e-3);
  }
}

// The area of contacts and that on visible leaves, as drawn [mm²].
std::array<double, 2> drawn_areas(const std::string& design) {
  const TemporaryFolder folder;
  const json drawn = listed(folder, design)["drawn"];
  return {drawn["contact_area_mm2"], drawn["seen_area_mm2"]};
}

// All contacts are below the top of the table.
TEST(Orient, CountsContactsOnVisibleLeaves) {
  const std::string top = "translate([-10, -10, 10]) cube([20, 20, 2]";
  const std::string leg = "); translate([-1, -1, 0]) cube([2, 2, 11]";
  const auto [touched, seen] =
      drawn_areas(top + ", $visible = true" + leg + ");");
  EXPECT_GT(touched, 1);
  EXPECT_NEAR(seen, touched, 0.08);  // but for one below the leg
  EXPECT_LT(drawn_areas(top + leg + ", $visible = true);")[1], 0.08);
  EXPECT_EQ(drawn_areas(top + leg + ");")[1], 0);
  EXPECT_EQ(drawn_areas(top + leg + ", $visible = 0);")[1], 0);
  // Children inherit it, and it may be computed.
  const auto [all, all_seen] =
      drawn_areas("$visible = 1 < 2; union() { " + top + leg + "); }");
  EXPECT_DOUBLE_EQ(all, touched);
  EXPECT_DOUBLE_EQ(all_seen, all);
}

// A leaf that is subtracted makes the surface that it leaves.
TEST(Orient, CountsContactsOnWhatVisibleLeavesCutOut) {
  const auto areas = [](const std::string& visible) {
    return drawn_areas(
        "difference() { translate([-15, -4, 0]) cube([30, 8, "
        "14]); translate([-11, -5, -1]) cube([22, 10, 9]" +
        visible + "); }");
  };
  const auto [touched, seen] = areas(", $visible = true");
  EXPECT_GT(seen, 0.5);
  EXPECT_GT(touched, seen + 0.3);  // the feet of the bridge
  EXPECT_EQ(areas("")[1], 0);
}

TEST(Orient, NamesTheVisibleContactsOnlyWhereThereAreVisibleLeaves) {
  const TemporaryFolder folder;
  folder.write("a.scad", kTee);
  folder.write("b.scad", std::string("$visible = true; ") + kTee);
  const auto output = [&](const std::string& design) {
    return run(folder,
               {"orient", design, "--layer", "0.2", "--directions", "20"})
        .output;
  };
  EXPECT_FALSE(has(output("a.scad"), "seen"));
  EXPECT_TRUE(has(output("b.scad"), "seen mm²")) << output("b.scad");
}

TEST(Orient, TheSameListComesFromAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const json found = listed(folder, kTee);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(listed(folder, kTee), found);
}

TEST(Orient, APageHasAPictureOfEach) {
  const TemporaryFolder folder;
  folder.write("a.scad", kTee);
  const auto result = run(folder, {"orient", "a.scad", "-o", "o.html",
                                   "--layer", "0.2", "--directions", "20"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.output, "0,0,-1")) << result.output;
  EXPECT_TRUE(has(result.output, "0,0,1 (as drawn)"));
  const std::string page = read_file(folder.file("o.html"));
  EXPECT_TRUE(has(page, "<svg"));
  EXPECT_TRUE(has(page, "--orient 0,0,-1"));
}

double volume_of(const TemporaryFolder& folder,
                 const std::vector<std::string>& options) {
  std::vector<std::string> words = {"a.scad", "-o",      "a.slc", "--report",
                                    "r.json", "--layer", "0.05"};
  words.insert(words.end(), options.begin(), options.end());
  const auto result = run(folder, words);
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(read_file(folder.file("r.json")))["volume_mm3"];
}

TEST(Orient, AnyDirectionMayPointUp) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "difference() { cube([9, 7, 5]); translate([2, 2, 2]) "
               "sphere(3, $fn = 40); } intersection() { cylinder(r = 2, h = "
               "12, $fn = 30); translate([0, 0, 8]) cube(9, center = true); }");
  const double volume = volume_of(folder, {});
  for (const char* up :
       {"0,0,-1", "1,0,0", "0,-2,0", "1,1,1", "-0.3,0.2,0.9", "0.5,0.5,-3"}) {
    EXPECT_NEAR(volume_of(folder, {"--orient", up}), volume, 2e-3 * volume)
        << up;
  }
  EXPECT_NEAR(volume_of(folder, {"--orient", "1,0,0"}),
              volume_of(folder, {"--axis", "x"}), 1e-9);
  EXPECT_NEAR(volume_of(folder, {"--orient", "1,2,3", "--turn", "40"}),
              volume_of(folder, {"--orient", "1,2,3"}), 1e-6);
}

// Supports are lines of the design, which are turned with it.
TEST(Orient, SupportsHoldAPartThatLeans) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([12, 8, 4], center = true);");
  const auto result =
      run(folder, {"a.scad", "-o", "a.slc", "--supports", "--orient",
                   "0.4,0.3,0.86", "--fail-on", "islands,overhangs"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.errors, "supports: ")) << result.errors;
}

TEST(Orient, BestIsTheFirstOfTheListAndItsTextRepeatsTheRun) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "rotate([20, 35, 0]) difference() { cube([20, 14, 9], center = "
               "true); translate([0, 0, 3]) cube([12, 8, 9], center = true); "
               "}");
  const auto list = run(folder, {"orient", "a.scad", "-o", "o.json", "--layer",
                                 "0.2", "--supports=heavy"});
  EXPECT_EQ(list.status, 0) << list.errors;
  const json found = json::parse(read_file(folder.file("o.json")));
  ASSERT_GE(found["listed"].size(), 2U);
  const auto slice = [&](const std::string& output, const std::string& up) {
    const auto result =
        run(folder, {"a.scad", "-o", output, "--layer", "0.2",
                     "--supports=heavy", "--orient", up, "--report", "r.json"});
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.errors;
  };
  for (const std::size_t rank : {1, 2}) {
    const json& up = found["listed"][rank - 1]["orient"];
    const std::string text =
        fmt::format("{:g},{:g},{:g}", up[0].get<double>(), up[1].get<double>(),
                    up[2].get<double>());
    const std::string summary =
        slice("found.slc", rank == 1 ? "best" : fmt::format("{}", rank));
    EXPECT_TRUE(
        has(summary, fmt::format("\ndirection: --orient {}, found among "
                                 "{} directions\n",
                                 text, found["judged"].get<int>())))
        << summary;
    const json report = json::parse(read_file(folder.file("r.json")));
    EXPECT_EQ(report["orient"]["option"], "--orient " + text);
    slice("said.slc", text);
    EXPECT_EQ(read_file(folder.file("found.slc")),
              read_file(folder.file("said.slc")));
    EXPECT_FALSE(
        json::parse(read_file(folder.file("r.json"))).contains("orient"));
  }
  const auto beyond = run(
      folder, {"a.scad", "-o", "a.slc", "--layer", "0.2", "--orient", "900"});
  EXPECT_EQ(beyond.status, 1);
  EXPECT_TRUE(has(beyond.errors, "--orient 900: 'lamina orient' lists "))
      << beyond.errors;
}

// A part that is turned in the design has the best direction of the part as
// drawn, turned. A text has none.
TEST(Orient, EachPieceOfABatchHasItsOwnBest) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               std::string("lean = 0; rotate([lean, 0, 0]) { ") + kTee + " }");
  folder.write("t.csv", "name,lean\nflat,0\nfront,90\nhead,180\n");
  const auto result =
      run(folder, {"batch", "a.scad", "--table", "t.csv", "-o", "{name}.slc",
                   "--layer", "0.2", "--orient", "best", "--report", "r.csv"});
  EXPECT_EQ(result.status, 0) << result.errors;
  const std::string table = read_file(folder.file("r.csv"));
  for (const char* up : {"\"0,0,-1\"", "\"0,1,0\"", "\"0,0,1\""}) {
    EXPECT_TRUE(has(table, up)) << table;
  }
  EXPECT_TRUE(has(result.errors, "--orient 0,1,0")) << result.errors;
  const auto text = run(folder, {"a.scad", "-o", "a.csg", "--orient", "best"});
  EXPECT_EQ(text.status, 0) << text.errors;
}

TEST(Orient, PiecesOfPlatesLieAsTheyShould) {
  const TemporaryFolder folder;
  folder.write("a.scad", kTee);
  const auto result = run(
      folder, {"plate", "a.scad", "--plate", "60,60", "-o", "p.slc", "--layer",
               "0.2", "--orient", "best", "--fail-on", "overhangs"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.errors, "a: direction: --orient 0,0,-1, found among"))
      << result.errors;
}

// Slices for many minutes in each direction but few.
constexpr const char* kSlow = "cylinder(r = 300, h = 900, $fn = 3000);";

TEST(Orient, AnInterruptListsWhatWasJudged) {
  if (!support::has_terminals()) GTEST_SKIP() << "needs terminals";
  const TemporaryFolder folder;
  folder.write("a.scad", kTee);
  const auto result = support::run_on_terminal(
      command({"orient", "a.scad", "-o", "o.json", "--directions", "10000"}),
      folder.path(), "directions");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.output, "interrupted: ")) << result.output;
  EXPECT_TRUE(has(result.output,
                  " of 10000 directions judged, supports "
                  "planned for 0; "))
      << result.output;
  const json found = json::parse(read_file(folder.file("o.json")));
  EXPECT_EQ(found["interrupted"], true);
  EXPECT_GT(found["judged"], 0);
  EXPECT_LT(found["judged"], 9000);
  ASSERT_GE(found["listed"].size(), 1U);
  EXPECT_FALSE(found["listed"][0].contains("contacts"));
}

TEST(Orient, ASecondInterruptEndsAtOnce) {
  const TemporaryFolder folder;
  folder.write("a.scad", kSlow);
  support::BackgroundProcess process(
      command({"orient", "a.scad", "-o", "o.json"}), folder.path());
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  process.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), 130);
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(Orient, RefusesWhatItCannotMean) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(3);");
  folder.write("flat.scad", "square(3);");
  const auto status = [&](const std::vector<std::string>& words,
                          const std::string& message) {
    const auto result = run(folder, words);
    EXPECT_TRUE(has(result.errors, message)) << result.errors;
    return result.status;
  };
  EXPECT_EQ(status({"a.scad", "-o", "a.slc", "--orient", "0,0,0"},
                   "--orient: expected the direction that points up, X,Y,Z, or "
                   "best, or a number from 1 of the list of 'lamina orient', "
                   "not '0,0,0'"),
            2);
  EXPECT_EQ(status({"a.scad", "-o", "a.slc", "--orient", "up"}, "not 'up'"), 2);
  EXPECT_EQ(
      status({"a.scad", "-o", "a.slc", "--orient", "1,0,0", "--axis", "x"},
             "not with --axis"),
      2);
  EXPECT_EQ(status({"a.scad", "-o", "a.slc", "--orient", "best", "--axis", "x"},
                   "not with --axis"),
            2);
  EXPECT_EQ(
      status({"a.scad", "-o", "a.slc", "--orient", "2", "--heights", "1,2"},
             "--orient best needs layers, not --heights"),
      2);
  EXPECT_EQ(status({"orient", "a.scad", "--orient", "best"}, "orient finds"),
            2);
  EXPECT_EQ(status({"orient", "a.scad", "-o", "a.png"},
                   "orient writes .html or .json; 'a.png' is neither"),
            2);
  EXPECT_EQ(status({"orient", "a.scad", "--axis", "x"}, "orient finds"), 2);
  EXPECT_EQ(status({"orient", "flat.scad"}, "is not a 3D object"), 1);
}

// A bar that is longer than the plate is wide does not lie as it is drawn.
TEST(Orient, ListsWhatFitsThePrinter) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([130, 5, 5]);");
  ASSERT_EQ(run(folder, {"orient", "a.scad", "-o", "free.json"}).status, 0);
  ASSERT_EQ(run(folder, {"orient", "a.scad", "--printer", "prusa-sl1", "-o",
                         "fit.json"})
                .status,
            0);
  const json free = json::parse(read_file(folder.file("free.json")));
  const json fit = json::parse(read_file(folder.file("fit.json")));
  EXPECT_NEAR(free["listed"][0]["height_mm"].get<double>(), 5, 0.1);
  ASSERT_FALSE(fit["listed"].empty());
  for (const json& one : fit["listed"]) {
    EXPECT_GT(one["height_mm"].get<double>(), 6);
    const auto up = one["orient"].get<std::vector<double>>();
    EXPECT_EQ(
        run(folder,
            {"a.scad", "--printer", "prusa-sl1", "--layer", "0.5", "--orient",
             fmt::format("{},{},{}", up[0], up[1], up[2]), "-o", "a.sl1"})
            .status,
        0);
  }
}

}  // namespace
}  // namespace lamina::cli
