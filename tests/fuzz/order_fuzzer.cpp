// Orders of strangers: as a body, as a query, and as values of a design.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "serve/shop/offer.h"
#include "serve/shop/order.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

// A parameter of each kind, as serve::parameters_of() writes it.
constexpr const char* kParameters = R"([
  {"name": "carat", "initial": 0.5, "min": 0.2, "max": 3, "step": 0.05},
  {"name": "stones", "initial": 1, "min": 0, "max": 4, "step": 1},
  {"name": "gap", "initial": 0.1, "step": 1},
  {"name": "show", "initial": true},
  {"name": "text", "initial": "a", "maxLength": 4},
  {"name": "size", "initial": "ISO",
   "options": [{"name": "ISO", "value": "ISO"}, {"name": "6", "value": 6}]},
  {"name": "offset", "initial": [0, 1], "min": 0, "max": 2, "step": 0.5}])";

void check(const shop::Order& order) {
  static const shop::Offer offer(nlohmann::ordered_json::parse(kParameters));
  const ParameterSet set = offer.check(order.values);
  static const nlohmann::ordered_json schema = offer.schema("");
  auto all = nlohmann::ordered_json::object();
  for (const auto& [name, property] : schema["properties"].items()) {
    all[name] = property["default"];
  }
  all.update(nlohmann::ordered_json::parse(order.values));
  fuzz::require(offer.check(all.dump()).size() == set.size(),
                "with its defaults an order is as good");
}

void read(std::string_view text) {
  try {
    const shop::Order order = shop::read_order(text);
    fuzz::require(
        shop::read_order(order.canonical).canonical == order.canonical,
        "a canonical order is its own");
    check(order);
  } catch (const shop::OrderError&) {
  } catch (const shop::MalformedOrder&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view text = fuzz::as_text(data, size);
  read(text);
  try {
    read(shop::order_of_query(text));
  } catch (const shop::MalformedOrder&) {
  }
  return 0;
}
