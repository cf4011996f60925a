// Curves of sketches, judged by their formulas.

#include "csg/import/freecad/detail/curve.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file/format_error.h"
#include "csg/import/freecad/detail/outline.h"
#include "csg/limits.h"

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

TEST(Curve, ABezierCurveIsASplineOfTwoKnots) {
  const Polyline chords =
      read("BSplineCurve",
           "<BSplineCurve PolesCount=\"3\" KnotsCount=\"2\" Degree=\"2\" "
           "IsPeriodic=\"0\"><Pole X=\"0\" Y=\"0\" Z=\"0\" Weight=\"1\"/>"
           "<Pole X=\"2\" Y=\"0\" Z=\"0\" Weight=\"1\"/>"
           "<Pole X=\"2\" Y=\"2\" Z=\"0\" Weight=\"1\"/>"
           "<Knot Value=\"0\" Mult=\"3\"/><Knot Value=\"1\" Mult=\"3\"/>"
           "</BSplineCurve>");
  ASSERT_GT(chords.size(), 4U);
  // x = 4t − 2t², y = 2t².
  for (const Vec2 corner : chords) {
    const double t = std::sqrt(corner.y / 2);
    EXPECT_NEAR(corner.x, 4 * t - 2 * t * t, 1e-12);
  }
}

TEST(Curve, SplinesThatLackPolesAreRejected) {
  const std::string head =
      "<BSplineCurve Degree=\"3\" IsPeriodic=\"0\">"
      "<Pole X=\"0\" Y=\"0\" Z=\"0\" Weight=\"1\"/>";
  const std::string knots =
      "<Knot Value=\"0\" Mult=\"2\"/><Knot Value=\"1\" Mult=\"3\"/>"
      "</BSplineCurve>";
  EXPECT_THROW(read("BSplineCurve", head + knots), FormatError);
}

TEST(Curve, CurvesThatRunBeyondAllCoordinatesAreRejected) {
  EXPECT_THROW(read("ArcOfParabola",
                    "<ArcOfParabola CenterX=\"0\" CenterY=\"0\" "
                    "Focal=\"1e-300\" StartAngle=\"-1e9\" EndAngle=\"1e9\"/>"),
               plane::LimitExceeded);
  EXPECT_THROW(read("ArcOfHyperbola",
                    "<ArcOfHyperbola CenterX=\"0\" CenterY=\"0\" "
                    "MajorRadius=\"1e9\" MinorRadius=\"1e9\" "
                    "StartAngle=\"-20\" EndAngle=\"20\"/>"),
               plane::LimitExceeded);
  EXPECT_THROW(
      read("Circle", "<Circle CenterX=\"1e9\" CenterY=\"0\" Radius=\"1\"/>"),
      plane::LimitExceeded);
}

TEST(Curve, WeightsThatLeaveNoDigitsAreRejected) {
  const auto spline = [](const std::string& weight) {
    return "<BSplineCurve Degree=\"1\" IsPeriodic=\"0\"><Pole X=\"0.3\" "
           "Y=\"0\" Weight=\"" +
           weight +
           "\"/><Pole X=\"2\" Y=\"0\" Weight=\"1\"/><Knot Value=\"0\" "
           "Mult=\"2\"/><Knot Value=\"1\" Mult=\"2\"/></BSplineCurve>";
  };
  EXPECT_THROW(read("BSplineCurve", spline("5e-324")), FormatError);
  EXPECT_THROW(read("BSplineCurve", spline("0")), FormatError);
  EXPECT_NEAR(read("BSplineCurve", spline("1e-9")).front().x, 0.3, 1e-15);
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

TEST(JoinCurves, FindsWhatIsOpen) {
  EXPECT_FALSE(join_curves({{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}}).has_value());
}

}  // namespace
}  // namespace lamina::csg::freecad
