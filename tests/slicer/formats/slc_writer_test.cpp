// SLC, byte for byte. What stands here is spelled out from the description of
// the format (docs/formats.md), not from what the writer once wrote.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "base/version.h"
#include "slicer/formats/slc_reader.h"
#include "tests/slicer/formats/writing.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {
namespace {

using namespace std::string_literals;
using support::TemporaryFolder;

std::string write_slc(const std::vector<Layer>& layers,
                      std::optional<double> deviation = {}) {
  return written(layers,
                 {.format = OutputFormat::kSlc, .deviation = deviation});
}

// What the reader makes of `bytes`.
std::vector<SlcLayer> layers_of(const std::string& bytes) {
  const TemporaryFolder folder;
  SlcReader reader(folder.write("a.slc", bytes));
  std::vector<SlcLayer> layers;
  SlcLayer layer;
  while (reader.read_layer(layer)) layers.push_back(layer);
  return layers;
}

// Equal contours are rounded once, whatever stands between them.
TEST(SlcWriter, WritesALayerAlikeWhateverWasBefore) {
  const std::vector<std::vector<Vec2>> near = {
      {{100, 0}, {101, 0}, {101, 1}, {100, 1}},
      {{101.000001, 0}, {102, 0}, {102, 1}, {101.000001, 1}}};
  const std::vector<std::vector<Vec2>> apart = {
      {{100, 0}, {101, 0}, {101, 1}, {100, 1}}};
  const auto all = layers_of(write_slc(
      {layer_at(0, 1, near), layer_at(1, 2, near), layer_at(2, 3, {}),
       layer_at(3, 4, near), layer_at(4, 5, apart), layer_at(5, 6, near)}));
  ASSERT_GE(all.size(), 6U);
  for (const std::size_t i : {0, 1, 3, 5}) {
    const auto alone = layers_of(write_slc({layer_at(0, 1, near)}));
    ASSERT_EQ(all[i].boundaries.size(), alone[0].boundaries.size()) << i;
    for (std::size_t k = 0; k < alone[0].boundaries.size(); ++k) {
      EXPECT_EQ(all[i].boundaries[k].points, alone[0].boundaries[k].points);
    }
  }
  EXPECT_EQ(all[2].boundaries.size(), 0U);
  EXPECT_EQ(all[4].boundaries.size(), 1U);
}

TEST(SlcWriter, WritesEveryByteOfTheFormat) {
  // A square of 4 mm with a square hole of 2 mm, an empty layer, a triangle;
  // layers of 0.5 mm from z = 1.
  const std::string bytes =
      write_slc({layer_at(1.0, 1.5,
                          {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                           {{1, 1}, {1, 3}, {3, 3}, {3, 1}}}),
                 layer_at(1.5, 2.0, {}),
                 layer_at(2.0, 2.5, {{{-2, 0.5}, {2, 0.5}, {0, 3}}})});

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
  const auto count = [](char n) { return n + "\x00\x00\x00"s; };

  const std::string expected =
      // 1. header
      "-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE lamina " +
      std::string(version()) +
      " -EXTENTS -2.0000000000,4.00000000000 0.00000000000,4.00000000000 "
      "1.00000000000,2.50000000000\x0D\x0A\x1A" +
      // 2. reserved
      std::string(256, '\0') +
      // 3. sampling table: one row
      "\x01" + one + half + zero + zero +
      // 4. layers: z, boundaries; vertices, gaps, points, the first repeated
      one + count(2) +                                         //
      count(5) + count(0) +                                    //
      zero + zero + four + zero + four + four + zero + four +  //
      zero + zero +                                            //
      count(5) + count(0) +                                    //
      one + one + one + three + three + three + three + one +  //
      one + one +                                              //
      one_and_half + count(0) +                                //
      two + count(1) +                                         //
      count(4) + count(0) +                                    //
      minus_two + half + two + half + zero + three +           //
      minus_two + half +                                       //
      // 5. end: top of the part
      two_and_half + "\xFF\xFF\xFF\xFF"s;
  EXPECT_EQ(bytes, expected);
}

TEST(SlcWriter, NotesInTheHeaderWhatContoursDeviateBy) {
  const std::vector<Layer> layers = {
      layer_at(0, 1, {{{0, 0}, {4, 0}, {0, 4.1}}})};
  const std::string bytes = write_slc(layers, 0.001);
  EXPECT_NE(bytes.find("lamina " + std::string(version()) +
                       " within 0.00100033717 mm -EXTENTS"),
            std::string::npos)
      << bytes.substr(0, 100);
  const TemporaryFolder folder;
  const SlcReader reader(folder.write("a.slc", bytes));
  EXPECT_EQ(reader.facts().writer, "lamina " + std::string(version()));
  ASSERT_TRUE(reader.facts().deviation);
  EXPECT_NEAR(*reader.facts().deviation, 0.001 + std::ldexp(std::sqrt(2), -22),
              1e-11);
}

TEST(SlcWriter, TellsEachRunOfLayersOfOneThicknessInARowOfItsOwn) {
  const std::vector<std::vector<Vec2>> square = {
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  std::vector<Layer> layers;
  double z = -1;
  // 0.1 three times, 0.3 twice, an empty one, 0.1 again.
  for (const double thickness : {0.1, 0.1, 0.1, 0.3, 0.3, 0.2, 0.1}) {
    layers.push_back(layer_at(z, z + thickness, square));
    z += thickness;
  }
  layers[5].contours.clear();
  const TemporaryFolder folder;
  SlcReader reader(folder.write("a.slc", write_slc(layers)));
  const auto& rows = reader.facts().sampling;
  ASSERT_EQ(rows.size(), 4U);
  const double starts[] = {-1, -0.7, -0.1, 0.1};
  const double thicknesses[] = {0.1, 0.3, 0.2, 0.1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(rows[i].min_z, starts[i], 1e-6);
    EXPECT_NEAR(rows[i].thickness, thicknesses[i], 1e-6);
  }
  SlcLayer layer;
  for (const Layer& written : layers) {
    ASSERT_TRUE(reader.read_layer(layer));
    EXPECT_NEAR(layer.z, written.bottom, 1e-6);
    EXPECT_NEAR(layer.thickness, written.top - written.bottom, 1e-6);
    EXPECT_EQ(layer.boundaries.size(), written.contours.loop_count());
  }
  EXPECT_FALSE(reader.read_layer(layer));
  EXPECT_NEAR(reader.facts().top.value(), z, 1e-6);
}

TEST(SlcWriter, RefusesMoreRunsThanItsTableHasRows) {
  std::vector<Layer> layers;
  double z = 0;
  for (int i = 0; i < 256; ++i) {
    const double thickness = i % 2 == 0 ? 0.1 : 0.2;
    layers.push_back(layer_at(z, z + thickness, {{{0, 0}, {4, 0}, {0, 4}}}));
    z += thickness;
  }
  EXPECT_THROW(write_slc(layers), FileError);
  layers.pop_back();
  const TemporaryFolder folder;
  const SlcReader reader(folder.write("a.slc", write_slc(layers)));
  EXPECT_EQ(reader.facts().sampling.size(), 255U);
}

TEST(SlcWriter, NotesTheCompensationInTheTable) {
  Layer layer = layer_at(0, 1, {{{0, 0}, {4, 0}, {0, 4}}});
  layer.compensation = -0.25;
  const TemporaryFolder folder;
  SlcReader reader(folder.write("a.slc", write_slc({layer})));
  ASSERT_EQ(reader.facts().sampling.size(), 1U);
  EXPECT_EQ(reader.facts().sampling[0].line_width_compensation, -0.25F);
}

TEST(SlcWriter, BeginsARowWhereTheCompensationChanges) {
  std::vector<Layer> layers;
  for (int i = 0; i < 5; ++i) {
    layers.push_back(layer_at(i, i + 1, {{{0, 0}, {4, 0}, {0, 4}}}));
    layers.back().compensation = i < 2 ? 0.3 - 0.1 * i : 0.1;
  }
  const TemporaryFolder folder;
  SlcReader reader(folder.write("a.slc", write_slc(layers)));
  const auto& rows = reader.facts().sampling;
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].min_z, static_cast<float>(i));
    EXPECT_EQ(rows[i].thickness, 1.0F);
    EXPECT_EQ(rows[i].line_width_compensation,
              static_cast<float>(layers[i].compensation));
  }
}

