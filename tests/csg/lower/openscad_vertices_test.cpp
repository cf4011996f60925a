// Compares lamina's tessellation with the installed openscad, vertex for
// vertex.
//
// openscad writes single precision, so vertices are equal within a float's
// spacing; regions that went through its polygon clipper lie on a grid of
// 2^-16 mm and may be off by that.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "csg/degrees.h"
#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

using Corner = std::array<double, 3>;
using Facet = std::array<Corner, 3>;

// Half a float's spacing, twice: both programs round.
constexpr double kFloat = 1.2e-7;
constexpr double kGrid = 4e-5;  // two clipper grid cells of openscad

struct Case {
  const char* name;
  std::string scad;
  std::function<Node*(TreeBuilder&)> make;
  double tolerance = kFloat;
  // Twisted sides: the triangles count too, not only their corners. Those of
  // the flat top and bottom do not: any triangulation is right there.
  bool has_telling_sides = false;
};

std::ostream& operator<<(std::ostream& out, const Case& test) {
  return out << test.scad.substr(0, 100);
}

// Triangles of a binary STL: 80 bytes, their number, and for each a normal,
// three corners and two bytes.
std::vector<Facet> read_stl(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(80);
  std::uint32_t count = 0;
  file.read(reinterpret_cast<char*>(&count), sizeof count);
  std::vector<Facet> facets(file ? count : 0);
  for (Facet& facet : facets) {
    std::array<float, 12> numbers{};
    file.read(reinterpret_cast<char*>(numbers.data()), sizeof numbers);
    file.ignore(2);
    for (std::size_t i = 0; i < 9; ++i) facet[i / 3][i % 3] = numbers[i + 3];
  }
  return facets;
}

std::vector<Facet> run_openscad(const Case& test) {
  const auto base =
      std::filesystem::temp_directory_path() /
      ("lamina_" + std::string(test.name) + "_" + std::to_string(::getpid()));
  const std::string scad = base.string() + ".scad";
  const std::string stl = base.string() + ".stl";
  std::ofstream(scad) << test.scad << '\n';
  const std::string command = "openscad " + scad + " -o " + stl +
                              " --export-format binstl > /dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  const std::vector<Facet> facets = read_stl(stl);
  std::filesystem::remove(scad);
  std::filesystem::remove(stl);
  return facets;
}

std::vector<Facet> run_lamina(const Case& test) {
  TreeBuilder b;
  Diagnostics diagnostics;
  const Lowered lowered = lower(b.tree({test.make(b)}), {}, diagnostics);
  EXPECT_NE(lowered.scene(), nullptr);
  std::vector<Facet> facets;
  if (!lowered.scene()) return facets;
  for (const Instance& instance : lowered.scene()->instances) {
    const Mesh mesh = explicit_mesh(lowered.scene()->leaves[instance.leaf]);
    for (const auto& t : mesh.triangles) {
      facets.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 p = instance.world_from_leaf * Vec4(mesh.vertices[t[i]], 1);
        facets.back()[i] = {p.x, p.y, p.z};
      }
    }
  }
  return facets;
}

bool are_near(const Corner& a, const Corner& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(a[i] - b[i]) > tolerance * (1 + std::abs(a[i]))) return false;
  }
  return true;
}

bool are_near(const Facet& a, const Facet& b, double tolerance) {
  for (std::size_t turn = 0; turn < 3; ++turn) {
    bool equal = true;
    for (std::size_t i = 0; i < 3; ++i) {
      equal = equal && are_near(a[i], b[(i + turn) % 3], tolerance);
    }
    if (equal) return true;
  }
  return false;
}

std::set<Corner> corners_of(const std::vector<Facet>& facets) {
  std::set<Corner> corners;
  for (const Facet& facet : facets) corners.insert(facet.begin(), facet.end());
  return corners;
}

