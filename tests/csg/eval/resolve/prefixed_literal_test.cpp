#include "csg/eval/resolve/prefixed_literal.h"

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

TEST(PrefixedLiteral, HasDigitsOfItsRadixOnly) {
  EXPECT_TRUE(is_prefixed_literal("0xfF"));
  EXPECT_TRUE(is_prefixed_literal("0b01"));
  EXPECT_FALSE(is_prefixed_literal("0b2"));
  EXPECT_FALSE(is_prefixed_literal("0xg"));
  EXPECT_FALSE(is_prefixed_literal("0x"));
  EXPECT_FALSE(is_prefixed_literal("0X1"));
  EXPECT_FALSE(is_prefixed_literal("12"));
}

TEST(PrefixedLiteral, IsExactUpToWhatADoubleHolds) {
  EXPECT_EQ(read_prefixed_literal("0xff").value, 255);
  EXPECT_EQ(read_prefixed_literal("0b101").value, 5);
  const PrefixedLiteral exact = read_prefixed_literal("0x20000000000000");
  EXPECT_EQ(exact.value, 0x1p53);
  EXPECT_EQ(exact.warning, "");
  EXPECT_EQ(read_prefixed_literal("0x20000000000001").warning,
            "Integer \"0x20000000000001\" cannot be represented precisely");
}

TEST(PrefixedLiteral, ThatIsTooLargeIsTheLeastTooLargeNumber) {
  const PrefixedLiteral large = read_prefixed_literal("0x10000000000000000");
  EXPECT_EQ(large.value, 0x1p64);
  EXPECT_EQ(large.warning,
            "Hexadecimal constant \"0x10000000000000000\" too large");
}

}  // namespace
}  // namespace lamina::csg
