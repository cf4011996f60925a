#include "base/utf8.h"

#include <string>

#include <gtest/gtest.h>

namespace lamina {
namespace {

TEST(Utf8, ALeadByteTellsALengthEvenOfBrokenText) {
  EXPECT_EQ(utf8_length('a'), 1U);
  EXPECT_EQ(utf8_length('\xc3'), 2U);
  EXPECT_EQ(utf8_length('\xe2'), 3U);
  EXPECT_EQ(utf8_length('\xf0'), 4U);
  EXPECT_EQ(utf8_length('\x80'), 1U);
  EXPECT_EQ(utf8_length('\xff'), 1U);
}

TEST(Utf8, ACharacterEndsWhereItsBytesDo) {
  EXPECT_EQ(character_length("\xc3\xa9x"), 2U);
  EXPECT_EQ(character_length("\xe2\x82\xac"), 3U);
  EXPECT_EQ(character_length("\xe2\x82"), 0U);
  EXPECT_EQ(character_length("\xe2\x82x"), 0U);
  EXPECT_EQ(character_length("\xa9"), 0U);
}

TEST(Utf8, WellFormedTextHasNoOverlongFormSurrogateOrZero) {
  EXPECT_TRUE(is_valid_utf8(""));
  EXPECT_TRUE(is_valid_utf8("caf\xc3\xa9 \xf0\x9f\x92\x8d"));
  EXPECT_FALSE(is_valid_utf8("\xc0\xaf"));
  EXPECT_FALSE(is_valid_utf8("\xed\xa0\x80"));
  EXPECT_FALSE(is_valid_utf8("\xf4\x90\x80\x80"));
  EXPECT_FALSE(is_valid_utf8(std::string_view("a\0b", 3)));
}

TEST(Utf8, ReadsWhatItAppends) {
  for (const std::uint32_t code : {0x41U, 0xe9U, 0x20acU, 0x1f48dU}) {
    std::string text;
    EXPECT_TRUE(append_utf8(code, text));
    EXPECT_TRUE(is_valid_utf8(text));
    EXPECT_EQ(first_code_point(text), code);
    EXPECT_EQ(character_length(text), text.size());
  }
}

TEST(Utf8, AppendsNothingForWhatIsNoCharacter) {
  std::string text;
  for (const double code : {0.0, -1.0, 55296.0, 57343.0, 1114112.0}) {
    EXPECT_FALSE(append_utf8(code, text));
  }
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace lamina
