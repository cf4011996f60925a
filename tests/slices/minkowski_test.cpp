// Sums of solids against closed formulas and laws, layer by layer.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/design.h"
#include "tests/support/formulas.h"

namespace lamina {
namespace {

using plane::Contours;
using std::numbers::pi;
using support::Design;

std::vector<Contours> sections(const std::string& text,
                               const std::vector<double>& heights) {
  const Design design = Design::from_text(text);
  std::vector<Contours> result;
  for (const auto& layer : support::slice_heights(design.scene(), heights)) {
    EXPECT_TRUE(support::are_sound(layer.contours)) << text;
    result.push_back(layer.contours);
  }
  return result;
}

double section_area(const std::string& text, double z) {
  return support::total_area(sections(text, {z}).at(0));
}

// The same area, perimeter and loops at all heights.
void expect_equal(const std::string& a, const std::string& b,
                  const std::vector<double>& heights, double shift = 0) {
  std::vector<double> moved = heights;
  for (double& z : moved) z += shift;
  const auto left = sections(a, heights);
  const auto right = sections(b, moved);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_NEAR(support::total_area(left[i]), support::total_area(right[i]),
                1e-6)
        << a << " and " << b << " at " << heights[i];
    EXPECT_NEAR(support::total_perimeter(left[i]),
                support::total_perimeter(right[i]), 1e-5);
    EXPECT_EQ(support::count_loops(left[i]), support::count_loops(right[i]));
  }
}

using support::polygon_area;

// Triangles of the scene's meshes that a layer crosses.
std::size_t count_crossed(const csg::Scene& scene, double z) {
  std::size_t count = 0;
  for (const csg::Leaf& leaf : scene.leaves) {
    for (const csg::Mesh& mesh : leaf.meshes) {
      for (const auto& triangle : mesh.triangles) {
        double low = mesh.vertices[triangle[0]].z;
        double high = low;
        for (const std::uint32_t corner : triangle) {
          low = std::min(low, mesh.vertices[corner].z);
          high = std::max(high, mesh.vertices[corner].z);
        }
        if (low < z && z < high) ++count;
      }
    }
  }
  return count;
}

// A rounded plate with two holes, cut into convex parts, has hundreds of them
// around single corners.
TEST(Minkowski, OfAPlateOfManyPartsIsMadeOfItsSurface) {
  const std::string plate =
      "offset(r = -1) offset(r = 4) offset(r = -4) difference() {"
      " square([120, 60], center = true);"
      " for (x = [-30, 30]) translate([x, 0]) circle(d = 36); }";
  const std::string settings = "$fa = 4; $fs = 0.4; ";
  const std::string solid =
      settings + "minkowski() { linear_extrude(30) " + plate +
      " union() { cylinder(d1 = 2, d2 = 0, h = 1);"
      " mirror([0, 0, 1]) cylinder(d1 = 2, d2 = 0, h = 1); } }";
  const std::string flat = settings + "linear_extrude(30) minkowski() { " +
                           plate + " circle(d = 2); }";
  expect_equal(solid, flat, {3.1, 15.2, 27.3});
  // Each vertical face, moved and joined by few more, is some triangles.
  const Design design = Design::from_text(solid);
  const auto contours = sections(flat, {15.2}).at(0);
  EXPECT_LT(count_crossed(design.scene(), 15.2), 20 * contours.points.size());
}

// Of a sphere's section at height z: its vertices are rings at the middles of
// equal angles, joined by straight sides.
double ring_radius(int facets, double r, double z) {
  const int rings = (facets + 1) / 2;
  for (int i = 0; i + 1 < rings; ++i) {
    const double a = pi * (i + 0.5) / rings;
    const double b = pi * (i + 1.5) / rings;
    const double high = r * std::cos(a);
    const double low = r * std::cos(b);
    if (z > high || z < low) continue;
    const double t = (high - z) / (high - low);
    return r * ((1 - t) * std::sin(a) + t * std::sin(b));
  }
  return 0;
}

TEST(Minkowski, BoxesAddTheirSides) {
  const std::string sum =
      "minkowski() { cube([3, 4, 5]); translate([7, 0, 1]) cube([1, 2, 3]); }";
  for (const double z : {1.1, 4.0, 8.9}) {
    EXPECT_NEAR(section_area(sum, z), 4 * 6, 1e-9);
  }
  EXPECT_EQ(section_area(sum, 0.9), 0);
  EXPECT_EQ(section_area(sum, 9.1), 0);
}

// A section of box ⊕ sphere is rectangle ⊕ regular polygon: the sphere's
// greatest one beside the box, its section above and below. Steiner's formula.
TEST(Minkowski, ABoxGrowsByASphereAsSteinerSays) {
  for (const int facets : {8, 20, 60}) {
    const std::string sum = fmt::format(
        "minkowski() {{ cube([3, 4, 5]); sphere(r = 2, $fn = {}); }}", facets);
    for (const double z : {-1.2, -0.3, 0.4, 2.5, 4.9, 5.5, 6.4}) {
      const double above = z < 0 ? z : std::max(z - 5, 0.0);
      // Between the rings around the equator the side is the widest ring.
      const double widest = ring_radius(facets, 2, 0);
      const double r = above == 0 ? widest : ring_radius(facets, 2, above);
      EXPECT_NEAR(section_area(sum, z),
                  12 + (3 + 4) * 2 * r + polygon_area(facets, r), 1e-9)
          << facets << " facets at " << z;
    }
  }
}

TEST(Minkowski, AnEllGrowsByABox) {
  const std::string sum =
      "minkowski() { union() { cube([5, 1, 1]); cube([1, 5, 2]); }"
      " cube([1, 1, 1]); }";
  EXPECT_NEAR(section_area(sum, 0.5), 6 * 2 + 2 * 6 - 4, 1e-9);
  EXPECT_NEAR(section_area(sum, 2.5), 2 * 6, 1e-9);
}

TEST(Minkowski, AConcavePolyhedronGrowsByABox) {
  // A box with a notch like a roof upside down, of triangles.
  const std::string notched =
      "polyhedron([[0, 0, 0], [8, 0, 0], [8, 4, 0], [0, 4, 0], [0, 0, 4],"
      " [2, 0, 4], [4, 0, 2], [6, 0, 4], [8, 0, 4], [0, 4, 4], [2, 4, 4],"
      " [4, 4, 2], [6, 4, 4], [8, 4, 4]], [[0, 1, 2, 3], [0, 4, 5, 6, 7, 8, 1],"
      " [3, 2, 13, 12, 11, 10, 9], [0, 3, 9, 4], [1, 8, 13, 2], [4, 9, 10, 5],"
      " [5, 10, 11, 6], [6, 11, 12, 7], [7, 12, 13, 8]]);";
  const std::string sum =
      "minkowski() { " + notched + " cube([1, 1, 1], center = true); }";
  EXPECT_NEAR(section_area(sum, 1), 9 * 5, 1e-9);
  // At 3.5 the notch is as wide as one that is 1 narrower and 0.5 higher.
  EXPECT_NEAR(section_area(sum, 3.5), 9 * 5 - 5 * (2 * (3.5 - 0.5 - 2) - 1),
              1e-9);
}

// A triangle of no width and its reverse, beside a box.
TEST(Minkowski, ANeedleBesideABoxAddsNothingElsewhere) {
  for (const std::string width : {"0", "1e-13", "1e-9"}) {
    const std::string sum =
        "minkowski() { cube(1); polyhedron([[0, 0, 0], [9, 0, 0], [9, 9, 0],"
        " [0, 9, 0], [0, 0, 9], [9, 0, 9], [9, 9, 9], [0, 9, 9], [11, 5, 5],"
        " [12, 5, 5], [11.5, 5 + " +
        width +
        ", 5]], [[0, 1, 2, 3], [0, 4, 5, 1],"
        " [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0], [4, 7, 6, 5], [8, 9, 10],"
        " [10, 9, 8]]); }";
    for (const double z : {0.5, 4.9, 9.7}) {
      EXPECT_NEAR(section_area(sum, z), 100, 1e-6) << width;
    }
  }
}

// Walls 1 thick around a cavity of 8; the small one has walls of 0.2.
const std::string kBigHollow =
    "difference() { cube(10, center = true); cube(8, center = true); }";
const std::string kSmallHollow =
    "difference() { cube(1, center = true); cube(0.6, center = true); }";

TEST(Minkowski, ADifferenceGrowsByABox) {
  const std::string sum =
      "minkowski() { difference() { cube([10, 10, 4]); translate([3, 4, -1])"
      " cube([4, 3, 9]); } translate([30, 0, 0]) cube([2, 1, 1]); }";
  for (const double z : {0.3, 2.0, 4.7}) {
    EXPECT_NEAR(section_area(sum, z), 12 * 11 - 2 * 2, 1e-6);
  }
  EXPECT_EQ(section_area(sum, 5.1), 0);
}

TEST(Minkowski, ASmallHollowBodyAndABigOneLeaveTheRightCavity) {
  for (const std::string& sum :
       {"minkowski() { " + kBigHollow + kSmallHollow + "}",
        "minkowski() { " + kSmallHollow + kBigHollow + "}"}) {
    EXPECT_NEAR(section_area(sum, 0.2), 121 - 49, 1e-6);
    EXPECT_NEAR(section_area(sum, 3.4), 121 - 49, 1e-6);
    EXPECT_NEAR(section_area(sum, 3.6), 121, 1e-6);
    EXPECT_NEAR(section_area(sum, -5.4), 121, 1e-6);
  }
}

TEST(Minkowski, ABodyInTheCavityOfItsLikeFillsIt) {
  const std::string sum = "minkowski() { " + kBigHollow +
                          " difference() { cube(9, center = true);"
                          " cube(8.5, center = true); } }";
  for (const double z : {0.0, 4.0, 9.0}) {
    EXPECT_NEAR(section_area(sum, z), 19 * 19, 1e-6);
  }
}

TEST(Minkowski, ASumIsOneOperandOfABoolean) {
  EXPECT_NEAR(section_area("difference() { cube(20, center = true);"
                           " minkowski() { " +
                               kBigHollow + kSmallHollow + "} }",
                           0.2),
              400 - 121 + 49, 1e-6);
}

TEST(Minkowski, AnIntersectionGrowsByABox) {
  EXPECT_NEAR(section_area("minkowski() { intersection() { cube(4);"
                           " translate([1, 2, 0]) cube(4); } cube(1); }",
                           2),
              4 * 3, 1e-6);
}

// An extruded ell, a plate, a rod and a point.
TEST(Minkowski, FlatOperandsAddTheirExtent) {
  const std::string ell =
      "difference() { cube([3, 3, 2]); translate([1, 1, -1]) cube(4); }";
  const auto area = [&](const std::string& flat) {
    return section_area("minkowski() { " + ell + flat + " }", 1.5);
  };
  EXPECT_NEAR(area("scale([1, 1, 0]) cube(1);"), 4 * 2 + 2 * 2, 1e-6);
  EXPECT_NEAR(area("scale([0, 1, 1]) cube(1);"), 3 * 2 + 1 * 2, 1e-6);
  EXPECT_NEAR(area("scale([1, 0, 0]) cube(1);"), 4 * 1 + 2 * 2, 1e-6);
  EXPECT_NEAR(area("scale(0) cube(1);"), 3 + 2, 1e-6);
  EXPECT_NEAR(area("translate([0, 0, 9]) scale(0) cube(1);"), 0, 1e-6);
}

TEST(Minkowski, TwoPlatesAcrossGiveABox) {
  EXPECT_NEAR(section_area("minkowski() { scale([1, 1, 0]) cube([2, 3, 1]);"
                           " scale([0, 1, 1]) cube([1, 2, 4]); }",
                           1),
              2 * 5, 1e-9);
}

// As in OpenSCAD, wherever it stands among the children.
TEST(Minkowski, AnOperandOfWhichNothingIsLeftDoesNotCount) {
  const std::string nothing =
      "difference() { cube(1); cube(3, center = true); }";
  for (const std::string& sum :
       {"minkowski() { " + nothing + " cube(1); cube([1, 2, 3]); }",
        "minkowski() { cube(1); cube([1, 2, 3]); " + nothing + " }"}) {
    EXPECT_NEAR(section_area(sum, 2), 2 * 3, 1e-9);
    EXPECT_NEAR(section_area(sum, 3.9), 2 * 3, 1e-9);
  }
}

const char* const kBodies[] = {
    "cube([3, 2, 1]);",
    "rotate([20, 30, 40]) cube([2, 3, 1]);",
    "sphere(r = 1, $fn = 9);",
    "translate([4, -30, 0.5]) cylinder(r1 = 1, r2 = 0.3, h = 1, $fn = 7);",
    "linear_extrude(2) difference() { square(4, center = true);"
    " square(3, center = true); }",
    "rotate([90, 0, 10]) linear_extrude(1)"
    " polygon([[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [0, 1]]);",
    "rotate_extrude($fn = 12) translate([2, 0]) circle(r = 0.5, $fn = 6);",
    "linear_extrude(2, twist = 50, slices = 3) square([2, 1]);",
    "union() { cube(1); translate([3, 3, 0]) cube(1); }",
    "difference() { cube([3, 2, 2]); translate([1, 1, 1]) sphere(1, $fn = 8); "
    "}",
};

TEST(MinkowskiLaws, Commutes) {
  for (std::size_t i = 0; i < std::size(kBodies); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const std::string a = kBodies[i];
      const std::string b = kBodies[k];
      expect_equal("minkowski() { " + a + b + "}",
                   "minkowski() { " + b + a + "}", {-0.33, 0.41, 1.27, 2.61});
    }
  }
}

