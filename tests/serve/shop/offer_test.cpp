// Offers: schemas and checks. (schema_test.py holds the two against each
// other.)

#include "serve/shop/offer.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "parser/customizer/parameter_set.h"
#include "serve/shop/order.h"
#include "tests/serve/shop/random_offers.h"

namespace lamina::shop {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kDesign = R"(
/* [Stone] */
// carat weight
carat = 0.5;  // [0.2:0.05:3]
stones = 1;  // [0:4]
show_stone = true;
/* [Ring] */
size_system = "ISO";  // [ISO:ISO 8653, US:American]
width = 2.3;  // [1:0.5:4]
gap = 0.1;
// inside
engraving = "Für";  // 8
offset = [0, 1.5];  // [0:0.5:2]
)";

std::string fault_of(const std::string& values, const char* design = kDesign) {
  try {
    Offer(ReadDesign(design).parameters()).check(values);
  } catch (const OrderError& error) {
    return error.what();
  }
  return "none";
}

// The values of all parameters, as the schema and an order say.
Json with_defaults(const Offer& offer, const std::string& values) {
  const Json schema = offer.schema("");
  Json all = Json::object();
  for (const auto& [name, property] : schema["properties"].items()) {
    all[name] = property["default"];
  }
  all.update(Json::parse(values));
  return all;
}

TEST(Offer, IsTheSchemaOfTheCustomizer) {
  const Json expected = Json::parse(R"({
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "solitaire",
    "type": "object",
    "properties": {
      "carat": {"type": "number", "description": "carat weight",
                "default": 0.5, "minimum": 0.2, "maximum": 3, "x-step": 0.05,
                "x-group": "Stone"},
      "stones": {"type": "number", "default": 1, "minimum": 0, "maximum": 4,
                 "multipleOf": 1, "x-step": 1, "x-group": "Stone"},
      "show_stone": {"type": "boolean", "default": true, "x-group": "Stone"},
      "size_system": {"type": "string", "default": "ISO",
                      "oneOf": [{"const": "ISO", "title": "ISO 8653"},
                                {"const": "US", "title": "American"}],
                      "x-group": "Ring"},
      "width": {"type": "number", "default": 2.3, "minimum": 1, "maximum": 4,
                "anyOf": [{"const": 2.3}, {"multipleOf": 0.5}], "x-step": 0.5,
                "x-group": "Ring"},
      "gap": {"type": "number", "default": 0.1, "x-step": 1,
              "x-group": "Ring"},
      "engraving": {"type": "string", "description": "inside",
                    "default": "Für", "maxLength": 8, "x-maxBytes": 8,
                    "x-group": "Ring"},
      "offset": {"type": "array", "default": [0, 1.5],
                 "items": {"type": "number", "minimum": 0, "maximum": 2},
                 "minItems": 2, "maxItems": 2, "x-step": 0.5,
                 "x-group": "Ring"}
    },
    "additionalProperties": false})");
  const Offer offer(ReadDesign(kDesign).parameters());
  EXPECT_EQ(offer.schema("solitaire").dump(1), expected.dump(1));
}

TEST(Offer, SaysWhatIsNotOffered) {
  EXPECT_EQ(fault_of(R"({"carat": 3.05})"), "values/carat must be at most 3");
  EXPECT_EQ(fault_of(R"({"carat": 0})"), "values/carat must be at least 0.2");
  EXPECT_EQ(fault_of(R"({"carat": 0.22})"),
            "values/carat must be 0.2 or a number of steps of 0.05 above it");
  EXPECT_EQ(fault_of(R"({"carat": "0.2"})"), "values/carat must be a number");
  EXPECT_EQ(fault_of(R"({"stone": 1})"),
            "values/stone is not a parameter of this design: did you mean "
            "'stones'?");
  EXPECT_EQ(fault_of(R"({"show_stone": 1})"),
            "values/show_stone must be true or false");
  EXPECT_EQ(fault_of(R"({"size_system": "EU"})"),
            "values/size_system must be one of 'ISO', 'US'");
  EXPECT_EQ(fault_of(R"({"engraving": 5})"), "values/engraving must be a text");
  EXPECT_EQ(fault_of(R"({"engraving": "ééééé"})"),
            "values/engraving must have at most 8 bytes of UTF-8");
  EXPECT_EQ(fault_of(R"({"offset": [1]})"),
            "values/offset must be a list of 2 numbers");
  EXPECT_EQ(fault_of(R"({"offset": [1, "2"]})"),
            "values/offset must be a list of 2 numbers");
  EXPECT_EQ(fault_of(R"({"offset": [1, 2.1]})"),
            "values/offset/1 must be at most 2");
  EXPECT_EQ(fault_of(R"({"carat": 9, "stones": {}})"),
            "values/carat must be at most 3; values/stones must be a number");
}

