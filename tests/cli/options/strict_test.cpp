// What must not pass silently: each with its message, and the status that
// --strict makes of it.

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::ProcessResult;
using support::TemporaryFolder;

constexpr auto kAnnotatedDesign =
    "initials = \"AB\";\n"
    "inner = 17;       // [10:20]\n"
    "style = \"round\";  // [round, square]\n"
    "cube(inner);\n"
    "translate([0, 0, 16]) linear_extrude(2) text(initials);\n";

class Strict : public ::testing::Test {
 protected:
  Strict() { folder_.write("d.scad", kAnnotatedDesign); }

  // Whether d.slc was written, too.
  void expect(std::vector<std::string> words, int status,
              const std::string& messages) {
    words.insert(words.end(), {"-o", "d.slc"});
    const ProcessResult result = run(folder_, words);
    EXPECT_EQ(result.status, status) << result.errors;
    EXPECT_EQ(result.errors.substr(0, messages.size()), messages);
    EXPECT_EQ(std::filesystem::exists(folder_.file("d.slc")), status == 0);
    std::filesystem::remove(folder_.file("d.slc"));
  }

  // A warning, and what --strict adds to it.
  void expect_warning(std::vector<std::string> words,
                      const std::string& warning) {
    expect(words, 0, warning + "d.slc: ");
    words.insert(words.end(), {"--strict", "-q"});
    const std::string label = "warning: ";
    const std::size_t begin = warning.find(label) + label.size();
    expect(words, 1,
           fmt::format("{}error: not written: 1 warning (first: {}); "
                       "--no-strict writes it\n",
                       warning,
                       warning.substr(begin, warning.find('\n') - begin)));
  }

  TemporaryFolder folder_;
};

// Each of them changes the layers of a solid, and none of them an outline.
TEST_F(Strict, SettingsThatAnOutlineHasNoUseFor) {
  folder_.write("flat.scad", "square(5);");
  const auto slice = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"flat.scad", "-o", "flat.svg"});
    return run(folder_, words);
  };
  const std::string summary = "flat.svg: 1 layer, ";
  ASSERT_TRUE(slice({}).errors.starts_with(summary));
  const std::string outline = support::read_file(folder_.file("flat.svg"));
  const std::vector<std::string> settings[] = {
      {"--layer", "0.1"},     {"--adaptive", "0.1"}, {"--heights", "1"},
      {"--axis", "x"},        {"--axis", "auto"},    {"--place-on-bed"},
      {"--tolerance", "0.5"}, {"--ray", "0.5"},      {"--contour", "paper"}};
  for (const std::vector<std::string>& words : settings) {
    const ProcessResult result = slice(words);
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(result.errors.starts_with(
        "warning: the design is an outline, of which " + words[0] +
        " can change nothing\n" + summary))
        << result.errors;
    EXPECT_EQ(support::read_file(folder_.file("flat.svg")), outline);
  }
  const ProcessResult two =
      slice({"--strict", "--axis", "x", "--layer", "0.1"});
  EXPECT_EQ(two.status, 1);
  EXPECT_NE(two.errors.find("of which --layer, --axis can change nothing"),
            std::string::npos)
      << two.errors;
  EXPECT_TRUE(
      slice({"--tolerance", "0", "--layers", "1"}).errors.starts_with(summary));
  // These do change it.
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--scale", "2"}, {"--compensate", "0.5"}}) {
    const ProcessResult result = slice(words);
    EXPECT_TRUE(result.errors.starts_with(summary)) << result.errors;
    EXPECT_NE(support::read_file(folder_.file("flat.svg")), outline);
  }
}

TEST_F(Strict, NamesThatTheDesignLacks) {
  expect_warning({"d.scad", "-D", "intials=\"XY\""},
                 "-D intials=\"XY\": warning: the design has no variable "
                 "'intials'\nnote: did you mean 'initials'?\n");
  expect({"d.scad", "--strict", "-D", "$fn=9", "-D", "inner=20"}, 0, "d.slc: ");
}

// A design may leave a name to whoever runs it.
TEST_F(Strict, NamesThatTheDesignOnlyAsksForAreNotLacking) {
  folder_.write("asks.scad", "cube(is_undef(edge) ? 3 : edge);");
  folder_.write("includes.scad", "include <asks.scad>\ncube(1);");
  for (const std::string design : {"asks.scad", "includes.scad"}) {
    expect({design, "--strict", "-D", "edge=4"}, 0, "d.slc: 80 layers, ");
    expect_warning({design, "-D", "edg=4"},
                   "-D edg=4: warning: the design has no variable 'edg'\n");
  }
}