TEST(MinkowskiLaws, FollowsAShiftOfAnOperand) {
  for (const std::string a : kBodies) {
    expect_equal("minkowski() { " + a + " cube(0.5); }",
                 "minkowski() { " + a + " translate([50, 60, 7]) cube(0.5); }",
                 {-0.33, 0.41, 1.27}, 7);
  }
}

TEST(MinkowskiLaws, Associates) {
  const std::string b = "sphere(r = 0.4, $fn = 6);";
  const std::string c = "cylinder(r = 0.3, h = 0.5, $fn = 5);";
  for (const std::string a : kBodies) {
    const std::string flat = "minkowski() { " + a + b + c + "}";
    expect_equal(flat, "minkowski() { minkowski() { " + a + b + "} " + c + "}",
                 {0.41, 1.27});
    expect_equal(flat, "minkowski() { " + a + " minkowski() { " + b + c + "} }",
                 {0.41, 1.27});
  }
}

TEST(MinkowskiLaws, TurnsWithItsOperands) {
  const std::string a = kBodies[7];
  const std::string b = kBodies[2];
  for (const std::string m :
       {"mirror([0, 0, 1])", "scale([1, -2, 1])", "rotate([0, 0, 30])"}) {
    expect_equal(m + " minkowski() { " + a + b + "}",
                 "minkowski() { " + m + a + m + b + "}", {-0.4, 0.3, 1.4});
  }
}

