// Prints offers and values, one JSON in a line each: the schema of the offer,
// the values, and whether it accepts them.
//
// usage: offer_cases FIRST_SEED SEEDS

#include <cstdint>
#include <iostream>
#include <string>

#include "serve/run/messages.h"
#include "serve/shop/offer.h"
#include "serve/shop/order.h"
#include "tests/serve/shop/random_offers.h"

using namespace lamina;

namespace {

constexpr int kValuesOfADesign = 20;

bool accepts(const shop::Offer& offer, const std::string& values) {
  try {
    offer.check(shop::read_order("{\"values\": " + values + "}").values);
    return true;
  } catch (const shop::OrderError&) {
    return false;
  }
}

void print_cases(std::uint32_t seed) {
  support::SeededChoices choices(seed);
  const shop::ReadDesign design(shop::random_design(choices));
  const nlohmann::ordered_json parameters = design.parameters();
  const shop::Offer offer(parameters);
  for (int i = 0; i < kValuesOfADesign; ++i) {
    const auto values = shop::random_values(parameters, choices);
    std::cout << serve::text_of({{"seed", seed},
                                 {"schema", offer.schema("design")},
                                 {"values", values},
                                 {"accepted", accepts(offer, values.dump())}})
              << "\n";
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 2;
  const auto first = static_cast<std::uint32_t>(std::stoul(words[1]));
  const auto seeds = static_cast<std::uint32_t>(std::stoul(words[2]));
  for (std::uint32_t seed = first; seed < first + seeds; ++seed) {
    print_cases(seed);
  }
}
