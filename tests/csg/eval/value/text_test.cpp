#include "csg/eval/value/text.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

std::string stream_text(double number) {
  std::string text;
  append_stream_number(number, text);
  return text;
}

std::string printf_text(double number) {
  char text[64];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

// `.csg` numbers are those of a C++ stream, which are printf's.
TEST(AppendStreamNumber, IsPrintfsG) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t bits = random();
    const double any = std::bit_cast<double>(bits);
    const double decimal = static_cast<double>(bits >> 40) /
                           std::pow(10.0, static_cast<double>(bits % 20));
    ASSERT_EQ(stream_text(any), printf_text(any));
    ASSERT_EQ(stream_text(-decimal), printf_text(-decimal));
  }
  for (const double number :
       {0.0, -0.0, 1.0, -7.0, 999999.0, 1e6, 999999.5, 0.1, 1e-5, 123456.5,
        std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(stream_text(number), printf_text(number));
  }
}

}  // namespace
}  // namespace lamina::csg
