#include "base/fingerprint.h"

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace lamina {
namespace {

// The values that the authors of XXH3 publish for the empty text.
TEST(Fingerprint, IsThatOfXxh3) {
  EXPECT_EQ(fingerprint(""), 0x2D06800538D394C2U);
  EXPECT_EQ(digest(""), "99aa06d3014798d86001c324468d497f");
}

TEST(Digest, OfBlocksIsThatOfAllBytes) {
  std::string bytes;
  for (int i = 0; i < 10'000; ++i) bytes += static_cast<char>(i * i / 7);
  for (const std::size_t size : {1U, 7U, 256U, 9'999U, 10'000U, 20'000U}) {
    std::size_t offset = 0;
    EXPECT_EQ(digest([&] {
                const std::string_view block = std::string_view(bytes).substr(
                    std::min(offset, bytes.size()), size);
                offset += size;
                return block;
              }),
              digest(bytes));
  }
}

TEST(Fingerprint, DiffersForNamesThatDifferInOneDigit) {
  FingerprintSet names;
  for (int i = 0; i < 100'000; ++i) {
    EXPECT_TRUE(names.insert(fingerprint("out/" + std::to_string(i))));
  }
  EXPECT_EQ(names.size(), 100'000U);
  EXPECT_FALSE(names.insert(fingerprint("out/77")));
}

// Few values, so that they often stand in each other's way.
TEST(FingerprintSet, HoldsWhatAnotherSetHolds) {
  std::mt19937 random(7);
  FingerprintSet set;
  std::set<std::uint64_t> expected;
  for (int i = 0; i < 200'000; ++i) {
    const std::uint64_t value = random() % 300;
    if (random() % 3 != 0) {
      EXPECT_EQ(set.insert(value),
                expected.insert(value == 0 ? 1 : value).second);
    } else {
      set.erase(value);
      expected.erase(value == 0 ? 1 : value);
    }
    const std::uint64_t other = 1 + random() % 300;
    ASSERT_EQ(set.contains(other), expected.contains(other));
    ASSERT_EQ(set.size(), expected.size());
  }
}

}  // namespace
}  // namespace lamina
