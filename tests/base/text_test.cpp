#include "base/text.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace lamina {
namespace {

std::string of_value(double number) {
  std::string text;
  append_number(number, text);
  return text;
}
std::string of_stream(double number) {
  std::string text;
  append_stream_number(number, text);
  return text;
}

TEST(NumberText, ValuesAndStreamsDifferInExponentsAndZero) {
  EXPECT_EQ(of_value(1.0 / 3), "0.333333");
  EXPECT_EQ(of_stream(1.0 / 3), "0.333333");
  EXPECT_EQ(of_value(1e6), "1e+6");
  EXPECT_EQ(of_stream(1e6), "1e+06");
  EXPECT_EQ(of_value(-0.0), "0");
  EXPECT_EQ(of_stream(-0.0), "-0");
  EXPECT_EQ(of_value(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(of_stream(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(of_value(-999999), "-999999");
}

TEST(ShortName, IsAsLongAsAHundredCharacters) {
  const auto times = [](int count, const std::string& word,
                        std::string text = "") {
    for (int i = 0; i < count; ++i) text += word;
    return text;
  };
  for (const std::string character : {"a", "é", "€", "😀"}) {
    EXPECT_EQ(short_name(times(100, character)), times(100, character));
    EXPECT_EQ(short_name(times(101, character)),
              times(100, character).append("…"));
    EXPECT_EQ(short_name(times(100'000, character, "a")),
              times(99, character, "a").append("…"));
  }
  EXPECT_EQ(short_name("a\nb\tc\xff"), "a\\u000Ab c\uFFFD");
  EXPECT_EQ(short_name(""), "");
}

TEST(MessageText, HasNoLineThatCouldBeAMessage) {
  EXPECT_EQ(message_text("a\nerror: b\n\x1b"), "a\n| error: b\n| \\u001B");
}

TEST(QuotedText, EscapesWhatALiteralCannotHold) {
  EXPECT_EQ(in_quotes("a\t\"b\"\\\n"), R"("a\t\"b\"\\\n")");
}

}  // namespace
}  // namespace lamina