std::vector<Facet> sides_of(const std::vector<Facet>& facets) {
  std::vector<Facet> sides;
  for (const Facet& f : facets) {
    if (f[0][2] != f[1][2] || f[1][2] != f[2][2]) sides.push_back(f);
  }
  return sides;
}

// How many of `some` have no partner in `others`.
template <typename Some, typename Others>
std::size_t count_strangers(const Some& some, const Others& others,
                            double tolerance) {
  std::size_t count = 0;
  for (const auto& one : some) {
    count += std::none_of(others.begin(), others.end(), [&](const auto& other) {
      return are_near(one, other, tolerance);
    });
  }
  return count;
}

Facets default_facets() { return {}; }
Facets fn(double n) { return {n}; }

Node* polygon_star(TreeBuilder& b) {
  return b.polygon({{4, 0}, {1, 1}, {0, 4}, {-1, 1}, {-4, 0}, {0, -1}});
}

// A box with a bumpy lid of quads that no plane holds, turned by `angle`.
Case bumpy_lid(const char* name, double angle_deg) {
  constexpr std::uint32_t kCells = 4;
  constexpr std::uint32_t kSide = kCells + 1;
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const Vec2 p(i, 1.5 * j);
      const double c = cos_deg(angle_deg);
      const double s = sin_deg(angle_deg);
      points.push_back({c * p.x - s * p.y, s * p.x + c * p.y,
                        2 + 0.15 * ((3 * i * i + 5 * j + i * j) % 7)});
    }
  }
  for (std::uint32_t i = 0; i < kCells; ++i) {
    for (std::uint32_t j = 0; j < kCells; ++j) {
      const std::uint32_t a = i * kSide + j;
      faces.push_back({a, a + 1, a + kSide + 1, a + kSide});
    }
  }
  // A point far below closes it.
  std::vector<std::uint32_t> rim;
  for (std::uint32_t i = 0; i < kCells; ++i) rim.push_back(i);
  for (std::uint32_t i = 0; i < kCells; ++i) rim.push_back(i * kSide + kCells);
  for (std::uint32_t i = kCells; i > 0; --i) rim.push_back(kCells * kSide + i);
  for (std::uint32_t i = kCells; i > 0; --i) rim.push_back(i * kSide);
  const auto apex = static_cast<std::uint32_t>(points.size());
  points.push_back({1, 2, -30});
  for (std::size_t i = 0; i < rim.size(); ++i) {
    faces.push_back({rim[(i + 1) % rim.size()], rim[i], apex});
  }

  std::ostringstream scad;
  scad.precision(17);
  scad << "polyhedron([";
  for (const Vec3& p : points) {
    scad << '[' << p.x << ',' << p.y << ',' << p.z << "],";
  }
  scad << "],[";
  for (const auto& face : faces) {
    scad << '[';
    for (const std::uint32_t i : face) scad << i << ',';
    scad << "],";
  }
  scad << "]);";
  return {
      name, scad.str(),
      [points, faces](TreeBuilder& b) { return b.polyhedron(points, faces); },
      kFloat, true};
}

Case extrusion(const char* name, const char* scad, LinearExtrudeParams params,
               std::function<Node*(TreeBuilder&)> outline) {
  return {name, scad,
          [params, outline](TreeBuilder& b) {
            return b.linear_extrude(params, {outline(b)});
          },
          kGrid, true};
}