TEST(Offer, AcceptsStepsAsPeopleAndProgramsWriteThem) {
  for (int i = 0; i <= 56; ++i) {
    const double written = std::stod(std::to_string(0.2 + i * 0.05));
    // Sums of doubles may end above the greatest value.
    const double counted = std::min(0.2 + i * 0.05, 3.0);
    EXPECT_EQ(fault_of(Json{{"carat", written}}.dump()), "none");
    EXPECT_EQ(fault_of(Json{{"carat", counted}}.dump()), "none");
  }
  EXPECT_EQ(fault_of(R"({"gap": 0.123})"), "none");
  EXPECT_EQ(fault_of(R"({"offset": [0.1, 0.2]})"), "none");
}

TEST(Offer, AlwaysAcceptsTheDesignsOwnValue) {
  EXPECT_EQ(fault_of(R"({"width": 2.3})"), "none");
  EXPECT_NE(fault_of(R"({"width": 2.4})"), "none");
}

TEST(Offer, MakesASetOfWhatDiffers) {
  const Offer offer(ReadDesign(kDesign).parameters());
  const ParameterSet set = offer.check(
      R"({"carat": 0.5, "gap": 0.30000000000000004, "offset": [1, 0.5],
          "engraving": "[1]", "show_stone": false})");
  ASSERT_EQ(set.size(), 4U);
  EXPECT_EQ(set[0].text, "0.30000000000000004");
  EXPECT_EQ(set[1].text, "[1, 0.5]");
  EXPECT_EQ(set[2].text, "[1]");
  EXPECT_EQ(set[3].text, "false");
}

TEST(Offer, TellsOptionsApartAsParameterSetsDo) {
  const char* design = "a = \"1\";  // [1, 2, 1]\nb = 2;  // [1, two]\n";
  EXPECT_EQ(fault_of(R"({"a": "1", "b": "two"})", design), "none");
  EXPECT_EQ(fault_of(R"({"a": 2, "b": 1})", design), "none");
  EXPECT_EQ(fault_of(R"({"a": 1})", design), "values/a must be one of '1', 2");
  const Json schema = Offer(ReadDesign(design).parameters()).schema("x");
  EXPECT_EQ(schema["properties"]["a"]["type"], Json({"number", "string"}));
}

// A greatest value alone makes 0 the least one, which is above this design's.
TEST(Offer, HasARangeAroundTheDesignsOwnValue) {
  const char* design = "a = -3;  // [10]\n";
  EXPECT_EQ(fault_of(R"({"a": -3})", design), "none");
  EXPECT_EQ(fault_of(R"({"a": -4})", design), "values/a must be at least -3");
}

TEST(Offer, OfADesignWithoutParametersIsEmpty) {
  EXPECT_EQ(fault_of("{}", "cube();"), "none");
  EXPECT_EQ(Offer(ReadDesign("cube();").parameters())
                .schema("x")["properties"]
                .dump(),
            "{}");
}

// A step that no double could tell from the next one binds nobody.
TEST(Offer, CountsNoStepsThatAreTooFine) {
  const char* design = "a = 1;  // [0:1e-12:1000]\n";
  EXPECT_EQ(fault_of(R"({"a": 0.33333333333333331})", design), "none");
  EXPECT_FALSE(Offer(ReadDesign(design).parameters())
                   .schema("x")["properties"]["a"]
                   .contains("x-step"));
}

// The law of the whole: with the set the design has exactly the values that
// came, and nothing is to be warned of.
TEST(Offer, GivesTheDesignExactlyTheValues) {
  int accepted = 0;
  for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
    support::SeededChoices choices(seed);
    const std::string text = random_design(choices);
    ReadDesign design(text);
    const Json parameters = design.parameters();
    const Offer offer(parameters);
    const std::string values =
        read_order(Json{{"values", random_values(parameters, choices)}}.dump())
            .values;
    ParameterSet set;
    try {
      set = offer.check(values);
    } catch (const OrderError&) {
      continue;
    }
    ++accepted;
    Diagnostics diagnostics;
    ASSERT_TRUE(apply_parameter_set(set, design.program(), Language::k2026,
                                    diagnostics));
    ASSERT_TRUE(diagnostics.all().empty())
        << text << values << diagnostics.all().front().message;
    const Json expected = with_defaults(offer, values);
    const Json changed = design.parameters();
    for (const Json& parameter : changed) {
      const std::string name = parameter["name"];
      ASSERT_EQ(expected[name], parameter["initial"]) << text << values;
    }
    ASSERT_EQ(expected.size(), changed.size());
  }
  EXPECT_GT(accepted, 500);
}

}  // namespace
}  // namespace lamina::shop
