#include "csg/import/svg.h"

#include <string>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

using Points = std::vector<Vec2>;

// Strokes come out as the path itself.
std::vector<SvgContours> parse_shapes(std::string_view text,
                                      SvgOptions options = {}) {
  options.outline = [](std::span<const Vec2> path, const SvgStroke&) {
    return SvgContours{{path.begin(), path.end()}};
  };
  return parse_svg(text, options).shapes;
}

// The contours of one path in a page of its own, y down as in the file.
SvgContours path(const std::string& data) {
  const auto shapes = parse_shapes("<svg width=\"0\" height=\"0\"><path d=\"" +
                                   data + "\"/></svg>");
  if (shapes.empty()) return {};
  SvgContours contours = shapes.at(0);
  for (auto& contour : contours) {
    for (Vec2& point : contour) point.y = 0 - point.y;
  }
  return contours;
}

void expect_near(const Points& actual, const Points& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_NEAR(actual[i].x, expected[i].x, 1e-12) << i;
    EXPECT_NEAR(actual[i].y, expected[i].y, 1e-12) << i;
  }
}

TEST(ParseSvg, LinesAbsoluteAndRelative) {
  const Points square = {{1, 2}, {4, 2}, {4, 5}, {1, 5}, {1, 2}};
  EXPECT_EQ(path("M1 2L4 2 4 5 1 5Z"), (SvgContours{square}));
  EXPECT_EQ(path("m1,2 3,0 0,3-3,0z"), (SvgContours{square}));
  EXPECT_EQ(path("M1 2h3v3H1z"), (SvgContours{square}));
}

TEST(ParseSvg, NumbersNeedNoBlanks) {
  EXPECT_EQ(path("M.5-.5.5.5 1e1-5z"),
            (SvgContours{{{.5, -.5}, {.5, .5}, {10, -5}, {.5, -.5}}}));
}

TEST(ParseSvg, CurvesEndWhereTheySay) {
  const auto cubic = path("M0 0C0 4 4 4 4 0S8-4 8 0z").at(0);
  ASSERT_EQ(cubic.size(), 42U);
  expect_near({cubic[10], cubic[20], cubic[30], cubic[40]},
              {{2, 3}, {4, 0}, {6, -3}, {8, 0}});
  const auto quadratic = path("M0 0Q2 4 4 0T8 0z").at(0);
  ASSERT_EQ(quadratic.size(), 42U);
  expect_near({quadratic[10], quadratic[30]}, {{2, 2}, {6, -2}});
}

TEST(ParseSvg, ArcsWithoutACentreInNumbersAreLines) {
  for (const char* arc : {"A1 1 0 0 0 1e-200 0", "A1e200 1e200 0 0 0 1 1",
                          "A1e-200 1e200 0 1 1 1e150 1"}) {
    const auto contour = path(std::string("M0 0") + arc + "L0 9z").at(0);
    for (const Vec2 point : contour) {
      EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y)) << arc;
    }
  }
}

TEST(ParseSvg, ArcsLieOnTheirCircle) {
  for (const std::string flags : {"0 0 0 ", "0 1 0 ", "0 0 1 ", "0 11"}) {
    const auto arc = path("M3 0A3 3 " + flags + "0 3z").at(0);
    const Vec2 center =
        flags == "0 0 1 " || flags == "0 1 0 " ? Vec2(0) : Vec2(3, 3);
    for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
      const Vec2 d = arc[i] - center;
      EXPECT_NEAR(d.x * d.x + d.y * d.y, 9, 1e-9) << flags << i;
    }
  }
}

TEST(ParseSvg, UnitsViewBoxAndAspectGiveMillimetres) {
  const auto corner = [](const std::string& page) {
    const auto shapes = parse_shapes("<svg " + page +
                                     "><rect x=\"0\" y=\"0\" width=\"10\" "
                                     "height=\"10\"/></svg>");
    return shapes.at(0).at(0).at(2);  // x + width, y + height
  };
  const auto expect_at = [&](const std::string& page, Vec2 expected) {
    const Vec2 actual = corner(page);
    EXPECT_NEAR(actual.x, expected.x, 1e-9) << page;
    EXPECT_NEAR(actual.y, expected.y, 1e-9) << page;
  };
  expect_at(R"svg(width="100mm" height="50mm" viewBox="0 0 100 50")svg",
            {10, 40});
  expect_at(R"svg(width="10cm" height="5cm" viewBox="0,0,100,50")svg",
            {10, 40});
  expect_at(R"svg(width="72" height="72" viewBox="0 0 72 72")svg",
            {25.4 / 7.2, 25.4 - 25.4 / 7.2});
  expect_at(R"svg(width="96px" height="1in" viewBox="0 0 10 10")svg",
            {25.4, 0});
  expect_at(
      R"svg(width="60mm" height="20mm" viewBox="0 0 10 10"
         preserveAspectRatio="none")svg",
      {60, 0});
  expect_at(
      R"svg(width="60mm" height="20mm" viewBox="0 0 10 10"
         preserveAspectRatio="xMaxYMid meet")svg",
      {60, 0});
  expect_at(
      R"svg(width="60mm" height="20mm" viewBox="0 0 10 10"
         preserveAspectRatio="xMidYMin slice")svg",
      {60, -40});
}