std::vector<Case> all_cases() {
  std::vector<Case> cases{
      {"cube", "cube([1,2.5,3]);",
       [](TreeBuilder& b) {
         return b.cube({1, 2.5, 3});
       }},
      {"cube_centred", "cube([1,2.5,3], center=true);",
       [](TreeBuilder& b) {
         return b.cube({1, 2.5, 3}, true);
       }},
      {"sphere_fn", "sphere(r=3, $fn=24);",
       [](TreeBuilder& b) { return b.sphere(3, 24); }},
      {"sphere_odd", "sphere(r=3, $fn=7);",
       [](TreeBuilder& b) { return b.sphere(3, 7); }},
      {"sphere_fn_fraction", "sphere(r=3, $fn=9.7);",
       [](TreeBuilder& b) { return b.sphere(3, 9.7); }},
      {"sphere_fs", "sphere(r=9);",
       [](TreeBuilder& b) {
         return b.node(Sphere{9, default_facets()});
       }},
      {"sphere_fa_fs", "sphere(r=9, $fa=3, $fs=0.7);",
       [](TreeBuilder& b) {
         return b.node(Sphere{9, {0, 3, 0.7}});
       }},
      {"sphere_tiny", "sphere(r=0.1);",
       [](TreeBuilder& b) {
         return b.node(Sphere{0.1, default_facets()});
       }},
      {"cylinder", "cylinder(h=4, r=3, $fn=30);",
       [](TreeBuilder& b) { return b.cylinder(4, 3, 3, 30); }},
      {"cylinder_default", "cylinder(h=4, r=3, center=true);",
       [](TreeBuilder& b) {
         return b.node(Cylinder{4, 3, 3, true, default_facets()});
       }},
      {"frustum", "cylinder(h=4, r1=3, r2=1.7, $fn=12);",
       [](TreeBuilder& b) { return b.cylinder(4, 3, 1.7, 12); }},
      {"cone", "cylinder(h=4, r1=3, r2=0, $fn=11);",
       [](TreeBuilder& b) { return b.cylinder(4, 3, 0, 11); }},
      {"cone_down", "cylinder(h=4, r1=0, r2=3);",
       [](TreeBuilder& b) {
         return b.node(Cylinder{4, 0, 3, false, default_facets()});
       }},
      {"torus", "rotate_extrude($fn=20) translate([5,0]) circle(2, $fn=9);",
       [](TreeBuilder& b) {
         return b.node(RotateExtrude{360, 2, fn(20), 180},
                       {b.translate({5, 0, 0}, {b.node(Circle{2, fn(9)})})});
       }},
      {"torus_odd_default", "rotate_extrude() translate([4.5,1]) square(1);",
       [](TreeBuilder& b) {
         return b.node(RotateExtrude{.start_deg = 180},
                       {b.translate({4.5, 1, 0}, {b.node(Square{})})});
       }},
      {"torus_odd", "rotate_extrude($fn=7) translate([4.5,1]) square(1);",
       [](TreeBuilder& b) {
         return b.node(RotateExtrude{360, 2, fn(7), 180},
                       {b.translate({4.5, 1, 0}, {b.node(Square{})})});
       }},
      {"torus_negative", "rotate_extrude($fn=7) translate([-4.5,1]) square(1);",
       [](TreeBuilder& b) {
         return b.node(RotateExtrude{360, 2, fn(7), 180},
                       {b.translate({-4.5, 1, 0}, {b.node(Square{})})});
       }},
      {"lathe_on_axis", "rotate_extrude($fn=12) square([3,2]);",
       [](TreeBuilder& b) {
         return b.node(RotateExtrude{360, 2, fn(12), 180},
                       {b.node(Square{{3, 2}, false})});
       }},
      {"part_turn",
       "rotate_extrude(angle=100, $fn=20) translate([5,0]) circle(2, $fn=9);",
       [](TreeBuilder& b) {
         return b.node(RotateExtrude{100, 2, fn(20)},
                       {b.translate({5, 0, 0}, {b.node(Circle{2, fn(9)})})});
       }},
      {"part_turn_back",
       "rotate_extrude(angle=-250) translate([5,0]) square(1);",
       [](TreeBuilder& b) {
         return b.node(RotateExtrude{-250, 2, default_facets()},
                       {b.translate({5, 0, 0}, {b.node(Square{})})});
       }},
      {"prism", "linear_extrude(3) circle(2, $fn=13);",
       [](TreeBuilder& b) {
         return b.linear_extrude({.height = 3}, {b.node(Circle{2, fn(13)})});
       }},
      {"mirrored_and_sheared",
       "multmatrix([[-1,0.2,0,1],[0,1,0.3,2],[0,0,1.5,3],[0,0,0,1]]) "
       "sphere(r=3, $fn=12);",
       [](TreeBuilder& b) {
         Mat4 m(1.0);
         m[0] = {-1, 0, 0, 0};
         m[1] = {0.2, 1, 0, 0};
         m[2] = {0, 0.3, 1.5, 0};
         m[3] = {1, 2, 3, 1};
         return b.transform(m, {b.sphere(3, 12)});
       }},
      {"polyhedron_of_quads",
       "polyhedron([[0,0,0],[4,0,0],[4,3,0],[0,3,0],[1,1,2],[3,1,2],[3,2,2],"
       "[1,2,2]],[[0,1,2,3],[7,6,5,4],[0,4,5,1],[1,5,6,2],[2,6,7,3],"
       "[3,7,4,0]]);",
       [](TreeBuilder& b) {
         return b.polyhedron({{0, 0, 0},
                              {4, 0, 0},
                              {4, 3, 0},
                              {0, 3, 0},
                              {1, 1, 2},
                              {3, 1, 2},
                              {3, 2, 2},
                              {1, 2, 2}},
                             {{0, 1, 2, 3},
                              {7, 6, 5, 4},
                              {0, 4, 5, 1},
                              {1, 5, 6, 2},
                              {2, 6, 7, 3},
                              {3, 7, 4, 0}});
       }},
  };
  const auto square = [](TreeBuilder& b) {
    return b.node(Square{{4, 3}, true});
  };
  const auto frame = [](TreeBuilder& b) {
    return b.node(Difference{},
                  {b.node(Circle{4, fn(16)}), b.node(Square{{3, 2}, true})});
  };
  const auto far_circle = [](TreeBuilder& b) {
    return b.translate({6, 0, 0}, {b.node(Circle{2, fn(10)})});
  };
  const auto twisted = [](double twist) {
    LinearExtrudeParams p{.height = 10};
    p.twist_deg = twist;
    p.has_twist = true;
    return p;
  };
  const auto scaled = [](LinearExtrudeParams p, Vec2 scale) {
    p.scale = scale;
    return p;
  };
  const auto sliced = [](LinearExtrudeParams p, int slices) {
    p.slices = slices;
    return p;
  };
  const auto detailed = [](LinearExtrudeParams p, const Facets& facets) {
    p.facets = facets;
    return p;
  };
  cases.push_back(extrusion("twist",
                            "linear_extrude(10, twist=90) "
                            "square([4,3], center=true);",
                            twisted(90), square));
  cases.push_back(extrusion("twist_back",
                            "linear_extrude(10, twist=-90) "
                            "square([4,3], center=true);",
                            twisted(-90), square));
  cases.push_back(
      extrusion("twist_star",
                "linear_extrude(10, twist=200) "
                "polygon([[4,0],[1,1],[0,4],[-1,1],[-4,0],[0,-1]]);",
                twisted(200), polygon_star));
  cases.push_back(
      extrusion("twist_frame",
                "linear_extrude(10, twist=-60, slices=7) difference() {"
                "circle(4, $fn=16); square([3,2], center=true);}",
                sliced(twisted(-60), 7), frame));
  cases.push_back(
      extrusion("twist_far",
                "linear_extrude(10, twist=360, $fn=20) translate([6,0]) "
                "circle(2, $fn=10);",
                detailed(twisted(360), fn(20)), far_circle));
  cases.push_back(
      extrusion("twist_far_fs",
                "linear_extrude(10, twist=360, $fa=5, $fs=1) translate([6,0]) "
                "circle(2, $fn=10);",
                detailed(twisted(360), {0, 5, 1}), far_circle));
  cases.push_back(extrusion("twist_cone",
                            "linear_extrude(10, twist=90, "
                            "scale=0.3) square([4,3], center=true);",
                            scaled(twisted(90), Vec2(0.3)), square));
  cases.push_back(extrusion("twist_flare",
                            "linear_extrude(10, twist=90, "
                            "scale=2.5) square([4,3], center=true);",
                            scaled(twisted(90), Vec2(2.5)), square));
  cases.push_back(extrusion("twist_to_point",
                            "linear_extrude(10, twist=90, "
                            "scale=0) square([4,3], center=true);",
                            scaled(twisted(90), Vec2(0)), square));
  cases.push_back(extrusion("uneven",
                            "linear_extrude(10, scale=[2,0.5]) "
                            "square([4,3], center=true);",
                            scaled({.height = 10}, {2, 0.5}), square));
  cases.push_back(extrusion("uneven_fn",
                            "linear_extrude(10, scale=[2,0.5], "
                            "$fn=5) translate([6,0]) circle(2, $fn=10);",
                            detailed(scaled({.height = 10}, {2, 0.5}), fn(5)),
                            far_circle));
  cases.push_back(
      extrusion("uneven_twist",
                "linear_extrude(10, twist=70, scale=[2,0.5]) "
                "polygon([[4,0],[1,1],[0,4],[-1,1],[-4,0],[0,-1]]);",
                scaled(twisted(70), {2, 0.5}), polygon_star));
  cases.push_back(bumpy_lid("bumpy_lid", 0));
  cases.push_back(bumpy_lid("bumpy_lid_turned", 25));
  cases.push_back(bumpy_lid("bumpy_lid_back", 180));
  const auto offset_of = [&](const char* name, const char* scad, Offset op) {
    Case test = extrusion(name, scad, {.height = 1}, [op](TreeBuilder& b) {
      return b.node(op, {polygon_star(b)});
    });
    test.has_telling_sides = false;
    cases.push_back(test);
  };
  offset_of("offset_round",
            "linear_extrude(1) offset(r=1, $fn=20) "
            "polygon([[4,0],[1,1],[0,4],[-1,1],[-4,0],[0,-1]]);",
            {.amount = 1, .facets = fn(20)});
  offset_of("offset_inwards",
            "linear_extrude(1) offset(r=-0.3) "
            "polygon([[4,0],[1,1],[0,4],[-1,1],[-4,0],[0,-1]]);",
            {.amount = -0.3});
  offset_of("offset_delta",
            "linear_extrude(1) offset(delta=0.5) "
            "polygon([[4,0],[1,1],[0,4],[-1,1],[-4,0],[0,-1]]);",
            {.amount = 0.5, .is_delta = true});
  offset_of("offset_chamfer",
            "linear_extrude(1) offset(delta=0.5, chamfer=true) "
            "polygon([[4,0],[1,1],[0,4],[-1,1],[-4,0],[0,-1]]);",
            {.amount = 0.5, .is_delta = true, .chamfer = true});
  return cases;
}

class OpenscadVertices : public ::testing::TestWithParam<Case> {};

TEST_P(OpenscadVertices, AreOurs) {
  const Case& test = GetParam();
  const auto theirs = run_openscad(test);
  const auto ours = run_lamina(test);
  ASSERT_FALSE(theirs.empty());
  EXPECT_EQ(
      count_strangers(corners_of(ours), corners_of(theirs), test.tolerance),
      0u);
  EXPECT_EQ(
      count_strangers(corners_of(theirs), corners_of(ours), test.tolerance),
      0u);
  if (!test.has_telling_sides) return;
  EXPECT_EQ(count_strangers(sides_of(ours), sides_of(theirs), test.tolerance),
            0u);
  EXPECT_EQ(sides_of(ours).size(), sides_of(theirs).size());
}

INSTANTIATE_TEST_SUITE_P(Primitives, OpenscadVertices,
                         ::testing::ValuesIn(all_cases()),
                         [](const auto& test) {
                           return std::string(test.param.name);
                         });

}  // namespace
}  // namespace lamina::csg
