// Random designs under laws: a few of each as a test, many where
// LAMINA_LAW_TRIALS says how many and LAMINA_LAW_SEED where to begin. The same
// laws steered by coverage: tests/fuzz/scene_fuzzer.cpp.

#include <cstdint>
#include <iostream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/environment.h"
#include "tests/support/scene_laws.h"

namespace lamina {
namespace {

using support::number_from;

class RandomLaws : public ::testing::TestWithParam<std::size_t> {};

TEST_P(RandomLaws, HoldForRandomDesigns) {
  const std::uint32_t count = number_from("LAMINA_LAW_TRIALS", 40);
  const std::uint32_t first = number_from("LAMINA_LAW_SEED", 1);
  support::LawTally tally;
  int failures = 0;
  for (std::uint32_t seed = first; seed - first < count && failures < 20;
       ++seed) {
    // Other designs for each law.
    const auto mixed = static_cast<std::uint32_t>(support::law_count());
    support::SeededChoices choices(seed * mixed +
                                   static_cast<std::uint32_t>(GetParam()));
    const std::string complaint =
        try_law(GetParam(), support::draw_operands(GetParam(), choices), tally);
    if (complaint.empty()) continue;
    ++failures;
    ADD_FAILURE() << "seed " << seed << ", " << complaint;
  }
  std::cout << tally.trials << " trials, " << tally.refused << " refused\n";
  // What the language has no objection to is rarely refused.
  EXPECT_LT(tally.refused, tally.trials / 10 + 1) << tally.last_refusal;
}

INSTANTIATE_TEST_SUITE_P(Laws, RandomLaws,
                         ::testing::Range(std::size_t{0}, support::law_count()),
                         [](const auto& law) {
                           return std::string(support::law_name(law.param));
                         });

}  // namespace
}  // namespace lamina
