// What the command line promises before any design is read.

#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>

#include "base/utf8.h"
#include "base/version.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
using support::TemporaryFolder;

TEST(Usage, VersionIsOneLineOnStandardOutput) {
  const TemporaryFolder folder;
  const auto result = run(folder, {"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, "lamina " + std::string(version()) + "\n");
  EXPECT_EQ(result.errors, "");
}

TEST(Usage, VersionStaysSmall) {
  const TemporaryFolder folder;
  EXPECT_LT(run(folder, {"--version"}).peak_memory_kib, 12 * 1000);
}

TEST(Usage, VersionNeedsFewSharedLibraries) {
  const auto libraries = support::run_process({"ldd", LAMINA_PROGRAM});
  ASSERT_EQ(libraries.status, 0);
  std::size_t count = 0;
  for (const char c : libraries.output) count += c == '\n' ? 1 : 0;
  EXPECT_LE(count, 12U) << libraries.output;
  for (const char* const heavy :
       {"OSMesa", "libGL", "EGL", "CGAL", "gmp", "mpfr", "Qt", "X11"}) {
    EXPECT_FALSE(has(libraries.output, heavy)) << libraries.output;
  }
}

TEST(Usage, HelpShowsExactlyTheOptionsThatThereAre) {
  const TemporaryFolder folder;
  const auto common = run(folder, {"--help"});
  const auto result = run(folder, {"--help-all"});
  for (const auto& page : {common, result}) {
    EXPECT_EQ(page.status, 0);
    for (const char* const word :
         {"inspect", "view", "Examples:", "Exit status"}) {
      EXPECT_TRUE(has(page.output, word)) << word;
    }
  }
  // Two screens.
  EXPECT_LE(std::ranges::count(common.output, '\n'), 2 * 40);
  // Every option of the page is known: what it lacks is its value.
  for (std::size_t at = 0;
       (at = result.output.find("\n  -", at)) != std::string::npos; ++at) {
    const std::size_t begin = at + 3;
    const std::size_t end = result.output.find_first_of(" ,\n", begin);
    const std::string option = result.output.substr(begin, end - begin);
    const auto tried = run(folder, {option});
    EXPECT_FALSE(has(tried.errors, "was not expected")) << option;
  }
  EXPECT_TRUE(has(run(folder, {"view", "--help"}).output, "--style"));
  EXPECT_TRUE(has(run(folder, {"inspect", "-h"}).output, "--all"));
}

TEST(Usage, MistakesEndWithTwoAndMakeNothing) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  const std::vector<std::vector<std::string>> mistakes = {
      {},
      {"--no-such-option", "a.scad"},
      {"a.slc"},
      {"a.cli", "-o", "b.slc"},
      {"view", "a.png", "-o", "b.png"},
      {"a.scad", "--layer", "0"},
      {"a.scad", "--layer", "-1"},
      {"a.scad", "--layer", "thick"},
      {"a.scad", "--layer", "0.1mm"},
      {"a.scad", "--layer", "nan"},
      {"a.scad", "--tolerance", "-0.1"},
      {"a.scad", "--tolerance", "nan"},
      {"a.scad", "--compensate", "nan"},
      {"a.scad", "--compensate", "1e99"},
      {"a.scad", "--compensate", "-101"},
      {"a.scad", "--scale", "0"},
      {"a.scad", "--scale", "-1.02"},
      {"a.scad", "--scale", "nan"},
      {"a.scad", "--scale", "inf"},
      {"a.scad", "--scale", "1e99"},
      {"a.scad", "--scale", "2%"},
      {"a.scad", "--scale", ""},
      {"a.scad", "--heights", "1,0.5"},
      {"a.scad", "--heights", "1,,2"},
      {"a.scad", "--min-feature", "0"},
      {"a.scad", "--min-feature", "-0.2"},
      {"a.scad", "--min-feature", "0.000001"},
      {"a.scad", "--min-feature", "11"},
      {"a.scad", "--min-feature", "thin"},
      {"a.scad", "--min-feature", "nan"},
      {"a.scad", "--min-feature", "inf"},
      {"a.scad", "--min-feature"},
      {"a.scad", "--min-feature", "0.2", "--contour", "paper"},
      {"a.scad", "--sampler", "opengl", "--contour", "paper"},
      {"a.scad", "--sampler", "gl"},
      {"a.scad", "--sampler", "gl-peeling", "--contour", "faithful"},
      {"a.scad", "--sampler", "gl", "--contour", "paper", "--heights", "0.5"},
      {"a.scad", "--boxes", "global"},
      {"a.scad", "-o", "a.csg", "--printer", "plain"},
      {"a.scad", "-o", "a.csg", "--material", "brass"},
      {"a.scad", "-o", "a.csg", "--metal", "brass"},
      {"a.scad", "--price", "60/l"},
      {"a.scad", "--material", "brass", "--price", "60"},
      {"a.scad", "--material", "brass", "--price", "62,5/g"},
      {"check", "a.scad", "--fail-on", "everything"},
      {"check", "a.scad", "--heights", "0.5"},
      {"a.scad", "--mirror", "x"},
      {"a.scad", "-o", "a.csg", "--cli", "ascii"},
      {"a.scad", "-o", "a.csg", "--report", "a.json"},
      {"a.scad", "-o", "a.echo", "--min-feature", "0.2"},
      {"a.scad", "-o", "a.sl1", "--heights", "0.5"},
      {"view", "a.scad", "-o", "a.png", "--sampler", "gl"},
      {"view", "a.scad", "-o", "a.png", "--min-feature", "0.2"},
      {"inspect", "a.slc", "--min-feature", "0"},
      {"a.scad", "--axis", "w"},
      {"a.scad", "--contour", "best"},
      {"a.scad", "--threads", "0"},
      {"a.scad", "-p", "sets.json"},
      {"a.scad", "-P", "set"},
      {"a.scad", "--check-parameters", "maybe"},
      {"a.scad", "--check-parameter-ranges"},
      {"a.scad", "--seed", "-1"},
      {"a.scad", "-o", "a.xyz"},
      {"a.scad", "-o", "a"},
      {"a.scad", "-o", "-"},
      {"a.scad", "--export-format", "xyz"},
      {"a.slc"},
      {"a.scad", "b.scad", "-o", "c.slc"},
      {"batch", "a.scad", "-o", "{row}.slc"},
      {"batch", "a.scad", "--table", "t.csv"},
      {"batch", "a.scad", "--table", "t.csv", "-o", "b.slc"},
      {"batch", "a.scad", "--table", "t.csv", "-o", "{row}.abc"},
      {"batch", "a.scad", "--table", "t.csv", "-o", "{row}.slc", "-p", "s.json",
       "-P", "a"},
      {"a.scad", "-o", ""},
      {"a.scad", "-d", ""},
      {"a.scad", "--report", ""},
      {"a.scad", "--printer", ""},
      {"a.scad", "--material", ""},
      {"a.scad", "--metal", ""},
      {"a.scad", "--export-format", ""},
      {"a.scad", "--root", ""},
      {"compare", "a.scad", "--png", ""},
      {"view", "a.scad", "-o", ""},
      {"batch", "a.scad", "--table", "t.csv", "-o", "{row}.slc", "--ledger",
       ""},
      {"batch", "a.scad", "--table", "t.csv", "-o", "{row}.slc", "--ledger",
       "-"},
      {"batch", "a.scad", "--table", "t.csv", "-o", "{row}.slc", "--collect",
       ""},
      {"view", "a.scad", "-o", "a.jpg"},
      {"view", "a.scad"},
      {"inspect"},
  };
  for (const auto& arguments : mistakes) {
    std::string line;
    for (const std::string& word : arguments) line += word + " ";
    const auto result = run(folder, arguments);
    EXPECT_EQ(result.status, 2) << line << result.errors;
    EXPECT_EQ(result.output, "") << line;
    EXPECT_NE(result.errors, "") << line;
  }
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(Usage, OptionsOfDesignsAreRefusedForFilesOfLayers) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  ASSERT_EQ(run(folder, {"a.scad", "-q", "--layer", "0.5"}).status, 0);
  const std::vector<std::vector<std::string>> commands = {
      {"inspect", "a.slc"},
      {"check", "a.slc"},
      {"view", "a.slc", "-o", "a.png"},
      {"view", "a.slc", "-o", "a.html"},
      {"compare", "a.slc", "a.slc"}};
  const std::vector<std::vector<std::string>> options = {
      {"--scale", "2"},      {"--layer", "0.1"}, {"--compensate", "0.1"},
      {"--axis", "x"},       {"-D", "k=5"},      {"--adaptive", "0.1"},
      {"--place-on-bed"},    {"--render"},       {"--contour", "paper"},
      {"--language", "2021"}};
  for (const auto& command : commands) {
    for (const auto& option : options) {
      std::vector<std::string> words = command;
      words.insert(words.end(), option.begin(), option.end());
      const auto result = run(folder, words);
      EXPECT_EQ(result.status, 2) << command.front() << result.output;
      EXPECT_EQ(result.errors, "error: " + option.front() +
                                   " needs a design; 'a.slc' holds layers\n");
    }
    std::vector<std::string> words = command;
    for (const char* const word : {"-q", "--threads", "1", "--hardwarnings"}) {
      words.push_back(word);
    }
    EXPECT_EQ(run(folder, words).status, 0) << command.front();
  }
  EXPECT_EQ(run(folder, {"inspect", "a.slc", "--layers", "1"}).status, 2);
  // Here they are those of the design.
  EXPECT_EQ(
      run(folder, {"compare", "a.slc", "a.scad", "--layer", "0.5"}).status, 0);
}

TEST(Usage, FilesOfLayersAreNoDesigns) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(5);");
  ASSERT_EQ(run(folder, {"a.scad", "-o", "a.slc"}).status, 0);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{
           {"supports", "a.slc", "-o", "b.scad"},
           {"sprue", "a.slc", "-o", "b.scad"},
           {"orient", "a.slc"},
           {"preflight", "a.slc", "--metal", "sterling-silver"},
           {"tree", "a.slc", "-o", "b.scad", "--flask", "80,100"},
           {"plate", "a.slc", "-o", "b.slc", "--plate", "50,50"}}) {
    const auto result = run(folder, words);
    EXPECT_EQ(result.status, 2) << words.front();
    EXPECT_TRUE(has(result.errors, "'a.slc' holds layers already; try"))
        << result.errors;
  }
}

