#include "csg/eval/builtin/json.h"

#include <string>

#include <gtest/gtest.h>

#include "csg/eval/value/operators.h"
#include "csg/eval/value/text.h"
#include "tests/csg/eval/evaluate_text.h"
#include "tests/support/temporary_folder.h"

namespace lamina::csg {
namespace {

class ReadJson : public testing::Test {
 protected:
  JsonResult read(const std::string& text) const {
    return read_json(folder_.write("data.json", text));
  }
  // What a file is, as `echo` shows it.
  std::string echo(const std::string& text) const {
    const JsonResult result = read(text);
    return result.fault.empty() ? to_echo(result.value) : result.fault;
  }

  support::TemporaryFolder folder_;
};

TEST_F(ReadJson, GivesEachKindItsValue) {
  EXPECT_EQ(echo("null"), "undef");
  EXPECT_EQ(echo("true"), "true");
  EXPECT_EQ(echo("-0.5e1"), "-5");
  EXPECT_EQ(echo("18446744073709551615"), "1.84467e+19");
  EXPECT_EQ(echo("-9223372036854775808"), "-9.22337e+18");
  EXPECT_EQ(echo("\"\\u00e4\\n\""), "\"ä\n\"");
  EXPECT_EQ(echo("[1, [], {}]"), "[1, [], { }]");
}

TEST_F(ReadJson, SortsMembersAndKeepsTheLastOfOneName) {
  EXPECT_EQ(echo(R"({"b": 1, "a": {"z": 2, "y": 3}, "b": 4})"),
            "{ a = { y = 3; z = 2; }; b = 4; }");
  EXPECT_TRUE(are_equal(read(R"({"a": 1, "b": [2]})").value,
                        read(R"({"b": [2], "a": 1})").value));
}

TEST_F(ReadJson, SaysWhatIsNoJson) {
  for (const char* text :
       {"", "{", "[1,]", "{\"a\" 1}", "nul", "[1] 2", "1e999", "\"\xff\"",
        "solid cube", "{1: 2}", "[1", "\"a"}) {
    const JsonResult result = read(text);
    EXPECT_TRUE(result.can_read) << text;
    EXPECT_FALSE(result.fault.empty()) << text;
    EXPECT_TRUE(result.value.is_undef()) << text;
  }
  EXPECT_NE(read("[1,\n  oops]").fault.find("line 2, column 3"),
            std::string::npos);
}

TEST_F(ReadJson, SurvivesDeepNesting) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_EQ(read(nested(200000)).fault, "");
  EXPECT_EQ(read(nested(5000000)).fault, "nested too deeply");
  EXPECT_FALSE(read(std::string(5000000, '[')).fault.empty());
}

TEST_F(ReadJson, CannotReadWhatIsNoFile) {
  EXPECT_FALSE(read_json(folder_.file("none.json")).can_read);
  EXPECT_FALSE(read_json(folder_.path()).can_read);
  EXPECT_FALSE(read_json("").can_read);
}

TEST_F(ReadJson, IsAWarningWithThePlaceWhereItFails) {
  folder_.write("bad.json", "[1,]");
  const std::string design = folder_.write(
      "design.scad",
      "echo(import(\"none.json\"));\necho(import(\"bad.json\"));\n"
      "echo(import(5));\n");
  const std::string folder = folder_.path();
  const std::string echo = evaluate_file(design).echo;
  EXPECT_EQ(echo,
            "WARNING: Could not read file '" + folder +
                "/none.json' in file design.scad, line 1\nECHO: undef\n"
                "WARNING: Failed to parse file '" +
                folder +
                "/bad.json': " + read_json(folder_.file("bad.json")).fault +
                " in file design.scad, line 2\nECHO: undef\n"
                "WARNING: Could not read file '' in file design.scad, line 3\n"
                "ECHO: undef\n");
}

}  // namespace
}  // namespace lamina::csg