TEST_F(Strict, TextsWhoseQuotesTheShellTook) {
  expect_warning({"d.scad", "-D", "initials=XY"},
                 "-D initials=XY: warning: Ignoring unknown variable 'XY'\n"
                 "note: a text needs quotes that the shell leaves: -D "
                 "'name=\"text\"'\n");
  expect_warning({"d.scad", "-D", "inner=abc"},
                 "-D inner=abc: warning: Ignoring unknown variable 'abc'\n"
                 "note: a text needs quotes that the shell leaves: -D "
                 "'name=\"text\"'\n");
}

TEST_F(Strict, ValuesThatAreNoExpressions) {
  expect({"d.scad", "-D", "inner="}, 1,
         "-D inner=: error: Parser error: syntax error\n");
}

TEST_F(Strict, ValuesThatTheCustomizerDoesNotAllow) {
  expect_warning({"d.scad", "-D", "inner=50"},
                 "-D inner=50: warning: the value does not keep to [10 : 20]\n"
                 "d.scad:2:1: note: the design says so here\n"
                 "    2 | inner = 17;       // [10:20]\n"
                 "      | ^~~~~~~~~~~\n");
  expect_warning({"d.scad", "-D", "style=\"oval\""},
                 "-D style=\"oval\": warning: the value does not keep to "
                 "[\"round\", \"square\"]\n"
                 "d.scad:3:1: note: the design says so here\n"
                 "    3 | style = \"round\";  // [round, square]\n"
                 "      | ^~~~~~~~~~~~~~~~\n");
  folder_.write("s.json", R"({"parameterSets": {"s": {"inner": "50"}}})");
  expect_warning({"d.scad", "-p", "s.json", "-P", "s"},
                 "d.scad:2:1: warning: parameter inner = 50 of the set does "
                 "not keep to [10 : 20]\n"
                 "    2 | inner = 17;       // [10:20]\n"
                 "      | ^~~~~~~~~~~\n");
}

TEST_F(Strict, ValuesOfASetThatTheDesignDoesNotGet) {
  folder_.write("s.json", R"({"parameterSets": {"s": {"iner": "12"}}})");
  expect_warning({"d.scad", "-p", "s.json", "-P", "s"},
                 "warning: the set has 'iner', the design has no such "
                 "variable\nnote: did you mean 'inner'?\n");
  const ProcessResult result = run(
      folder_, {"batch", "d.scad", "--table", "s.json", "-o", "{name}.slc"});
  EXPECT_EQ(result.status, 1) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(folder_.file("s.slc")));
}

TEST_F(Strict, MisspeltModulesAndFunctions) {
  folder_.write("d.scad", "cube(10); shpere(3);\n");
  expect_warning({"d.scad"},
                 "d.scad:1:11: warning: Ignoring unknown module 'shpere'\n"
                 "    1 | cube(10); shpere(3);\n"
                 "      |           ^~~~~~~~~\n"
                 "note: did you mean 'sphere'?\n");
  folder_.write("d.scad", "function twice(x) = 2 * x; cube(twise(1) + 1);\n");
  const ProcessResult result = run(folder_, {"d.scad"});
  EXPECT_NE(result.errors.find("note: did you mean 'twice'?\n"),
            std::string::npos)
      << result.errors;
}

TEST_F(Strict, HardWarningsSpeakThoughTheRunIsQuiet) {
  folder_.write("d.scad", "cube(10); shpere(3);\n");
  expect({"d.scad", "-q", "--hardwarnings"}, 1,
         "d.scad:1:11: warning: Ignoring unknown module 'shpere'\n");
}

TEST_F(Strict, IsTheRuleUnderARoot) {
  expect({"d.scad", "--root", ".", "--no-import", "-q"}, 1,
         "d.scad:5:41: warning: Can't get font \n"
         "    5 | translate([0, 0, 16]) linear_extrude(2) text(initials);\n"
         "      |                                         ^~~~~~~~~~~~~~\n"
         "note: the system's fonts may not be read: try --allow-read "
         "/usr/share/fonts\n"
         "error: not written: 1 warning (first: Can't get font ); --no-strict "
         "writes it\n");
  expect({"d.scad", "--root", ".", "--no-import", "-q", "--no-strict"}, 0, "");
}

TEST_F(Strict, IsTheRuleInBatches) {
  folder_.write("b.scad", "n = 1; cube(n); if (n == 2) shpere(3);\n");
  folder_.write("t.csv", "n\n1\n2\n");
  const ProcessResult strict =
      run(folder_, {"batch", "b.scad", "--table", "t.csv", "-o", "{row}.slc"});
  EXPECT_EQ(strict.status, 1);
  EXPECT_NE(strict.errors.find("error: not written: 1 warning (first: "),
            std::string::npos)
      << strict.errors;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("1.slc")));
  EXPECT_FALSE(std::filesystem::exists(folder_.file("2.slc")));
  EXPECT_EQ(run(folder_, {"batch", "b.scad", "--table", "t.csv", "-o",
                          "{row}.slc", "--no-strict"})
                .status,
            0);
}