TEST(Usage, OptionsThatChangeNothingAreRefused) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(5);");
  const std::vector<std::string> orient = {"orient", "a.scad"};
  const std::vector<std::string> supports = {"supports", "a.scad", "-o",
                                             "b.scad"};
  const std::vector<std::string> preflight = {"preflight", "a.scad", "--metal",
                                              "sterling-silver"};
  for (auto [command, words, complaint] :
       std::vector<std::tuple<std::vector<std::string>,
                              std::vector<std::string>, std::string>>{
           {orient, {"--metal", "sterling-silver"}, "not expected: --metal"},
           {orient, {"--min-feature", "1"}, "not expected: --min-feature 1"},
           {orient, {"--turn", "30"}, "orient finds what --axis"},
           {supports, {"--min-feature", "1"}, "not expected: --min-feature 1"},
           {preflight, {"--price", "2/g"}, "not expected: --price 2/g"},
           {preflight, {"--heights", "1,2"}, "not --heights"},
           {preflight, {"--sprue"}, "without --supports and --sprue"},
           {preflight, {"--compensate", "0.1"}, "without --compensate"}}) {
    command.insert(command.end(), words.begin(), words.end());
    const auto result = run(folder, command);
    EXPECT_EQ(result.status, 2) << command[0] << words[0];
    EXPECT_TRUE(has(result.errors, complaint)) << result.errors;
  }
  const auto view =
      run(folder, {"view", "a.scad", "-o", "a.png", "--layer-number", "0"});
  EXPECT_EQ(view.status, 2);
  EXPECT_TRUE(has(view.errors, "a whole number from 1 on was expected"));
}