TEST(SlcWriter, HeaderEndsWithin2048BytesAndHolds1AOnlyThere) {
  const std::string bytes = write_slc(
      {layer_at(-1234.5678, -1234.5, {{{-9999, -1e-30}, {1e6, 0}, {0, 1e6}}})});
  const std::size_t end = bytes.find('\x1A');
  ASSERT_NE(end, std::string::npos);
  EXPECT_LT(end, 2048U);
  EXPECT_EQ(bytes.substr(end - 2, 2), "\r\n");
  // The width of the numbers does not depend on the numbers.
  const std::string other =
      write_slc({layer_at(0, 1, {{{0, 0}, {1, 0}, {0, 1}}})});
  EXPECT_EQ(other.find('\x1A'), end);
}

TEST(SlcWriter, DropsPointsThatFallOnTheirNeighbourInFloat32) {
  // At 100 mm float32 steps by 7.6e-6 mm.
  const auto layers = layers_of(write_slc({layer_at(
      0, 1, {{{100, 0}, {100 + 1e-7, 0}, {101, 0}, {101, 1}, {100, 1e-46}}})}));
  ASSERT_EQ(layers.at(0).boundaries.size(), 1U);
  const std::vector<Vec2> expected = {{101, 1}, {100, 0}, {101, 0}, {101, 1}};
  EXPECT_EQ(layers.at(0).boundaries[0].points, expected);
}

TEST(SlcWriter, DropsSpikesAndLoopsThatLoseTheirAreaInFloat32) {
  const auto layers = layers_of(write_slc({layer_at(
      0, 1,
      {// a wall of 1e-7 mm far from the origin: both sides round to one
       {{100, 0}, {110, 0}, {110, 1e-50}, {100, 1e-50}},
       // a spike over the beginning of the list, one inside it
       {{3, 3}, {0, 0}, {4, 0}, {5, 2}, {4, 1e-50}, {4, 4}, {0, 0}},
       {{50, 50}, {50 + 1e-7, 50}, {50, 50 + 1e-7}}})}));
  ASSERT_EQ(layers.at(0).boundaries.size(), 1U);
  const std::vector<Vec2> expected = {{0, 0}, {4, 0}, {4, 4}, {0, 0}};
  EXPECT_EQ(layers.at(0).boundaries[0].points, expected);
}

TEST(SlcWriter, RefusesLayersThatFloat32CannotTellApart) {
  const std::vector<Vec2> loop = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_THROW(write_slc({layer_at(1000, 1000 + 1e-6, {loop}),
                          layer_at(1000 + 1e-6, 1000 + 2e-6, {loop})}),
               FileError);
}

TEST(SlcWriter, AJobWithoutLayersIsAFileStill) {
  const auto layers = layers_of(write_slc({}));
  EXPECT_TRUE(layers.empty());
}

}  // namespace
}  // namespace lamina::slicer
