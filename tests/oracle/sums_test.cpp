// CGAL judges minkowski() of small designs: its sums of Nef polyhedra cut both
// operands into convex pieces and share nothing with lamina's way.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/nef_sum.h"
#include "tests/oracle/whole_solid.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

using support::Design;

WorldScene world_of(const std::string& text) {
  return world_scene(Design::from_text(text).scene());
}

csg::Mesh sum_of(const std::vector<std::string>& operands) {
  std::vector<WorldScene> scenes;
  for (const std::string& operand : operands) {
    scenes.push_back(world_of(operand));
  }
  return nef_sum(scenes);
}

std::string sum_text(const std::vector<std::string>& operands) {
  return fmt::format("minkowski() {{ {} }}", fmt::join(operands, " "));
}

// The sum as CGAL has it, for claims about it.
csg::Mesh expect_what_nef_finds(const std::vector<std::string>& operands) {
  const std::string text = sum_text(operands);
  csg::Mesh sum = sum_of(operands);
  EXPECT_GT(csg::signed_volume(sum), 0) << text;
  EXPECT_EQ(compare_with_solid(Design::from_text(text).scene(), sum), "")
      << text;
  return sum;
}

std::string replaced(std::string text, const std::string& what,
                     const std::string& by) {
  const std::size_t place = text.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return place == std::string::npos ? text
                                    : text.replace(place, what.size(), by);
}

// The benchmark with coarse facets. The root modifier takes its operands out.
TEST(Sums, OfTheBenchmarkAreThoseOfNefPolyhedra) {
  const std::ifstream file(std::filesystem::path(LAMINA_SOURCES) /
                           "bench/scenes/minkowski_concave.scad");
  std::stringstream text;
  text << file.rdbuf();
  const std::string ball = "sphere(r = r";
  for (const std::string shift : {"", "translate([100, 0, 0]) "}) {
    const std::string design =
        replaced(replaced(text.str(), "fn = 24", "fn = 6"), ball, shift + ball);
    const std::vector<WorldScene> operands = {
        world_of(replaced(design, "difference()", "!difference()")),
        world_of(replaced(design, shift + ball, "!" + shift + ball))};
    EXPECT_EQ(compare_with_solid(Design::from_text(design).scene(),
                                 nef_sum(operands)),
              "")
        << design;
  }
}

// A tetrahedron and a leaning ell, in general position and convex or not.
const std::string kThorn =
    "polyhedron([[0, 0, 0], [1, 0.2, 0.1], [0.3, 1, -0.2], [0.2, 0.1, 0.9]],"
    " [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]);";
const std::string kEll =
    "rotate([10, 20, 30]) linear_extrude(1)"
    " polygon([[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]]);";

const std::string kVee =
    "linear_extrude(1) polygon([[0, 0], [2, 1.5], [0, 1], [-2, 1.5]]);";

TEST(Sums, OfConvexSolidsAreThoseOfNefPolyhedra) {
  expect_what_nef_finds({"rotate([20, 30, 40]) cube([2, 3, 1]);", kThorn});
  expect_what_nef_finds({"sphere(1, $fn = 8);", "cylinder(1, 2, 1, $fn = 5);"});
}

TEST(Sums, WhereOnlyOneOperandIsConvex) {
  expect_what_nef_finds({kEll, kThorn});
  expect_what_nef_finds({kThorn, kEll});
}

TEST(Sums, OfSolidsFarFromTheOrigin) {
  expect_what_nef_finds({kEll, "translate([40, -30, 20]) " + kThorn});
  expect_what_nef_finds({"translate([70, 0, -9]) rotate([90, 0, 0]) " + kVee,
                         "translate([-40, 30, 20]) " + kEll});
}

