// Orders: what is read, what is refused, and the requests that they make.

#include "serve/shop/order.h"

#include <string>

#include <gtest/gtest.h>

namespace lamina::shop {
namespace {

const std::string kOrder = R"({
  "values": {"carat": 0.5, "size_system": "ISO", "show_stone": false},
  "layer": 0.05, "minFeature": 0.3, "supports": true, "hollow": 1.2,
  "sprue": false, "printer": "elegoo-mars-3", "material": "bluecast-x10",
  "metal": "sterling-silver"})";

// "400: …" or "422: …".
template <typename Call>
std::string fault_of(const Call& call) {
  try {
    call();
  } catch (const MalformedOrder& error) {
    return std::string("400: ") + error.what();
  } catch (const OrderError& error) {
    return std::string("422: ") + error.what();
  }
  return "none";
}
std::string fault_of_order(const std::string& json) {
  return fault_of([&] { read_order(json); });
}
std::string canonical(const std::string& json) {
  return read_order(json).canonical;
}

std::string nested(int levels) {
  const auto count = static_cast<std::size_t>(levels - 2);
  return R"({"values": {"a": )" + std::string(count, '[') + "1" +
         std::string(count, ']') + "}}";
}

TEST(Order, IsReadAsWritten) {
  const Order order = read_order(kOrder);
  EXPECT_EQ(order.values,
            R"({"carat":0.5,"show_stone":false,"size_system":"ISO"})");
  EXPECT_EQ(order.layer, 0.05);
  EXPECT_EQ(order.min_feature, 0.3);
  EXPECT_EQ(order.supports, true);
  EXPECT_EQ(order.hollow, 1.2);
  EXPECT_EQ(order.sprue, false);
  EXPECT_EQ(order.printer, "elegoo-mars-3");
  EXPECT_EQ(order.material, "bluecast-x10");
  EXPECT_EQ(order.metal, "sterling-silver");
}

TEST(Order, MayBeEmpty) {
  for (const char* json :
       {"", "{}", R"({"values": {}})", R"({"layer": null, "values": null})",
        R"({"values": {"carat": null}})"}) {
    const Order order = read_order(json);
    EXPECT_EQ(order.values, "{}") << json;
    EXPECT_EQ(order.canonical, "{}") << json;
    EXPECT_FALSE(order.layer) << json;
  }
}

TEST(Order, IsTheSameTextWhereItIsTheSameOrder) {
  EXPECT_EQ(canonical(R"({"layer": 1, "hollow": 0, "values": {"b": [1, -0.0],
                          "a": 5e-1}})"),
            canonical(R"({"values":{"a":0.50,"b":[1.0,0e3],"c":null},
                          "hollow":-0,"layer":10e-1})"));
  EXPECT_EQ(canonical(R"({"values": {"a": "\u00e9"}})"),
            canonical(R"({"values": {"\u0061": "é"}})"));
  EXPECT_EQ(canonical(kOrder), canonical(canonical(kOrder)));
  EXPECT_NE(canonical(R"({"printer": ""})"), canonical("{}"));
  EXPECT_NE(canonical(R"({"values": {"a": "1"}})"),
            canonical(R"({"values": {"a": 1}})"));
  EXPECT_NE(canonical(R"({"values": {"a": true}})"),
            canonical(R"({"values": {"a": 1}})"));
}

TEST(Order, KeepsDoublesExactly) {
  EXPECT_EQ(read_order(R"({"layer": 0.30000000000000004})").layer, 0.1 + 0.2);
  EXPECT_EQ(read_order(R"({"values": {"a": 9007199254740993}})").values,
            R"({"a":9.007199254740992e+15})");
  EXPECT_EQ(read_order(R"({"values": {"a": 1e300}})").values,
            R"({"a":1e+300})");
}

TEST(Order, ThatIsNotJsonIsMalformed) {
  EXPECT_EQ(fault_of_order("{"),
            "400: the order is not JSON: see its character 2");
  for (const char* json :
       {" ", "{}{}", "{'layer': 1}", R"({"layer": 1,})", R"({"layer": NaN})",
        R"({"layer": 01})", "{\"printer\": \"\xFF\"}",
        R"({"printer": "\ud800"})", "{\"printer\": \"a\nb\"}"}) {
    EXPECT_EQ(fault_of_order(json).substr(0, 4), "400:") << json;
  }
  EXPECT_EQ(fault_of_order(std::string("{}\0", 3)).substr(0, 4), "400:");
}

