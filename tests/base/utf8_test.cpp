#include "base/utf8.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

// What the bytes encode; no value where they are no well-formed character.
std::optional<std::uint32_t> decoded(std::string_view bytes) {
  // Of two, three and four bytes: the first one's mark, and the least number
  // that needs them.
  constexpr std::array<std::uint32_t, 3> kMarks = {0xC0, 0xE0, 0xF0};
  constexpr std::array<std::uint32_t, 3> kLeast = {0x80, 0x800, 0x10000};
  const std::size_t more = bytes.size() - 1;
  const std::uint32_t payload = 0x3FU >> more;
  std::uint32_t code = static_cast<unsigned char>(bytes[0]);
  if ((code & ~payload) != kMarks[more - 1]) return std::nullopt;
  code &= payload;
  for (const char c : bytes.substr(1)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte / 64 != 2) return std::nullopt;
    code = 64 * code + byte % 64;
  }
  const bool is_surrogate = code / 0x800 == 0x1B;
  if (code < kLeast[more - 1] || is_surrogate || code > 0x10FFFF) {
    return std::nullopt;
  }
  return code;
}

// All of two and three bytes; of four those that end in any two of the bytes
// around the ends of what continues a character.
TEST(Utf8, ACharacterIsWellFormed) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  const std::string edges = "\x01\x7f\x80\x81\xbe\xbf\xc0\xff";
  std::array<std::size_t, 3> characters{};
  const auto check = [&](std::string_view bytes) {
    const auto code = decoded(bytes);
    characters[bytes.size() - 2] += code ? 1 : 0;
    // A shorter character may stand in front.
    const std::size_t length = character_length(bytes);
    ASSERT_EQ(length == bytes.size(), code.has_value())
        << ::testing::PrintToString(bytes);
    if (code) {
      ASSERT_EQ(first_code_point(bytes), *code);
    }
  };
  for (int lead = 0x80; lead < 256; ++lead) {
    for (const char second : all) {
      std::string bytes = {static_cast<char>(lead), second};
      check(bytes);
      for (const char third : all) {
        bytes.resize(2);
        check(bytes += third);
      }
      for (const char third : edges) {
        for (const char fourth : edges) {
          bytes.resize(2);
          bytes += third;
          check(bytes += fourth);
        }
      }
    }
  }
  EXPECT_EQ(characters[0], 0x800U - 0x80U);
  EXPECT_EQ(characters[1], 0x10000U - 0x800U - 0x800U);
  // Of every 64 the edges hold four, both times.
  EXPECT_EQ(characters[2], 0x100000U / 64 / 64 * 4 * 4);
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