TEST(Sums, OfSeveralComponents) {
  const std::string pair =
      "union() { " + kThorn + " translate([5, 1, 2]) cube([1, 0.5, 2]); }";
  expect_what_nef_finds({kEll, pair});
  expect_what_nef_finds({pair,
                         "union() { cube(1); translate([2.5, 0, 0.25])"
                         " rotate([0, 0, 30]) cube(0.5); }"});
}

TEST(Sums, OfBooleans) {
  const std::string bitten =
      "difference() { cube([4, 3, 2]); translate([2, 1, 1]) rotate([10, 20, "
      "30])"
      " cube(3); }";
  expect_what_nef_finds({bitten, kThorn});
  expect_what_nef_finds({kThorn, bitten});
  expect_what_nef_finds({bitten, kVee});
  expect_what_nef_finds(
      {"intersection() { sphere(2, $fn = 7); translate([0.3, 0.2, 0.1])"
       " rotate([15, 25, 35]) cube(4); }",
       "difference() { cylinder(h = 1, r = 1, $fn = 6); translate([0, 0, -1])"
       " cylinder(h = 3, r = 0.6, $fn = 4); }"});
}

// Bowls, rings and pierced cubes: their translates meet in rings, which a
// winding number that counts an Euler characteristic would take for nothing.
// Few facets, since CGAL cuts both into convex pieces.
TEST(Sums, OfTwoSolidsThatAreNotConvex) {
  const std::string bowl =
      "difference() { cylinder(2, 1, 2, $fn = 5); translate([0, 0, 1])"
      " cylinder(2, 0.5, 1.5, $fn = 3); }";
  const std::string pierced =
      "difference() { cube(1, center = true);"
      " cylinder(r = 0.3, h = 2, center = true, $fn = 3); }";
  const std::string ring =
      "rotate_extrude($fn = 3) translate([2, 0]) circle(0.4, $fn = 3);";
  expect_what_nef_finds({bowl, pierced});
  expect_what_nef_finds({"rotate([10, 20, 30]) " + pierced, bowl});
  expect_what_nef_finds({bowl, "rotate([170, 5, 0]) scale(0.4) " + bowl});
  expect_what_nef_finds({ring, "rotate([80, 30, 10]) scale(0.7) " + ring});
}

TEST(Sums, OfThreeAndFourOperands) {
  expect_what_nef_finds({kThorn, kEll, "cube([0.5, 0.25, 0.75]);"});
  expect_what_nef_finds({"cube(1);", kThorn, "cylinder(1, 1, 0, $fn = 5);",
                         "difference() { cube(2); translate([1, 1, 1]) cube(2);"
                         " }"});
}

// A tetrahedron around the origin, grown so that its walls are `size` times
// those of the unit one.
std::string tetrahedron(double size) {
  return fmt::format(
      "scale({}) polyhedron([[1, 1, 1.1], [1, -1, -1.2], [-1, 1, -1],"
      " [-1, -1, 0.9]], [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]);",
      size);
}

// Its cavity takes half of its edges.
std::string hollow(double size) {
  return fmt::format("difference() {{ {} {} }}", tetrahedron(size),
                     tetrahedron(size / 2));
}

// What the hollow bodies' sum lacks of that of the filled ones.
double cavity_volume(const csg::Mesh& sum, double size, double mover) {
  return csg::signed_volume(sum_of({tetrahedron(size), tetrahedron(mover)})) -
         csg::signed_volume(sum);
}

TEST(Sums, KeepACavityThatIsLargerThanTheMover) {
  const csg::Mesh sum = expect_what_nef_finds({hollow(8), hollow(1)});
  EXPECT_GT(cavity_volume(sum, 8, 1), 1);
  expect_what_nef_finds({hollow(1), hollow(8)});
}

TEST(Sums, FillACavityThatIsSmallerThanTheMover) {
  const csg::Mesh sum = expect_what_nef_finds({hollow(8), hollow(5)});
  EXPECT_NEAR(cavity_volume(sum, 8, 5), 0, 1e-6);
}

}  // namespace
}  // namespace lamina::oracle