TEST(Order, RefusesWhatIsNotAsTheDocumentSays) {
  EXPECT_EQ(fault_of_order("[]"),
            "422: an order must be an object, such as {\"layer\": 0.05}");
  EXPECT_EQ(fault_of_order(R"({"layr": 1})"),
            "422: 'layr' is not a member of an order: did you mean 'layer'?");
  EXPECT_EQ(fault_of_order(R"({"x": 1})"),
            "422: 'x' is not a member of an order");
  EXPECT_EQ(fault_of_order(R"({"layer": "1"})"), "422: layer must be a number");
  EXPECT_EQ(fault_of_order(R"({"supports": 1})"),
            "422: supports must be true or false");
  EXPECT_EQ(fault_of_order(R"({"metal": 5})"), "422: metal must be a text");
  EXPECT_EQ(fault_of_order(R"({"values": []})"),
            "422: values must be an object");
}

TEST(Order, RefusesWhatReadersUnderstandInDifferentWays) {
  EXPECT_EQ(fault_of_order(R"({"layer": 1, "layer": 2})"),
            "422: 'layer' is there twice");
  EXPECT_EQ(fault_of_order(R"({"values": {"a": 1, "\u0061": 2}})"),
            "422: 'a' is there twice");
  EXPECT_EQ(fault_of_order(R"({"values": {"layer": 1}, "layer": 2})"), "none");
  EXPECT_EQ(fault_of_order(R"({"layer": 1e400})"),
            "422: a number of the order is beyond those of a double");
  EXPECT_EQ(fault_of_order(R"({"printer": "a\u0000"})"),
            "422: a text of the order has a zero byte");
  EXPECT_EQ(fault_of_order(R"({"values": {"a\u0000": 1}})"),
            "422: a text of the order has a zero byte");
  EXPECT_EQ(fault_of_order(nested(8)), "none");
  EXPECT_EQ(fault_of_order(nested(9)),
            "422: an order is nested at most 8 levels deep");
  EXPECT_EQ(fault_of_order(std::string(60000, '[')),
            "422: an order is nested at most 8 levels deep");
}

TEST(Query, IsDecoded) {
  EXPECT_EQ(order_of_query("order=%7B%22layer%22%3A+1%7D"), R"({"layer": 1})");
  EXPECT_EQ(order_of_query("format=slc&order=%c3%A9&x"), "é");
  EXPECT_EQ(query_value("format=slc&order={}", "format"), "slc");
  EXPECT_EQ(query_value("a=b=c", "a"), "b=c");
  for (const char* query : {"", "order", "order=", "orders=1", "&&", "=1"}) {
    EXPECT_EQ(order_of_query(query), "") << query;
  }
}

TEST(Query, ThatCannotBeDecodedIsMalformed) {
  for (const char* query : {"order=%", "order=%2", "order=%2x", "order=%%41"}) {
    EXPECT_EQ(fault_of([&] { order_of_query(query); }),
              "400: the address has a '%' without two hex digits");
  }
  EXPECT_EQ(fault_of([] { order_of_query("order=1&order=1"); }),
            "400: the query has 'order' twice");
}

class RequestOfAnOrder : public ::testing::Test {
 protected:
  compiler::Request request_of(const std::string& json) const {
    return shop::request_of(read_order(json), {{"carat", "0.5"}}, base,
                            serve::known_names(base, {}));
  }
  std::string fault(const std::string& json) const {
    return fault_of([&] { request_of(json); });
  }

  compiler::Request base;
};

TEST_F(RequestOfAnOrder, HasWhatItSays) {
  const compiler::Request request = request_of(kOrder);
  ASSERT_TRUE(request.design.parameters);
  EXPECT_EQ(request.design.parameters->front().text, "0.5");
  EXPECT_EQ(request.job.layer_thickness, 0.05);
  EXPECT_EQ(request.job.min_feature, 0.3);
  ASSERT_TRUE(request.supports);
  EXPECT_EQ(request.supports->tip, 0);  // the material's
  ASSERT_TRUE(request.hollow);
  EXPECT_EQ(request.hollow->wall, 1.2);
  EXPECT_TRUE(request.hollow->has_drains);
  EXPECT_FALSE(request.sprues);
  EXPECT_EQ(request.output.printer, "elegoo-mars-3");
  EXPECT_EQ(request.output.material, "bluecast-x10");
  EXPECT_EQ(request.output.metal, "sterling-silver");
}