TEST(Usage, KnownFormatsThatAreNotWrittenSaySo) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const char* const extension : {"stl", "off", "amf", "dxf", "STL"}) {
    const auto result =
        run(folder, {"a.scad", "-o", "a." + std::string(extension)});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(has(result.errors, "layers, not meshes")) << result.errors;
  }
  EXPECT_EQ(folder.entry_count(), 1U);
}

// In what commands print, in reports and on pages.
TEST(Usage, NamesAreData) {
  const TemporaryFolder folder;
  const std::string name = "n\x1b[2J\xff\u202e\nerror: forged.scad";
  // Its second cube is an island, of which the closing line speaks.
  folder.write(name, "cube(1); translate([3, 0, 3]) cube(1);");
  folder.write("table.csv", "name,size\n=1+1,1\n");
  folder.write("size.scad", "size = 1; cube(size);");
  const auto is_clean = [](const std::string& text) {
    return text.find('\x1b') == std::string::npos &&
           text.find('\xff') == std::string::npos && !has(text, "\u202e") &&
           !has(text, "\nerror: f");
  };
  const auto sliced = run(folder, {name, "-o", "x\x1b.slc"});
  EXPECT_EQ(sliced.status, 0);
  EXPECT_TRUE(is_clean(sliced.errors)) << sliced.errors;
  const auto both = run(folder, {name, "size.scad", "-o", "out/"});
  EXPECT_EQ(both.status, 0);
  EXPECT_TRUE(is_clean(both.errors)) << both.errors;
  EXPECT_TRUE(is_clean(run(folder, {"--no\x1b[2J"}).errors));
  const auto refused = run(folder, {"x\x1b\nerror: forged.slc"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(is_clean(refused.errors)) << refused.errors;
  const std::string table = "t\x1b[2J\xff\nerror: forged.csv";
  folder.write(table, "size\nx\n1\n");
  const auto rows =
      run(folder, {"batch", "size.scad", "--table", table, "-o", "{row}.svg"});
  EXPECT_EQ(rows.status, 1);
  EXPECT_TRUE(is_clean(rows.errors)) << rows.errors;
  EXPECT_EQ(run(folder, {"view", name, "-o", "page.html"}).status, 0);
  const std::string page = support::read_file(folder.file("page.html"));
  EXPECT_TRUE(is_valid_utf8(page));
  EXPECT_TRUE(is_clean(page));
  EXPECT_EQ(run(folder, {"batch", "size.scad", "--table", "table.csv", "-o",
                         "{row}.slc", "--report", "r.csv"})
                .status,
            0);
  EXPECT_TRUE(has(support::read_file(folder.file("r.csv")), "2,'=1+1,1.slc,"));
  // The header of a file of layers names the program that made it.
  std::string layers = support::read_file(folder.file("1.slc"));
  const std::size_t at = layers.find("lamina");
  ASSERT_NE(at, std::string::npos);
  const std::string forged = "forged\nerror: f.slc";
  folder.write(forged, layers.replace(at, 2, "\x1b[\nerror: f"));
  for (const std::string& file : {forged, name}) {
    const auto inspected = run(folder, {"inspect", file});
    EXPECT_EQ(inspected.status, 0);
    EXPECT_TRUE(is_clean(inspected.output)) << inspected.output;
    const auto compared = run(folder, {"compare", file, forged});
    EXPECT_NE(compared.output, "");
    EXPECT_TRUE(is_clean(compared.output)) << compared.output;
  }
}

// As behind `| head`: the list is longer than a pipe holds.
TEST(Usage, AReaderThatLeavesEndsAQuestionQuietly) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([1, 1, 30]);");
  const std::string line = std::string(LAMINA_PROGRAM) +
                           " inspect a.scad --all --layer 0.001 | head -1; "
                           "exit ${PIPESTATUS[0]}";
  const auto result = support::run_process({"bash", "-c", line}, folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors, "");
}

}  // namespace
}  // namespace lamina::cli
