// lamina compare --against openscad, and what openscad makes of the examples.

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/lamina.h"
#include "tests/support/openscad_cache.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
using support::ProcessResult;
using support::TemporaryFolder;

namespace fs = std::filesystem;

constexpr const char* kDesign =
    "r = 2; difference() { sphere(r, $fn = 24); cylinder(r = 1, h = 9); }";

TEST(CompareWithOpenscad, RendersTheDesignWithItsDefinitions) {
  const TemporaryFolder folder;
  const TemporaryFolder scratch;
  folder.write("a.scad", kDesign);
  folder.write("sets.json", R"({"parameterSets": {"large": {"r": "2.5"}}})");
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{},
                                             {"-D", "r=3"},
                                             {"-p", "sets.json", "-P", "large"},
                                             {"--axis", "x"}}) {
    std::vector<std::string> words = {
        "env",          "TMPDIR=" + scratch.path(),
        LAMINA_PROGRAM, "compare",
        "a.scad",       "--against",
        "openscad",     "--tolerance",
        "1e-4"};
    words.insert(words.end(), options.begin(), options.end());
    const ProcessResult result = support::run_process(words, folder.path());
    EXPECT_EQ(result.status, 0) << result.output << result.errors;
    EXPECT_TRUE(has(result.output, "OpenSCAD version 2021.01"));
    EXPECT_EQ(scratch.entry_count(), 0U) << "left behind";
  }
}

// Written sprues and trees mean the same to openscad, and $rigid nothing.
TEST(CompareWithOpenscad, AgreesOnWrittenSpruesAndTrees) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "$fn = 24; cube([8, 6, 3], $rigid = true); translate([20, 3, "
               "1.5]) sphere(3); translate([0, 2, 1]) cube([20, 2, 1]);");
  folder.write("b.scad", "cube([5, 4, 6]);");
  ASSERT_EQ(
      run(folder, {"sprue", "a.scad", "--sprue=disc", "-o", "sprued.scad"})
          .status,
      0);
  ASSERT_EQ(run(folder, {"tree", "b.scad", "--copies", "3", "--flask", "80,100",
                         "-o", "tree.scad"})
                .status,
            0);
  for (const char* design : {"sprued.scad", "tree.scad"}) {
    const auto result = run(folder, {"compare", design, "--against", "openscad",
                                     "--tolerance", "1e-4", "--layer", "0.2"});
    EXPECT_EQ(result.status, 0) << design << result.output << result.errors;
  }
}

TEST(CompareWithOpenscad, ALimitEndsIt) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "minkowski() { sphere(2, $fn = 90); cube(1); sphere(1, $fn = "
               "60); }");
  const ProcessResult result =
      run(folder, {"compare", "a.scad", "--against", "openscad", "--time-limit",
                   "0.2", "--heights", "0"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "openscad took more than 0.2 s"))
      << result.errors;
}

// A program of that name that says it is of 2025, and makes h 3.
TEST(CompareWithOpenscad, ReadsTheDesignAsTheInstalledVersionDoes) {
  const TemporaryFolder folder;
  const std::string newer = folder.write(
      "openscad",
      "#!/bin/sh\n"
      "[ \"$1\" != --version ] || exec echo OpenSCAD version 2025.07.18\n"
      "exec /usr/bin/openscad -D h=3 \"$@\"\n");
  fs::permissions(newer, fs::perms::owner_all);
  folder.write("a.scad", "h = version()[0] > 2024 ? 3 : 2; cube([1, 1, h]);\n");
  const ProcessResult result = support::run_process(
      {"env", "PATH=" + folder.path() + ":/usr/bin:/bin", LAMINA_PROGRAM,
       "compare", "a.scad", "--against", "openscad"},
      folder.path());
  EXPECT_EQ(result.status, 0) << result.output << result.errors;
  EXPECT_TRUE(has(result.output, "2025.07.18")) << result.output;
}

// Changes with what the examples share.
std::string libraries_of(const fs::path& examples) {
  std::string all;
  for (const auto& entry : fs::directory_iterator(examples / "lib")) {
    all += support::read_file(entry.path().string());
  }
  return fmt::format("libraries=\"{:016x}\"", std::hash<std::string>()(all));
}

class Example : public ::testing::TestWithParam<const char*> {};

// OpenSCAD unites outlines on a grid of 2^-16 mm, in two steps of them here and
// there, and writes float32 numbers; walls that lean multiply both.
TEST_P(Example, IsWhatOpenscadMakesOfItToATenThousandth) {
  const fs::path examples = LAMINA_EXAMPLES;
  const fs::path design = examples / (std::string(GetParam()) + ".scad");
  const support::OpenScadResult mesh = support::ask_openscad(
      design, "stl",
      {"--export-format", "binstl", "-D", libraries_of(examples)});
  ASSERT_FALSE(mesh.output.empty()) << mesh.words;
  const TemporaryFolder folder;
  const ProcessResult result =
      run(folder, {"compare", design.string(), mesh.output.string(),
                   "--tolerance", "0.0001"});
  EXPECT_EQ(result.status, 0) << result.output << result.errors;
  EXPECT_TRUE(has(result.output, "as many regions and holes in every layer"))
      << result.output;
}

INSTANTIATE_TEST_SUITE_P(Compare, Example,
                         ::testing::Values("hoop", "solitaire", "eternity",
                                           "signet", "pendant"),
                         [](const auto& example) {
                           return std::string(example.param);
                         });

}  // namespace
}  // namespace lamina::cli