TEST_F(RequestOfAnOrder, KeepsWhatItDoesNotSay) {
  base.job.layer_thickness = 0.03;
  base.job.min_feature = 0.2;
  base.supports = slicer::SupportSizes{.tip = 0.4, .has_raft = true};
  base.support_lines.without = {"12"};
  base.raft_label = "A1";
  base.hollow = slicer::HollowSizes{.wall = 1, .drain_diameter = 2};
  base.output.material = "bluecast-x10";
  const compiler::Request request = request_of("");
  EXPECT_EQ(request.job.layer_thickness, 0.03);
  EXPECT_EQ(request.job.min_feature, 0.2);
  EXPECT_EQ(request.supports->tip, 0.4);
  EXPECT_EQ(request.hollow->wall, 1);
  EXPECT_EQ(request.output.material, "bluecast-x10");

  const compiler::Request changed =
      request_of(R"({"supports": true, "hollow": 2, "sprue": false})");
  EXPECT_EQ(changed.supports->tip, 0.4);
  EXPECT_EQ(changed.raft_label, "A1");
  EXPECT_EQ(changed.hollow->wall, 2);
  EXPECT_EQ(changed.hollow->drain_diameter, 2);

  const compiler::Request without = request_of(
      R"({"supports": false, "hollow": 0, "minFeature": 0, "material": ""})");
  EXPECT_FALSE(without.supports);
  EXPECT_FALSE(without.hollow);
  EXPECT_EQ(without.job.min_feature, 0);
  EXPECT_EQ(without.output.material, "");
}

TEST_F(RequestOfAnOrder, KeepsItsLimitsInTheOrdersWords) {
  EXPECT_EQ(fault(R"({"layer": 0})"),
            "422: layer must be more than 0 mm, not 0");
  EXPECT_EQ(fault(R"({"minFeature": -1})"),
            "422: minFeature must be 0.001 to 10 mm, not -1");
  EXPECT_EQ(fault(R"({"hollow": 0.05})"),
            "422: hollow must be a wall of 0.1 mm or more, not 0.05");
  EXPECT_EQ(fault(R"({"hollow": 1, "sprue": true})"),
            "422: sprue plans the flow into a solid piece, not into a hollow "
            "one");
  EXPECT_EQ(fault(R"({"sprue": true})"), "none");
}

TEST_F(RequestOfAnOrder, NamesOnlyWhatIsListed) {
  for (const char* name : {"printer", "material", "metal"}) {
    const std::string order =
        std::string("{\"") + name + "\": \"/etc/passwd\"}";
    EXPECT_THROW(request_of(order), serve::NameError) << name;
  }
  EXPECT_THROW(request_of(R"({"material": "sterling-silver"})"),
               serve::NameError);
}

TEST_F(RequestOfAnOrder, KnowsMaterialsByTheirOtherNames) {
  EXPECT_EQ(request_of(R"({"metal": "gold-750"})").output.metal,
            "gold-18k-yellow");
  base.output.metal = "sterling-silver";
  base.output.prices = {*slicer::parse_price("1.2 EUR/g")};
  EXPECT_EQ(request_of(R"({"metal": "silver-925"})").output.prices.size(), 1U);
}

// 55 EUR/kg of silver is not the price of gold.
TEST_F(RequestOfAnOrder, HasPricesOnlyOfTheirOwnMaterial) {
  base.output.material = "bluecast-x10";
  base.output.metal = "sterling-silver";
  base.output.prices = {*slicer::parse_price("55 EUR/kg"),
                        *slicer::parse_price("1.2 EUR/g")};
  const auto units = [&](const std::string& json) {
    std::string all;
    for (const auto& price : request_of(json).output.prices) all += price.unit;
    return all;
  };
  EXPECT_EQ(units("{}"), "kgg");
  EXPECT_EQ(units(R"({"metal": "gold-18k-yellow"})"), "kg");
  EXPECT_EQ(units(R"({"metal": ""})"), "kg");
  EXPECT_EQ(units(R"({"material": ""})"), "g");
  EXPECT_EQ(units(R"({"material": "", "metal": ""})"), "");
}

}  // namespace
}  // namespace lamina::shop