// K ⊕ K ⊕ … ⊕ K is K, enlarged.
TEST(MinkowskiLaws, CopiesOfAConvexSolidEnlargeIt) {
  const auto copies = [](const std::string& solid, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += solid;
    return text;
  };
  const std::string cylinder =
      "rotate([10, 20, 30]) cylinder(r = 1, h = 1, $fn = 12);";
  const std::string cone =
      "rotate([10, 20, 30]) cylinder(r1 = 1, r2 = 0.5, h = 1, $fn = 20);";
  for (const std::string& solid : {cylinder, cone}) {
    for (const int count : {2, 4, 7}) {
      expect_equal("minkowski() {" + copies(solid, count) + "}",
                   fmt::format("scale({}) {}", count, solid),
                   {-0.3 * count, 0.1 * count, 0.4 * count, 0.9 * count});
    }
  }
}

// Nested, each sum is a solid of its own: on its left side, on its right side,
// or as two halves.
TEST(MinkowskiLaws, NestedCopiesOfAConvexSolidEnlargeIt) {
  const auto sum = [](const std::string& a, const std::string& b) {
    return "minkowski() {" + a + b + "}";
  };
  const std::string turn = "rotate([10, 20, 30]) ";
  for (const std::string& solid :
       {std::string("sphere(1, $fn = 12);"), turn + "sphere(1, $fn = 12);",
        std::string("translate([0, 0, -0.5]) cube(1);"),
        turn + "translate([0, 0, -0.5]) cube(1);",
        turn + "cylinder(r = 1, h = 1, $fn = 12);",
        turn + "cylinder(r1 = 1, r2 = 0.5, h = 1, $fn = 20);",
        turn + "hull() { sphere(1, $fn = 12);"
               " translate([1, 1, 0]) cylinder(r = 0.3, h = 1, $fn = 9); }"}) {
    std::string left = solid;
    std::string right = solid;
    for (int count = 2; count <= 8; ++count) {
      left = sum(left, solid);
      right = sum(solid, right);
      const std::string whole = fmt::format("scale({}) {}", count, solid);
      const std::vector<double> heights = {-0.3 * count, 0.1 * count,
                                           0.4 * count};
      expect_equal(left, whole, heights);
      expect_equal(right, whole, heights);
      if (count != 4) continue;
      expect_equal(sum(sum(solid, solid), sum(solid, solid)), whole, heights);
      expect_equal(turn + left, turn + whole, heights);
    }
    expect_equal("minkowski() {" + solid + solid + solid + "}",
                 "scale(3) " + solid, {-0.9, 0.3, 1.2});
  }
}

