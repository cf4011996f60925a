#include "slicer/machine/estimate.h"

#include <optional>

#include <gtest/gtest.h>

namespace lamina::slicer {
namespace {

constexpr double kLayer = 0.05;  // [mm]

// What PrusaSlicer 2.5 writes into archives for its SL1 with 7.5 s and 35 s.
TEST(PrintSeconds, AreThoseOfPrusaSlicer) {
  const Printer sl1 = find_printer("prusa-sl1");
  const Exposure exposure = {7.5, 35};
  EXPECT_DOUBLE_EQ(print_seconds(sl1, exposure, 2), 80.5);
  EXPECT_DOUBLE_EQ(print_seconds(sl1, exposure, 4), 158.5);
  EXPECT_DOUBLE_EQ(print_seconds(sl1, exposure, 10), 332.5);
  EXPECT_DOUBLE_EQ(print_seconds(sl1, exposure, 20), 475);
  EXPECT_DOUBLE_EQ(print_seconds(sl1, exposure, 60), 985);
  EXPECT_DOUBLE_EQ(print_seconds(sl1, exposure, 120), 1750);
}

TEST(PrintSeconds, AreNotGuessed) {
  Printer printer = find_printer("prusa-sl1");
  printer.move_seconds = 0;
  EXPECT_EQ(print_seconds(printer, {}, 100), 0);
}

Material resin_of(std::vector<KnownExposure> exposures) {
  Material resin = find_material("castable-resin");
  resin.exposures = std::move(exposures);
  return resin;
}

TEST(ChooseExposure, TakesThePrinterBeforeTheThickness) {
  const Material resin = resin_of({{{1, 10}, "prusa-sl1", 0.05, ""},
                                   {{2, 20}, "elegoo-mars-4", 0.1, ""},
                                   {{3, 30}, "elegoo-mars-4", 0.025, ""}});
  Machine machine = {find_printer("elegoo-mars-4"), resin, {}};
  ChosenExposure chosen = choose_exposure(machine, 0.1);
  EXPECT_EQ(chosen.exposure.layer, 2);
  EXPECT_EQ(chosen.exposure.first, 20);
  EXPECT_FALSE(chosen.is_assumed);
  EXPECT_EQ(chosen.holds_for, "");
  // The nearest, but it is for others.
  chosen = choose_exposure(machine, 0.03);
  EXPECT_EQ(chosen.exposure.layer, 3);
  EXPECT_TRUE(chosen.is_assumed);
  EXPECT_EQ(chosen.holds_for, "layers of 0.025 mm");
  machine.printer = find_printer("elegoo-saturn");
  chosen = choose_exposure(machine, kLayer);
  EXPECT_EQ(chosen.exposure.layer, 1);
  EXPECT_TRUE(chosen.is_assumed);
  EXPECT_EQ(chosen.holds_for, "prusa-sl1");
}

TEST(ChooseExposure, TakesOneForAllPrintersAndThicknesses) {
  const Machine machine = {
      find_printer("elegoo-saturn"), resin_of({{{4, 40}, "", 0, ""}}), {}};
  const ChosenExposure chosen = choose_exposure(machine, kLayer);
  EXPECT_EQ(chosen.exposure.layer, 4);
  EXPECT_FALSE(chosen.is_assumed);
}

TEST(ChooseExposure, SaysThatTheUsualOneIsAssumed) {
  for (const auto& resin :
       {std::optional<Material>(), std::optional(resin_of({}))}) {
    const ChosenExposure chosen =
        choose_exposure({find_printer("elegoo-saturn"), resin, {}}, kLayer);
    EXPECT_TRUE(chosen.is_assumed);
    EXPECT_EQ(chosen.holds_for, "");
  }
}

TEST(ParsePrice, TakesASumAndAUnit) {
  for (const char* text : {"62.5EUR/g", "62.5 EUR/g"}) {
    const std::optional<Price> price = parse_price(text);
    ASSERT_TRUE(price) << text;
    EXPECT_EQ(price->amount, 62.5);
    EXPECT_EQ(price->currency, "EUR");
    EXPECT_EQ(price->unit, "g");
  }
  EXPECT_EQ(parse_price("60/l")->currency, "");
  for (const char* text : {"", "60", "60 EUR", "/g", "EUR/g", "60/lb", "-1/g",
                           "1e99/g", "nan/g", "6.0.0/g"}) {
    EXPECT_FALSE(parse_price(text)) << text;
  }
}

// A cubic centimetre of gold that weighs 15.4 g. A kilogram has 1000 g, a troy
// ounce 31.1034768 g, a litre 1000 cm³.
TEST(Price, IsOfAWeightOrOfAVolume) {
  EXPECT_DOUBLE_EQ(parse_price("2/g")->of(15.4, 1000), 30.8);
  EXPECT_DOUBLE_EQ(parse_price("2000/kg")->of(15.4, 1000), 30.8);
  EXPECT_DOUBLE_EQ(parse_price("2/oz")->of(31.1034768, 1000), 2);
  EXPECT_DOUBLE_EQ(parse_price("60/l")->of(15.4, 1000), 0.06);
}

TEST(EstimatePrint, WeighsAndPrices) {
  Material resin = find_material("prusa-orange-tough");
  resin.price = Price{60, "EUR", "l"};
  const Machine machine = {{}, resin, {}};
  const PrintEstimate estimate =
      estimate_print(machine, kLayer, 100, 2500, 2500);
  EXPECT_DOUBLE_EQ(estimate.grams, 2.75);
  EXPECT_DOUBLE_EQ(estimate.price, 0.15);
  EXPECT_EQ(estimate.seconds, 0);
  EXPECT_EQ(estimate_text(machine, estimate),
            "2.5 ml of Prusa Orange Tough, 2.75 g, 0.15 EUR");
}

TEST(EstimatePrint, KnowsTheResinAndTheMetalThatIsCast) {
  Machine machine = {find_printer("prusa-sl1"), find_material("bluecast-x10"),
                     find_material("gold-750")};
  machine.metal->price = Price{80, "EUR", "g"};
  const PrintEstimate estimate = estimate_print(machine, kLayer, 1, 256, 256);
  EXPECT_DOUBLE_EQ(estimate.grams, 1.1 * 0.256);
  EXPECT_DOUBLE_EQ(estimate.metal_grams, 15.4 * 0.256);
  EXPECT_DOUBLE_EQ(estimate.metal_price, 80 * 15.4 * 0.256);
  EXPECT_EQ(estimate.weight(), estimate.metal_grams);
  EXPECT_EQ(estimate_text(machine, estimate),
            "0.256 ml of BlueCast X10, 0.282 g, cast in 3.94 g of yellow gold "
            "750 (18 k), 315.39 EUR, 2 min on Original Prusa SL1");
  const PrintEstimate two = estimate + estimate;
  EXPECT_DOUBLE_EQ(two.metal_grams, 2 * estimate.metal_grams);
  EXPECT_DOUBLE_EQ(two.seconds, 2 * estimate.seconds);
}

TEST(EstimateText, SaysWhatIsKnown) {
  EXPECT_EQ(estimate_text({}, {}), "");
  const Machine machine = {
      find_printer("elegoo-mars-3"), {}, find_material("fine-silver")};
  EXPECT_EQ(
      estimate_text(machine, estimate_print(machine, kLayer, 480, 256, 256)),
      "2.69 g of fine silver, 2 h 16 min on Elegoo Mars 3 if a layer is "
      "exposed for 8 s");
}

}  // namespace
}  // namespace lamina::slicer
