#include "csg/import/dxf.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

using Strings = std::vector<std::string>;

// "0 LINE 10 1.5" as the lines of a file.
std::string groups(std::string text) {
  for (char& c : text) c = c == ' ' ? '\n' : c;
  return text + "\n";
}

std::string entities(const std::string& text) {
  return groups("0 SECTION 2 ENTITIES " + text + " 0 ENDSEC 0 EOF");
}

DxfDrawing parse_drawing(const std::string& text, DxfOptions options = {}) {
  if (!options.fragments) options.fragments = [](double) { return 4; };
  options.path = "a.dxf";
  return parse_dxf(text, options);
}

const std::string kTriangle =
    "0 LINE 8 a 10 0 20 0 11 4 21 0 "
    "0 LINE 8 a 10 0 20 3 11 0 21 0 "
    "0 LINE 8 a 10 4 20 0 11 0 21 3";

TEST(ParseDxf, JoinsLinesInAnyOrderAndDirection) {
  const DxfDrawing drawing = parse_drawing(entities(kTriangle));
  ASSERT_EQ(drawing.paths.size(), 1U);
  EXPECT_TRUE(drawing.paths[0].is_closed);
  EXPECT_EQ(drawing.paths[0].points,
            (std::vector<Vec2>{{0, 0}, {4, 0}, {0, 3}}));
}

TEST(ParseDxf, AnOpenPathBeginsAtItsEnd) {
  const DxfDrawing drawing = parse_drawing(
      entities("0 LINE 10 1 20 0 11 2 21 0 0 LINE 10 0 20 0 11 1 21 0"));
  ASSERT_EQ(drawing.paths.size(), 1U);
  EXPECT_FALSE(drawing.paths[0].is_closed);
  EXPECT_EQ(drawing.paths[0].points,
            (std::vector<Vec2>{{2, 0}, {1, 0}, {0, 0}}));
}

TEST(ParseDxf, EndsMeetWithinOneStepOfTheGrid) {
  const DxfDrawing drawing = parse_drawing(
      entities("0 LINE 10 0 20 0 11 1 21 0 0 LINE 10 1.001 20 0 11 2 21 0"));
  EXPECT_EQ(drawing.paths.size(), 1U);
}

TEST(ParseDxf, TakesOneLayerMovesAndScales) {
  DxfOptions options;
  options.layer = "a";
  options.origin = {1, 2};
  options.scale = 2;
  const DxfDrawing drawing =
      parse_drawing(entities("0 LINE 8 a 10 1 20 2 11 3 21 3 "
                             "0 LINE 8 b 10 9 20 9 11 8 21 8"),
                    options);
  ASSERT_EQ(drawing.paths.size(), 1U);
  EXPECT_EQ(drawing.paths[0].points, (std::vector<Vec2>{{0, 0}, {4, 2}}));
}

TEST(ParseDxf, RoundThingsHaveTheirFragments) {
  const DxfDrawing circle = parse_drawing(entities("0 CIRCLE 10 1 20 1 40 2"));
  ASSERT_EQ(circle.paths.size(), 1U);
  EXPECT_EQ(circle.paths[0].points.size(), 4U);
  const DxfDrawing arc =
      parse_drawing(entities("0 ARC 10 0 20 0 40 1 50 270 51 90"));
  ASSERT_EQ(arc.paths.size(), 1U);
  EXPECT_EQ(arc.paths[0].points, (std::vector<Vec2>{{0, -1}, {1, 0}, {0, 1}}));
  const DxfDrawing ellipse = parse_drawing(
      entities("0 ELLIPSE 10 0 20 0 11 0 21 2 40 0.5 41 0 42 6.283185307"));
  ASSERT_EQ(ellipse.paths.size(), 1U);
  EXPECT_EQ(ellipse.paths[0].points.size(), 4U);
}

TEST(ParseDxf, InsertsBlocksTurnedAndStretched) {
  const DxfDrawing drawing = parse_drawing(
      groups("0 SECTION 2 BLOCKS 0 BLOCK 2 b 0 LINE 10 1 20 0 11 2 21 0 "
             "0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES "
             "0 INSERT 2 b 10 5 20 6 41 3 50 90 0 EOF"));
  ASSERT_EQ(drawing.paths.size(), 1U);
  EXPECT_EQ(drawing.paths[0].points, (std::vector<Vec2>{{5, 9}, {5, 12}}));
}