TEST(MinkowskiLaws, NestedCopiesOfTwoConvexSolidsEnlargeBoth) {
  const std::string a =
      "rotate(45) linear_extrude(1, scale = 0.5) circle(1, $fn = 9);";
  const std::string b = "rotate([30, 20, 45]) cube([1, 0.3, 1]);";
  expect_equal("minkowski() {" + a + "minkowski() {" + a +
                   "minkowski() { minkowski() { minkowski() {" + a + b + "}" +
                   a + "}" + b + "} } }",
               "minkowski() { scale(4) " + a + "scale(2) " + b + "}",
               {-0.5, 0.5, 3, 5.5});
}

TEST(MinkowskiLaws, NestedCopiesAroundAnEllEnlargeIt) {
  for (const auto& [angle, solid] : {std::pair(20, "sphere(1, $fn = 6);"),
                                     {3, "sphere(1, $fn = 8);"},
                                     {24, "sphere(1, $fn = 8);"},
                                     {71, "sphere(1, $fn = 8);"},
                                     {71, "cube(1);"},
                                     {73, "cube(1);"}}) {
    const std::string turn = fmt::format("rotate([{0}, {0}, {0}]) ", angle);
    const std::string ell =
        turn +
        "linear_extrude(1, scale = 0.5)"
        " polygon([[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]]);";
    const std::string copy = turn + solid;
    expect_equal("minkowski() {" + copy + "minkowski() {" + ell +
                     "minkowski() {" + copy + copy + "} } }",
                 "minkowski() {" + ell + "scale(3) " + copy + "}",
                 {-2.17, -1.3, -0.41, 0.1, 0.6, 1.1, 2.3, 3.1, 4.2});
  }
}

