#include "slicer/machine/estimate.h"

#include <optional>

#include <gtest/gtest.h>

namespace lamina::slicer {
namespace {

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

TEST(EstimatePrint, WeighsAndPrices) {
  Material resin = find_material("prusa-orange-tough");
  resin.price = 60;
  resin.currency = "EUR";
  const PrintEstimate estimate =
      estimate_print(std::nullopt, resin, 100, 2500);
  EXPECT_DOUBLE_EQ(estimate.grams, 2.75);
  EXPECT_DOUBLE_EQ(estimate.price, 0.15);
  EXPECT_EQ(estimate.seconds, 0);
  EXPECT_EQ(estimate_text(std::nullopt, resin, estimate),
            "2.5 ml of Prusa Orange Tough, 2.75 g, 0.15 EUR");
}

TEST(EstimateText, SaysWhatIsKnown) {
  EXPECT_EQ(estimate_text({}, {}, {}), "");
  const Material silver = find_material("sterling-silver");
  const Printer mars = find_printer("elegoo-mars-3");
  EXPECT_EQ(estimate_text(mars, silver, estimate_print(mars, silver, 480, 256)),
            "2.65 g of sterling silver, 2 h 16 min on Elegoo Mars 3 if a layer "
            "is exposed for 8 s");
}

}  // namespace
}  // namespace lamina::slicer
