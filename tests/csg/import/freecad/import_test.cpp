// import() of FreeCAD files, from the text of a design to its layers.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plane/loop_area.h"
#include "tests/csg/import/freecad/freecad_document.h"
#include "tests/support/design.h"
#include "tests/support/temporary_folder.h"

namespace lamina::csg {
namespace {

// The area of the design's section at z = 2.
double area_at_two(const std::string& text, double chordal_error = 0) {
  const auto design = support::Design::from_text(text, chordal_error);
  double area = 0;
  for (const auto& layer : support::slice_heights(design.scene(), {2.0})) {
    for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
      area += signed_area(layer.contours.loop(i));
    }
  }
  return area;
}

std::string message_of(const std::string& text) {
  try {
    support::Design::from_text(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(ImportOfFreecadFiles, IsAPartOfADesignLikeAnyOther) {
  const support::TemporaryFolder folder;
  const std::string path =
      folder.write("a.FCStd", FreecadDocument().box("A").box("B", "2").bytes());
  EXPECT_DOUBLE_EQ(
      area_at_two(fmt::format("difference() {{ import(\"{}\"); "
                              "translate([1, 1, -1]) cube([1, 1, 9]); }}",
                              path)),
      3 * 4 - 1);
  EXPECT_DOUBLE_EQ(area_at_two(fmt::format(
                       "scale([2, 1, 1]) import(\"{}\", part = \"B\");", path)),
                   2 * 2 * 4);
}

TEST(ImportOfFreecadFiles, DividesCurvesByTheChordalError) {
  const support::TemporaryFolder folder;
  FreecadDocument document;
  document.add("Part::Cylinder", "A",
               number("Radius", "10") + number("Height", "5"));
  const std::string text =
      fmt::format("import(\"{}\");", folder.write("a.FCStd", document.bytes()));
  const double circle = 100 * std::numbers::pi;
  for (const double error : {0.1, 0.01, 0.001}) {
    const double missing = circle - area_at_two(text, error);
    EXPECT_GT(missing, 0);
    EXPECT_LE(missing, error * 20 * std::numbers::pi);
  }
  EXPECT_LE(circle - area_at_two(text), 0.01 * 20 * std::numbers::pi);
}

// Greatest distance of contours from a torus about the y axis, whose tube of
// radius 5 runs 20 mm from it.
double distance_from_torus(const std::string& text, double chordal_error) {
  std::vector<double> heights;
  for (double z = -24; z < 24; z += 0.1) heights.push_back(z);
  const auto design = support::Design::from_text(text, chordal_error);
  double greatest = 0;
  const auto judge = [&](Vec2 p, double z) {
    const double from_ring = std::hypot(std::hypot(p.x, z) - 20, p.y);
    greatest = std::max(greatest, std::abs(from_ring - 5));
  };
  const auto layers = support::slice_heights(design.scene(), heights);
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const auto& contours = layers[k].contours;
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      for (std::size_t j = 0; j < loop.size(); ++j) {
        judge(0.5 * (loop[j] + loop[(j + 1) % loop.size()]), heights[k]);
      }
    }
  }
  return greatest;
}

// The chords of the outline and those of the turn are off together.
TEST(ImportOfFreecadFiles, DividesTheChordalErrorBetweenOutlineAndTurn) {
  const support::TemporaryFolder folder;
  const std::string turn = vector("Axis", "0", "1", "0") +
                           vector("Base", "0", "0", "0") +
                           number("Angle", "360");
  const std::string circle = property(
      "Geometry",
      "<GeometryList><Geometry type=\"Part::GeomCircle\"><Circle "
      "CenterX=\"20\" CenterY=\"0\" Radius=\"5\"/></Geometry></GeometryList>");
  FreecadDocument part;
  part.add("Sketcher::SketchObject", "S", circle)
      .add("Part::Revolution", "A",
           link("Source", "S") + turn + flag("Solid", true));
  FreecadDocument body;
  body.add("Sketcher::SketchObject", "S", circle)
      .add("PartDesign::Revolution", "A",
           property("Profile", "<LinkSub value=\"S\" count=\"0\"/>") +
               link("BaseFeature", "") + turn);
  for (const FreecadDocument& document : {part, body}) {
    const std::string text = fmt::format(
        "import(\"{}\");", folder.write("a.FCStd", document.bytes()));
    for (const double error : {0.5, 0.1, 0.02}) {
      const double distance = distance_from_torus(text, error);
      EXPECT_LE(distance, error);
      EXPECT_GT(distance, error / 2);
    }
  }
}

TEST(ImportOfFreecadFiles, FailsAtItsPlaceInTheDesign) {
  const support::TemporaryFolder folder;
  const std::string path = folder.write("a.FCStd", "PK\3\4 and no more");
  const std::string message =
      message_of(fmt::format("cube();\nimport(\"{}\");", path));
  EXPECT_NE(message.find("test.scad:2:1: error: ZIP archive is cut off: it has "
                         "no directory, importing file"),
            std::string::npos)
      << message;
}

TEST(ImportOfFreecadFiles, ShowsNamesOnOneLine) {
  const support::TemporaryFolder folder;
  const std::string name = "a&#10;error: fake&#13;";
  FreecadDocument ring;
  ring.add("App::Part", name, links("Group", {name}));
  FreecadDocument lost;
  lost.add("Part::Box&#10;", name, shape(name));
  FreecadDocument fewer;
  fewer.box(name, "1&#10;");
  for (const FreecadDocument& document : {ring, lost, fewer}) {
    const std::string path = folder.write("a.FCStd", document.bytes());
    const std::string message =
        message_of(fmt::format("import(\"{}\");", path));
    const std::size_t begin = message.find("error: FCStd");
    ASSERT_NE(begin, std::string::npos) << message;
    const std::string words =
        message.substr(begin, message.find(", importing") - begin);
    EXPECT_EQ(words.find('\n'), std::string::npos) << message;
    EXPECT_EQ(words.find('\r'), std::string::npos) << message;
  }
}

TEST(ImportOfFreecadFiles, FailsWhereThereIsNoFile) {
  const std::string message = message_of("import(\"none.FCStd\");");
  EXPECT_NE(message.find("error: Can't open import file \"none.FCStd\""),
            std::string::npos)
      << message;
}

TEST(ImportOfFreecadFiles, CountsLeavesWithThoseOfTheDesign) {
  const support::TemporaryFolder folder;
  FreecadDocument document;
  document.box("O0");
  for (int i = 1; i <= 30; ++i) {
    const std::string last = fmt::format("O{}", i - 1);
    document.add("Part::MultiFuse", fmt::format("O{}", i),
                 links("Shapes", {last, last}));
  }
  const std::string path = folder.write("a.FCStd", document.bytes());
  const std::string message = message_of(fmt::format("import(\"{}\");", path));
  EXPECT_NE(message.find("Too many leaves"), std::string::npos) << message;
}

}  // namespace
}  // namespace lamina::csg
