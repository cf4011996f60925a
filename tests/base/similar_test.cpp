#include "base/similar.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace lamina {
namespace {

TEST(Similar, IsOneLetterInThreeAtMost) {
  const std::vector<std::string_view> names = {"cube", "sphere", "square"};
  EXPECT_EQ(most_similar("shpere", names), "sphere");  // swapped
  EXPECT_EQ(most_similar("CUBES", names), "cube");
  EXPECT_EQ(most_similar("squre", names), "square");
  EXPECT_EQ(most_similar("cone", names), "cube");
  EXPECT_EQ(most_similar("cylinder", names), "");
  EXPECT_EQ(most_similar("cube", names), "");  // itself
  const std::vector<std::string_view> letters = {"a", "x"};
  EXPECT_EQ(most_similar("X", letters), "x");
  EXPECT_EQ(most_similar("b", letters), "");
}

TEST(SameNames, DifferInCaseAndInWhatStandsBetweenWords) {
  EXPECT_TRUE(is_same_name("elegoo-mars-3", "Elegoo Mars 3"));
  EXPECT_FALSE(is_same_name("elegoo-mars-3", "elegoo-mars-30"));
}

TEST(HasWords, TakesPartsThatBeginWords) {
  const std::string_view text = "elegoo-saturn-4-ultra Elegoo Saturn 4 Ultra";
  for (const std::string_view query :
       {"saturn", "SATURN 4", "saturn4ultra", "4 saturn", "ele ult", "4u"}) {
    EXPECT_TRUE(has_words(text, query)) << query;
  }
  for (const std::string_view query :
       {"aturn", "saturn 3", "ultra saturns", "4", "", " ", "turn4"}) {
    EXPECT_FALSE(has_words(text, query)) << query;
  }
  EXPECT_TRUE(has_words("gold-18k", "18 k"));
}

// All of 20,000 among 20,000 would take minutes.
TEST(Guesses, OfManyNamesAreForTheFirst) {
  std::vector<std::string> texts;
  for (int i = 0; i < 20'000; ++i) {
    texts.push_back(fmt::format("variable_{:05}", i));
  }
  const std::vector<std::string_view> names(texts.begin(), texts.end());
  Guesses guesses;
  std::size_t count = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (guesses.are_over()) break;
    const std::string hint =
        guesses.did_you_mean(fmt::format("variables_{:05}", i), names);
    if (!hint.empty()) ++count;
  }
  EXPECT_TRUE(guesses.are_over());
  EXPECT_EQ(guesses.did_you_mean("variabel_00001", names), "");
  // 15 letters beside 14 in each of the names, 30 million pairs in all.
  EXPECT_EQ(count, 30'000'000 / (15 * 14 * 20'000));
}

TEST(Guesses, OfAFewNamesAreForAll) {
  const std::vector<std::string_view> names = {"cube", "sphere", "square"};
  Guesses guesses;
  for (int i = 0; i < 10'000; ++i) {
    ASSERT_EQ(guesses.did_you_mean("shpere", names), "did you mean 'sphere'?");
  }
}

}  // namespace
}  // namespace lamina
