// Exact sections judge random designs. A failure prints the design.
// bench/random_suite tries many more.

#include <cstdint>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/oracle/random_suite.h"
#include "tests/support/random_design.h"

namespace lamina::oracle {
namespace {

// How many designs of each kind: LAMINA_RANDOM_DESIGNS, else a quick few.
std::uint32_t design_count() {
  constexpr std::uint32_t kQuick = 50;
  const char* wanted = std::getenv("LAMINA_RANDOM_DESIGNS");
  if (wanted == nullptr) return kQuick;
  return static_cast<std::uint32_t>(std::strtoul(wanted, nullptr, 10));
}

class RandomDesigns : public ::testing::TestWithParam<RandomKind> {};

TEST_P(RandomDesigns, EqualTheirExactSections) {
  constexpr std::size_t kLayers = 8;
  SuiteTally tally;
  for (std::uint32_t seed = 1; seed <= design_count() && tally.failures < 5;
       ++seed) {
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