TEST(ParseSvg, TransformsApplyFromTheInsideOut) {
  const auto shapes = parse_shapes(
      R"svg(<svg height="0" width="0"><g transform="translate(10,20)">
      <g transform="rotate(90 1 1),scale(2)">
      <polygon points="0 0 1 0 1 1" transform="matrix(1 0 0 1 5 0)"/>
      </g></g></svg>)svg");
  // (0,0) -> (5,0) -> (10,0) -> turned about (1,1): (2,10) -> (12,30)
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_NEAR(shapes[0][0][0].x, 12, 1e-12);
  EXPECT_NEAR(shapes[0][0][0].y, -30, 1e-12);
}

TEST(ParseSvg, DefinitionsDrawNothingByThemselves) {
  EXPECT_TRUE(
      parse_shapes(R"svg(<svg><defs><g id="a"><rect width="1" height="1"/>
      <use href="#a"/></g></defs></svg>)svg")
          .empty());
}

TEST(ParseSvg, OpenPathsAreDrawnAsTheirStrokeSays) {
  std::vector<SvgStroke> strokes;
  SvgOptions options;
  options.outline = [&](std::span<const Vec2>, const SvgStroke& stroke) {
    strokes.push_back(stroke);
    return SvgContours{};
  };
  parse_svg(R"svg(<svg><path d="M0 0L1 1"/><path d="M0 0L1 1L0 0"/>
      <line x2="5" stroke-width="3" stroke-linecap="butt"/>
      <polyline points="0 0 1 1" style="stroke-width:2;stroke-linejoin:round;stroke-linecap:round"/>
      </svg>)svg",
            options);
  ASSERT_EQ(strokes.size(), 3U);
  EXPECT_EQ(strokes[0].width, 1);
  EXPECT_EQ(strokes[0].cap, SvgStroke::Cap::kSquare);
  EXPECT_EQ(strokes[1].width, 3);
  EXPECT_EQ(strokes[1].cap, SvgStroke::Cap::kButt);
  EXPECT_EQ(strokes[2].width, 2);
  EXPECT_EQ(strokes[2].cap, SvgStroke::Cap::kRound);
  EXPECT_EQ(strokes[2].join, SvgStroke::Join::kRound);
}

TEST(ParseSvg, SaysWhatIsWrong) {
  EXPECT_NE(fault_of([] { parse_shapes("garbage"); }), "");
  std::string deep = "<svg>";
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  EXPECT_NE(fault_of([&] { parse_shapes(deep); }), "");
  for (int i = 0; i < 100000; ++i) deep += "</g>";
  deep += "</svg>";
  EXPECT_EQ(fault_of([&] { parse_shapes(deep); }),
            "SVG elements are nested more than 500 deep");
}

TEST(ParseSvg, SurvivesWhateverBefallsAFile) {
  const std::string text =
      R"svg(<svg viewBox="0 0 9 9" width="9mm"><g transform="rotate(5 1 1)">
      <path d="M0 0c1 2 3 4 5 6a1 2 3 0 1 4 5q1 2 3 4t5 6h3z"
      style="stroke-width:3"/><rect width="3" height="4" rx="1"/></g></svg>)svg";
  expect_no_harm(text, [](std::string_view bytes) { parse_shapes(bytes); });
}

// --- What newer OpenSCAD reads
// ------------------------------------------------

constexpr const char* kLayers =
    "<svg width='9mm' height='9mm' viewBox='0 0 9 9'"
    " xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'>"
    "<g inkscape:groupmode='layer' inkscape:label='cut' id='g'>"
    "<rect id='a' width='1' height='1'/>"
    "<rect id='b' width='2' height='2'/></g>"
    "<rect id='c' width='3' height='3'/></svg>";

TEST(ParseSvg, IdAndLayerChooseWhatIsDrawn) {
  const auto count = [](std::optional<std::string> id,
                        std::optional<std::string> layer) {
    SvgOptions options;
    options.id = std::move(id);
    options.layer = std::move(layer);
    const SvgDrawing drawing = parse_svg(kLayers, options);
    EXPECT_EQ(drawing.has_match, !drawing.shapes.empty());
    return drawing.shapes.size();
  };
  EXPECT_EQ(count({}, {}), 3u);
  EXPECT_EQ(count("a", {}), 1u);
  EXPECT_EQ(count("g", {}), 2u) << "what is in the group";
  EXPECT_EQ(count({}, "cut"), 2u);
  EXPECT_EQ(count("c", "cut"), 0u);
  EXPECT_EQ(count("nobody", {}), 0u);
}

TEST(ParseSvg, DisplayNoneDrawsNothing) {
  const char* const text =
      "<svg><rect width='1' height='1' display='none'/>"
      "<g style='display:none'><rect width='1' height='1'/></g>"
      "<rect width='1' height='1' style='display:inline'/></svg>";
  EXPECT_EQ(parse_shapes(text).size(), 3u) << "2021.01 does not know display";
  EXPECT_EQ(parse_shapes(text, {.language = Language::k2026}).size(), 1u);
}

TEST(ParseSvg, UseDrawsWhatItNamesMovedThere) {
  const char* const text =
      "<svg width='9mm' height='9mm' viewBox='0 0 9 9'>"
      "<defs><rect id='a' width='1' height='1'/></defs>"
      "<use href='#a' x='2' y='3'/></svg>";
  EXPECT_TRUE(parse_shapes(text).empty()) << "2021.01 does not know <use>";
  const auto shapes = parse_shapes(text, {.language = Language::k2026});
  ASSERT_EQ(shapes.size(), 1u);
  Vec2 low(9);
  for (const Vec2 point : shapes[0][0]) low = glm::min(low, point);
  EXPECT_NEAR(low.x, 2, 1e-12);
  EXPECT_NEAR(low.y, 5, 1e-12) << "y up";
}

}  // namespace
}  // namespace lamina::csg
