// Exact sections judge random designs, as many of each kind as
// LAMINA_RANDOM_DESIGNS says. A failure prints the design.
// bench/random_suite tries many more.

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/oracle/random_suite.h"
#include "tests/support/environment.h"
#include "tests/support/random_design.h"

namespace lamina::oracle {
namespace {

class RandomDesigns : public ::testing::TestWithParam<RandomKind> {};

TEST_P(RandomDesigns, EqualTheirExactSections) {
  constexpr std::size_t kLayers = 8;
  const std::uint32_t count = support::number_from("LAMINA_RANDOM_DESIGNS", 50);
  SuiteTally tally;
  for (std::uint32_t seed = 1; seed <= count && tally.failures < 5; ++seed) {
    EXPECT_EQ(try_design(GetParam(), seed, kLayers, tally), "");
  }
  EXPECT_LT(tally.empty_designs, tally.designs) << "nothing was judged";
}

INSTANTIATE_TEST_SUITE_P(
    Oracle, RandomDesigns,
    ::testing::Values(RandomKind::kGrid, RandomKind::kTurnedGrid,
                      RandomKind::kGeneric, RandomKind::kThin,
                      RandomKind::kNear, RandomKind::kModules),
    [](const auto& kind) { return std::string(name_of(kind.param)); });

}  // namespace
}  // namespace lamina::oracle
