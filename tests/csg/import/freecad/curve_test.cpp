// Curves of sketches, judged by their formulas.

#include "csg/import/freecad/detail/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file/format_error.h"
#include "csg/import/freecad/detail/outline.h"
#include "csg/limits.h"
#include "plane/region/boolean.h"

namespace lamina::csg::freecad {
namespace {

constexpr double kError = 0.01;

Polyline read(const std::string& type, const std::string& xml) {
  pugi::xml_document document;
  document.load_string(
      ("<Geometry type=\"Part::Geom" + type + "\">" + xml + "</Geometry>")
          .c_str());
  const auto curve = read_curve(document.document_element(), kError);
  EXPECT_TRUE(curve.has_value());
  return curve.value_or(Polyline());
}

TEST(Curve, AnArcLiesWithinTheErrorOfItsCircle) {
  const Polyline chords =
      read("ArcOfCircle",
           "<ArcOfCircle CenterX=\"3\" CenterY=\"-2\" CenterZ=\"0\" "
           "NormalX=\"0\" NormalY=\"0\" NormalZ=\"1\" AngleXU=\"0.25\" "
           "Radius=\"5\" StartAngle=\"0.5\" EndAngle=\"2.5\"/>");
  for (std::size_t i = 1; i < chords.size(); ++i) {
    const Vec2 middle = (chords[i - 1] + chords[i]) / 2.0 - Vec2(3, -2);
    EXPECT_GE(std::hypot(middle.x, middle.y), 5 - kError);
    EXPECT_NEAR(std::hypot(chords[i].x - 3, chords[i].y + 2), 5, 1e-12);
  }
  EXPECT_NEAR(chords.front().x, 3 + 5 * std::cos(0.75), 1e-12);
  EXPECT_NEAR(chords.back().y, -2 + 5 * std::sin(2.75), 1e-12);
}

TEST(Curve, AnArcThatLooksDownRunsTheOtherWay) {
  const Polyline chords =
      read("ArcOfCircle",
           "<ArcOfCircle CenterX=\"0\" CenterY=\"0\" CenterZ=\"0\" "
           "NormalX=\"0\" NormalY=\"0\" NormalZ=\"-1\" AngleXU=\"0\" "
           "Radius=\"2\" StartAngle=\"0\" EndAngle=\"1\"/>");
  EXPECT_NEAR(chords.front().x, -2, 1e-12);
  EXPECT_NEAR(chords.back().x, -2 * std::cos(1), 1e-12);
  EXPECT_NEAR(chords.back().y, 2 * std::sin(1), 1e-12);
}

TEST(Curve, CurvesThatRunBeyondAllCoordinatesAreRejected) {
  EXPECT_THROW(
      read("Circle", "<Circle CenterX=\"1e9\" CenterY=\"0\" Radius=\"1\"/>"),
      plane::LimitExceeded);
}

// Whose ends were compared with one another, 4e10 pairs.
TEST(JoinCurves, JoinsManyCurvesInTheSamePlace) {
  const std::vector<Polyline> lines(200'000, {{0, 0}, {1, 0}});
  const auto contours = join_curves(lines);
  ASSERT_TRUE(contours.has_value());
  for (const Polyline& contour : *contours) {
    EXPECT_EQ(contour.size() % 2, 0U);
  }
}

// Likewise, where the ends are nearly in one place.
TEST(JoinCurves, JoinsManyCurvesInNearlyTheSamePlace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 7e-7);
  const auto end = [&] { return Vec2(place(random), place(random)); };
  std::vector<Polyline> lines(100'000);
  for (Polyline& line : lines) line = {end(), {1, 0}, end()};
  EXPECT_TRUE(join_curves(lines).has_value());
}

TEST(JoinCurves, JoinsEndsThatAreAMillionthApartAndNoMore) {
  const auto contours = [](double gap) {
    std::size_t count = 0;
    // Wherever it lies in the cells.
    for (int i = 0; i < 100; ++i) {
      const Vec2 at(i * 3.1e-8, i * 1.7e-8);
      const Vec2 beside = at + gap * Vec2(0.6, -0.8);
      if (join_curves({{at, {1, 0}}, {{0, 1}, {1, 0}}, {beside, {0, 1}}})) {
        ++count;
      }
    }
    return count;
  };
  EXPECT_EQ(contours(0.99e-6), 100U);
  EXPECT_EQ(contours(1.01e-6), 0U);
}

TEST(JoinCurves, JoinsCurvesOfAnyOrderAndDirection) {
  const auto contours = join_curves({{{0, 0}, {1, 0}},
                                     {{0, 1}, {0, 0}},
                                     {{1, 1}, {0, 1}},
                                     {{1, 1}, {1, 0}},
                                     {{5, 5}, {6, 5}, {5, 6}, {5, 5}}});
  ASSERT_TRUE(contours.has_value());
  ASSERT_EQ(contours->size(), 2U);
  EXPECT_EQ((*contours)[0], (Polyline{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ((*contours)[1], (Polyline{{5, 5}, {6, 5}, {5, 6}}));
}

// A square with its lower left corner there.
Polyline square(double x, double y, double size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

// What an odd number of the contours surrounds.
double even_odd_area(const std::vector<Polyline>& contours) {
  return area(plane::from_contours(contours));
}

TEST(UniteCrossing, UnitesSquaresThatCrossByTheClosedFormula) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-12, 12);
  for (int k = 0; k < 200; ++k) {
    const double dx = shift(random);
    const double dy = shift(random);
    std::vector<Polyline> contours = {square(0, 0, 10), square(dx, dy, 10)};
    const double common =
        std::max(0.0, 10 - std::abs(dx)) * std::max(0.0, 10 - std::abs(dy));
    const bool do_cross = std::min(common, 100 - common) > 0.01 * 40;
    EXPECT_EQ(unite_crossing(0.01, contours), do_cross);
    EXPECT_NEAR(even_odd_area(contours),
                do_cross ? 200 - common : 200 - 2 * common, 1e-6);
  }
}

TEST(UniteCrossing, KeepsHolesAndWhatTouches) {
  const std::vector<std::vector<Polyline>> all = {
      {square(0, 0, 10), square(2, 2, 3)},
      {square(0, 0, 10), square(0, 2, 3)},    // a hole at the rim
      {square(0, 0, 10), square(10, 5, 10)},  // side by side
      {square(0, 0, 10), square(10, 10, 10)},
      {arc(10, 0, 2 * std::numbers::pi, 0.01),
       {{10.0001, -5}, {20, -5}, {20, 5}, {10.0001, 5}}}};
  for (const std::vector<Polyline>& contours : all) {
    std::vector<Polyline> same = contours;
    EXPECT_FALSE(unite_crossing(0.01, same));
    EXPECT_EQ(same, contours);
  }
}

TEST(UniteCrossing, KeepsHolesBesideWhatCrosses) {
  // Two squares that cross, with a hole in their common part and a square in
  // the hole.
  std::vector<Polyline> contours = {square(0, 0, 10), square(5, 5, 10),
                                    square(6, 6, 3), square(7, 7, 1)};
  EXPECT_TRUE(unite_crossing(0.01, contours));
  EXPECT_NEAR(even_odd_area(contours), 200 - 25 - 9 + 1, 1e-6);
}

TEST(JoinCurves, FindsWhatIsOpen) {
  EXPECT_FALSE(join_curves({{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}}).has_value());
}

}  // namespace
}  // namespace lamina::csg::freecad