// A turned cube of eight: rounding leaves corners within its edges.
TEST(MinkowskiLaws, CornersWithinTheEdgesOfAHullChangeNothing) {
  const std::string eight =
      "for (x = [-1, 0], y = [-1, 0], z = [-1, 0]) translate([x, y, z])"
      " cube(1);";
  const std::string octahedron =
      "hull() { cylinder(r1 = 1, r2 = 0, h = 1, $fn = 4); mirror([0, 0, 1])"
      " cylinder(r1 = 1, r2 = 0, h = 1, $fn = 4); }";
  for (const int angle : {14, 29, 49, 57, 78, 86}) {
    const std::string turn = fmt::format("rotate([{0}, {0}, {0}]) ", angle);
    for (const std::string& other :
         {octahedron, std::string("sphere(1, $fn = 8);")}) {
      const std::string sum = "minkowski() {" + turn + other;
      expect_equal(sum + "hull() {" + turn + eight + "} }",
                   sum + turn + "cube(2, center = true); }",
                   {-1.9, -0.7, 0.4, 1.3, 2.1});
    }
  }
}

TEST(MinkowskiLaws, ATinyBoxChangesTinily) {
  for (const std::string a : kBodies) {
    const auto with =
        sections("minkowski() { " + a + " cube(2e-5, center = true); }", {0.4});
    const auto without = sections(a, {0.4});
    EXPECT_NEAR(support::total_area(with[0]), support::total_area(without[0]),
                1e-3);
    EXPECT_EQ(support::count_loops(with[0]), support::count_loops(without[0]));
  }
}

}  // namespace
}  // namespace lamina
