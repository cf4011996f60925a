#include "parser/customizer/customizer.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/parser/parsed.h"

namespace lamina {
namespace {

// The customizer's values for `x = 1; //<comment>`. (Expectations here were
// taken from openscad 2021.01; openscad_parser_test compares whole files.)
std::string values(const std::string& comment) {
  const Parsed parsed("x = 1; //" + comment + "\n");
  const Customizer customizer = Customizer::read(parsed.program());
  return customizer.comment_of(*parsed.program().statements[0]).values;
}

TEST(ParameterValues, MayBeARange) {
  EXPECT_EQ(values("[1:5]"), "[1 : 5]");
  EXPECT_EQ(values(" [ 0.5 : .25 : 10 ] "), "[0.5 : 0.25 : 10]");
}

TEST(ParameterValues, MayBeAList) {
  EXPECT_EQ(values("[1, 2.50, a b]"), "[1, 2.5, \"a b\"]");
  EXPECT_EQ(values("[1:one, 2:two words, x:3]"),
            "[[1, \"one\"], [2, \"two words\"], [\"x\", 3]]");
  EXPECT_EQ(values("[\"a,b\", \"c\\\"d\"]"), "[\"a,b\", \"c\\\"d\"]");
}

TEST(ParameterValues, MayBeANumberOrWords) {
  EXPECT_EQ(values("5"), "5");
  EXPECT_EQ(values("10 mm or 5"), "\"10 mm or 5\"");
}

TEST(ParameterValues, AreEmptyWhereTheyMakeNoSense) {
  for (const char* comment :
       {"", "[1,2", "[]", "[a:1:2]", "1 2", "[1:2:3:4]"}) {
    EXPECT_EQ(values(comment), "\"\"") << comment;
  }
}

TEST(Parameters, KnowTheirDescriptionAndGroup) {
  EXPECT_EQ(Parsed("/* [Stone] */\n"
                   "// carat // weight\n"
                   "carat = 0.5; // [0.25:0.25:3]\n"
                   "name = \"a\";\n")
                .ast(),
            "//Group(\"Stone\")\n"
            "//Description(\"carat   weight\")\n"
            "//Parameter([0.25 : 0.25 : 3])\n"
            "carat = 0.5;\n"
            "//Group(\"Stone\")\n"
            "//Parameter(\"\")\n"
            "name = \"a\";\n");
}

TEST(Parameters, AreLiteralsBeforeTheFirstBrace) {
  EXPECT_EQ(Parsed("a = 1;\nb = a;\nc = [1, -a];\nmodule m() {}\nd = 1;").ast(),
            "module m() {\n}\n"
            "//Parameter(\"\")\na = 1;\nb = a;\nc = [1, -a];\nd = 1;\n");
}

TEST(Parameters, AreExportedWithTheirRules) {
  const Parsed parsed(
      "/* [ Stone ] */\n"
      "// carat weight\n"
      "carat = 0.5; // [0.25:0.25:3]\n"
      "cut = \"round\"; // [round:Brilliant, oval]\n"
      "count = 3; // [5]\n"
      "name = \"Ada\"; // 8\n"
      "at = [1, -2];\n"
      "open = true;\n"
      "/* [Hidden] */\n"
      "eps = 0.01;\n");
  const auto json =
      nlohmann::json::parse(parameters_json(parsed.program(), "ring"));
  EXPECT_EQ(json["title"], "ring");
  const auto expected = nlohmann::json::parse(R"([
    {"name": "carat", "caption": "carat weight", "group": "Stone",
     "type": "number", "initial": 0.5, "min": 0.25, "max": 3.0, "step": 0.25},
    {"name": "cut", "group": "Stone", "type": "string", "initial": "round",
     "options": [{"name": "Brilliant", "value": "round"},
                 {"name": "oval", "value": "oval"}]},
    {"name": "count", "group": "Stone", "type": "number", "initial": 3.0,
     "min": 0.0, "max": 5.0, "step": 1.0},
    {"name": "name", "group": "Stone", "type": "string", "initial": "Ada",
     "maxLength": 8},
    {"name": "at", "group": "Stone", "type": "number", "initial": [1.0, -2.0]},
    {"name": "open", "group": "Stone", "type": "boolean", "initial": true}
  ])");
  EXPECT_EQ(json["parameters"], expected) << json.dump(2);
}

}  // namespace
}  // namespace lamina