// A design's error, which is no warning, in each of the formats.
TEST_F(Strict, WhatFailedIsWrittenInNoFormat) {
  const auto expect_nothing = [&](std::vector<std::string> words) {
    const std::string output = words.back();
    words.insert(words.end(), {"-q", "--strict"});
    const ProcessResult result = run(folder_, words);
    EXPECT_EQ(result.status, 1) << output << result.errors;
    EXPECT_NE(result.errors.find("error: "), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder_.file(output))) << output;
  };
  folder_.write("d.scad", "x = 1; cube(x); assert(false);");
  folder_.write("s.json", R"({"parameterSets": {"s": 5}})");
  for (const char* format : {"csg", "echo", "ast", "param", "slc"}) {
    const std::string output = std::string("d.") + format;
    for (const char* set : {"s", "nope"}) {
      expect_nothing({"d.scad", "-p", "s.json", "-P", set, "-o", output});
    }
    if (output == "d.ast" || output == "d.param") continue;
    expect_nothing({"d.scad", "-o", output});
  }
  folder_.write("broken.dxf", "0\nSECTION\n2\nENTITIES\nx\n");
  folder_.write("d.scad", "cube(1); linear_extrude(1) import(\"broken.dxf\");");
  expect_nothing({"d.scad", "-o", "d.slc"});
}

TEST_F(Strict, WhatFailedIsNoPieceThatIsDone) {
  folder_.write("b.scad", "n = 1; cube(n); assert(n < 2, \"too big\");");
  folder_.write("t.csv", "n\n1\n2\n");
  folder_.write("t.json", R"({"parameterSets": {"1": {"n": "1"}, "2": 5}})");
  for (const char* table : {"t.csv", "t.json"}) {
    for (const char* format : {"csg", "echo"}) {
      for (const char* strictness : {"--strict", "--no-strict"}) {
        const std::string output = std::string("{row}.") + format;
        const std::string ledger = output + table + strictness;
        const auto make = [&] {
          return run(folder_,
                     {"batch", "b.scad", "--table", table, "-o", output,
                      strictness, "--ledger", ledger, "--resume"});
        };
        ProcessResult result = make();
        EXPECT_EQ(result.status, 1) << ledger;
        EXPECT_NE(result.errors.find("1 of 2 pieces done, 1 failed"),
                  std::string::npos)
            << result.errors;
        result = make();
        EXPECT_NE(
            result.errors.find("1 of 2 pieces done (1 of them before), 1 fail"),
            std::string::npos)
            << result.errors;
        std::filesystem::remove(folder_.file(std::string("1.") + format));
        std::filesystem::remove(folder_.file(std::string("2.") + format));
      }
    }
  }
}

TEST_F(Strict, FilesInOtherUnits) {
  folder_.write("d.scad", "scale(0.001) cube([20, 10, 200]);\n");
  expect_warning({"d.scad", "--layer", "0.01"},
                 "warning: the design is 0.02 x 0.01 x 0.2 mm: are its units "
                 "millimetres?\n");
  folder_.write("d.scad", "scale(1000) cube([20, 1, 1]);\n");
  const ProcessResult large = run(folder_, {"d.scad", "--layer", "100"});
  EXPECT_NE(large.errors.find("warning: the design is 20000 x 1000 x 1000 mm: "
                              "are its units millimetres?\n"),
            std::string::npos)
      << large.errors;
}

TEST_F(Strict, DesignsThinnerThanALayer) {
  folder_.write("d.scad", "cube([1, 1, 0.02]);\n");
  expect({"d.scad"}, 1,
         "error: The design is 0.02 mm high: too thin for layers of 0.05 mm, "
         "which are cut in their middle\n");
  folder_.write("d.scad", "cube(17);\n");
  expect({"d.scad", "--layer", "50"}, 1,
         "error: The design is 17 mm high: too thin for layers of 50 mm, which "
         "are cut in their middle\n");
}

TEST_F(Strict, MisspeltWordsGetAGuess) {
  expect({"d.scad", "--layr", "0.1"}, 2,
         "lamina: The following argument was not expected: --layr; did you "
         "mean '--layer'?\n");
  expect({"insepct"}, 2,
         "lamina: there is no command 'insepct'; did you mean 'inspect'? (a "
         "file: ./insepct)\n");
  expect({"dd.scad"}, 1,
         "error: Can't open input file 'dd.scad'!\n"
         "note: No such file or directory\n"
         "note: did you mean 'd.scad'?\n");
}

}  // namespace
}  // namespace lamina::cli