TEST(ParseDxf, CountsWhatItDoesNotKnow) {
  const DxfDrawing drawing =
      parse_drawing(entities("0 SPLINE 10 1 0 SPLINE 10 1 " + kTriangle));
  EXPECT_EQ(unknown_entity_warnings(drawing, "", "\"a.dxf\""),
            (Strings{"Unsupported DXF Entity 'SPLINE' (2) in \"a.dxf\"."}));
  EXPECT_EQ(drawing.paths.size(), 1U);
}

TEST(ParseDxf, WarnsInOpenScadsWords) {
  EXPECT_EQ(parse_drawing(entities("0 LINE 10 1,5 20 0 11 1 21 1")).warnings,
            (Strings{"Illegal value '1,5'in `a.dxf'",
                     "Not enough input values for ENDSEC. in 'a.dxf'",
                     "Not enough input values for EOF. in 'a.dxf'"}));
  EXPECT_EQ(parse_drawing("zero\nSECTION\n 2\n").warnings,
            (Strings{"Illegal ID 'zero' in `a.dxf'"}));
}

TEST(ParseDxf, WithoutEntitiesThereIsNothing) {
  EXPECT_TRUE(parse_drawing(groups(kTriangle + " 0 EOF")).paths.empty());
}

TEST(ParseDxf, BlocksInBlocksDoNotGrowWithoutEnd) {
  std::string text =
      "0 SECTION 2 BLOCKS 0 BLOCK 2 b 0 LINE 10 0 20 0 11 1 21 0";
  for (int i = 0; i < 40; ++i) text += " 0 INSERT 2 b 10 0 20 0";
  text += " 0 ENDBLK 0 ENDSEC 0 EOF";
  EXPECT_NE(
      fault_of([&] { parse_drawing(groups(text)); }).find("lines to draw"),
      std::string::npos);
}

// Of 100,000 blocks of 819,200 lines, if each were moved.
TEST(ParseDxf, InsertsThatDrawNothingMoveNothing) {
  std::string text = "0 SECTION 2 BLOCKS 0 BLOCK 2 b";
  for (int i = 0; i < 100; ++i) text += " 0 LINE 10 0 20 0 11 1 21 0";
  for (int i = 0; i < 13; ++i) text += " 0 INSERT 2 b 10 0 20 0";
  text += " 0 ENDBLK 0 ENDSEC";
  for (const char* section : {"ENTITIES", "OBJECTS"}) {
    text += std::string(" 0 SECTION 2 ") + section;
    for (int i = 0; i < 50'000; ++i) text += " 0 INSERT 2 b 8 other 10 0 20 0";
    text += " 0 ENDSEC";
  }
  DxfOptions options;
  options.layer = "a";
  EXPECT_TRUE(parse_drawing(groups(text + " 0 EOF"), options).paths.empty());
}

TEST(ParseDxf, ArcsDoNotTurnWithoutEnd) {
  for (const char* arc : {"0 ARC 10 0 20 0 40 1 50 0 51 1e9",
                          "0 ELLIPSE 10 0 20 0 11 1 21 0 40 1 41 0 42 1e300"}) {
    EXPECT_NE(
        fault_of([&] { parse_drawing(entities(arc)); }).find("lines to draw"),
        std::string::npos)
        << arc;
  }
}

TEST(ParseDxf, ManyLinesInOnePointAreJoinedInTime) {
  std::string text;
  for (int i = 0; i < 20000; ++i) {
    text += "0 LINE 10 0 20 0 11 " + std::to_string(i + 1) + " 21 5 ";
  }
  EXPECT_EQ(parse_drawing(entities(text)).paths.size(), 10000U);
}

TEST(ParseDxf, SurvivesWhateverBefallsAFile) {
  const std::string text = groups(
      "0 SECTION 2 BLOCKS 0 BLOCK 2 b 0 LWPOLYLINE 70 1 10 1 20 0 10 2 20 0 "
      "10 2 20 2 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES "
      "0 INSERT 2 b 10 5 20 6 41 3 50 90 0 CIRCLE 10 1 20 1 40 2 "
      "0 ELLIPSE 10 0 20 0 11 0 21 2 40 0.5 41 0 42 6.28 "
      "0 DIMENSION 70 1 13 1 23 2 0 ENDSEC 0 EOF");
  expect_no_harm(
      text, [](std::string_view bytes) { parse_drawing(std::string(bytes)); });
}

}  // namespace
}  // namespace lamina::csg
