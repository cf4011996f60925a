// CLI, byte for byte, as the description of the format has it
// (docs/formats.md).

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "tests/slicer/formats/writing.h"

namespace lamina::slicer {
namespace {

using namespace std::string_literals;

WriterOptions as_cli(CliEncoding encoding) {
  return {.format = OutputFormat::kCli, .cli = encoding};
}

std::string write_cli(const std::vector<Layer>& layers, CliEncoding encoding) {
  return written(layers, as_cli(encoding));
}

constexpr const char* kHeaderAfterEncoding =
    "$$UNITS/1\n"
    "$$VERSION/200\n"
    "$$LABEL/1,part\n"
    "$$DIMENSION/-2.0000000000,0.00000000000,1.00000000000,"
    "4.00000000000,4.00000000000,2.50000000000\n"
    "$$LAYERS/0000000003\n"
    "$$HEADEREND";

TEST(CliWriter, WritesAscii) {
  EXPECT_EQ(write_cli(three_layers(), CliEncoding::kAscii),
            "$$HEADERSTART\n$$ASCII\n"s + kHeaderAfterEncoding +
                "\n$$GEOMETRYSTART\n"
                "$$LAYER/1.5\n"
                "$$POLYLINE/1,1,5,0,0,4,0,4,4,0,4,0,0\n"
                "$$POLYLINE/1,0,5,1,1,1,3,3,3,3,1,1,1\n"
                "$$LAYER/2\n"
                "$$LAYER/2.5\n"
                "$$POLYLINE/1,1,4,-2,0.5,2,0.5,0,3,-2,0.5\n"
                "$$GEOMETRYEND\n");
}

TEST(CliWriter, WritesBinary) {
  // float32, least significant byte first.
  const std::string zero = "\x00\x00\x00\x00"s;
  const std::string half = "\x00\x00\x00\x3F"s;
  const std::string one = "\x00\x00\x80\x3F"s;
  const std::string one_and_half = "\x00\x00\xC0\x3F"s;
  const std::string two = "\x00\x00\x00\x40"s;
  const std::string minus_two = "\x00\x00\x00\xC0"s;
  const std::string two_and_half = "\x00\x00\x20\x40"s;
  const std::string three = "\x00\x00\x40\x40"s;
  const std::string four = "\x00\x00\x80\x40"s;
  const std::string layer = "\x7F\x00"s;
  const auto polyline = [](char direction, char count) {
    // cppcheck-suppress strPlusChar ; a string, by the s behind it
    return "\x82\x00\x01\x00\x00\x00"s + direction + "\x00\x00\x00"s + count +
           "\x00\x00\x00"s;
  };
  EXPECT_EQ(write_cli(three_layers(), CliEncoding::kBinary),
            "$$HEADERSTART\n$$BINARY\n"s + kHeaderAfterEncoding + layer +
                one_and_half + polyline(1, 5) + zero + zero + four + zero +
                four + four + zero + four + zero + zero + polyline(0, 5) + one +
                one + one + three + three + three + three + one + one + one +
                layer + two + layer + two_and_half + polyline(1, 4) +
                minus_two + half + two + half + zero + three + minus_two +
                half);
}

TEST(CliWriter, WritesNumbersWithoutExponents) {
  const std::string text =
      write_cli({layer_at(0, 1, {{{1e-7, 0}, {2, -0.0}, {0, 1e5}}})},
                CliEncoding::kAscii);
  EXPECT_NE(text.find("$$POLYLINE/1,1,4,0.0000001"), std::string::npos) << text;
  EXPECT_NE(text.find(",2,0,0,100000,0.0000001"), std::string::npos) << text;
}

TEST(CliWriter, WritesEveryDigitOfTheSmallestNumbers) {
  // What is left of sines and cosines; every float32 has a name of its own.
  const float tiny = 6.123234e-17F;
  const std::string text =
      write_cli({layer_at(0, 1, {{{double{tiny}, 0}, {2, 0}, {0, 2}}})},
                CliEncoding::kAscii);
  const std::size_t begin = text.find("/1,1,4,") + 7;
  const std::string digits = text.substr(begin, text.find(',', begin) - begin);
  EXPECT_EQ(std::stof(digits), tiny) << digits;
  EXPECT_EQ(digits.find('e'), std::string::npos) << digits;
}

TEST(CliWriter, EndsWellWithoutLayers) {
  const std::string text = write_cli({}, CliEncoding::kAscii);
  EXPECT_NE(text.find("$$LAYERS/0000000000\n$$HEADEREND\n$$GEOMETRYSTART\n"
                      "$$GEOMETRYEND\n"),
            std::string::npos)
      << text;
}

TEST(CliWriter, RefusesLayersOfOneHeight) {
  EXPECT_THROW(write_cli({layer_at(0, 1e6, {}), layer_at(1e6, 1e6 + 0.01, {})},
                         CliEncoding::kBinary),
               FileError);
}

TEST(CliWriter, WarnsWhereNumbersAreCoarse) {
  Diagnostics diagnostics;
  written({layer_at(0, 1, {{{9000, 0}, {9001, 0}, {9001, 1}}})},
          as_cli(CliEncoding::kBinary), diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_NE(diagnostics.all()[0].message.find("the 32-bit numbers of CLI"),
            std::string::npos);
}

}  // namespace
}  // namespace lamina::slicer
