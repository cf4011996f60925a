// Compares what is read from files with the installed openscad: the vertices
// must be the same.
//
// openscad writes single precision, so vertices are equal within a float's
// spacing. A vertex in the middle of a straight edge may be there in one and
// not in the other.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/openscad.h"
#include "tests/support/design.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::csg {
namespace {

// Where Debian's openscad-testing-data puts its files.
const std::string kData = "/usr/share/openscad/testdata/";

// Half a float's spacing, twice: both programs round.
constexpr double kFloat = 1.2e-7;

// Drawings lie on openscad's grid of 2^-16 mm there.
constexpr double kGrid = 4e-5;

Mesh openscad_mesh(const std::string& scad) {
  const support::TemporaryFolder folder;
  const std::string design = folder.write("design.scad", scad);
  const std::string stl = folder.file("design.stl");
  const support::ProcessResult result = support::run_process(
      {"openscad", "--export-format", "binstl", "-o", stl, design});
  EXPECT_EQ(result.status, 0) << result.errors;
  return oracle::read_binary_stl(stl);
}

Mesh lamina_mesh(const std::string& scad) {
  const support::Design design = support::Design::from_text(scad);
  Mesh all;
  for (const Instance& instance : design.scene().instances) {
    const Mesh mesh = explicit_mesh(design.scene().leaves[instance.leaf]);
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (const Vec3& vertex : mesh.vertices) {
      all.vertices.push_back(instance.world_from_leaf * Vec4(vertex, 1));
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      all.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return all;
}

bool are_near(Vec3 a, Vec3 b, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(a[i] - b[i]) > tolerance * (1 + std::abs(a[i]))) return false;
  }
  return true;
}

bool is_on_edge(Vec3 point, Vec3 a, Vec3 b, double tolerance) {
  const Vec3 along = b - a;
  const double length = glm::dot(along, along);
  const double share = length > 0 ? glm::dot(point - a, along) / length : 0;
  return are_near(point, a + along * std::clamp(share, 0.0, 1.0), tolerance);
}

// The vertices of `some` that stand on no vertex and on no edge of `other`.
std::vector<std::string> strangers(const Mesh& some, const Mesh& other,
                                   double tolerance) {
  std::vector<Vec3> others = other.vertices;
  const auto by_x = [](Vec3 a, Vec3 b) { return a.x < b.x; };
  std::sort(others.begin(), others.end(), by_x);
  const auto has_partner = [&](Vec3 vertex) {
    const double reach = 2 * tolerance * (1 + std::abs(vertex.x));
    auto at = std::lower_bound(others.begin(), others.end(),
                               vertex - Vec3(reach), by_x);
    for (; at != others.end() && at->x <= vertex.x + reach; ++at) {
      if (are_near(vertex, *at, tolerance)) return true;
    }
    for (const auto& t : other.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (is_on_edge(vertex, other.vertices[t[i]],
                       other.vertices[t[(i + 1) % 3]], tolerance)) {
          return true;
        }
      }
    }
    return false;
  };
  std::vector<std::string> found;
  for (const Vec3 vertex : some.vertices) {
    if (has_partner(vertex)) continue;
    found.push_back(fmt::format("[{}, {}, {}]", vertex.x, vertex.y, vertex.z));
  }
  return found;
}

void expect_the_same_vertices(const std::string& scad, double tolerance) {
  const Mesh expected = openscad_mesh(scad);
  const Mesh actual = lamina_mesh(scad);
  EXPECT_FALSE(expected.triangles.empty());
  EXPECT_EQ(strangers(expected, actual, tolerance), std::vector<std::string>());
  EXPECT_EQ(strangers(actual, expected, tolerance), std::vector<std::string>());
  const double volume = signed_volume(expected);
  EXPECT_NEAR(signed_volume(actual), volume,
              10 * tolerance * (1 + std::abs(volume)));
}

class Meshes : public testing::TestWithParam<std::string> {};

TEST_P(Meshes, HaveOpenScadsVertices) {
  expect_the_same_vertices(fmt::format("import(\"{}{}\");", kData, GetParam()),
                           kFloat);
}

INSTANTIATE_TEST_SUITE_P(
    TestingData, Meshes,
    testing::Values("amf/cube-with-hole.amf", "amf/sphere20face.amf",
                    "amf/split_pyramid.amf", "amf/tetra_multicolor.amf",
                    "manual/issue214/X/cube.stl", "scad/3D/features/import.3mf",
                    "scad/3D/features/import.stl",
                    "scad/3D/features/import_bin.stl",
                    "scad/3D/features/import_bin_solid.stl",
                    "scad/bugs/issue945e.stl",
                    "stl/adns2610_dev_circuit_inv.stl"));

class Drawings : public testing::TestWithParam<std::string> {};

TEST_P(Drawings, HaveOpenScadsVertices) {
  expect_the_same_vertices(
      fmt::format("linear_extrude(1) import(\"{}{}\");", kData, GetParam()),
      kGrid);
}

INSTANTIATE_TEST_SUITE_P(
    Dxf, Drawings,
    testing::Values("dxf/arc.dxf", "dxf/circle-advanced.dxf",
                    "dxf/circle-double.dxf", "dxf/circle-small.dxf",
                    "dxf/circle.dxf", "dxf/ellipse-arc-rot.dxf",
                    "dxf/ellipse-arc.dxf", "dxf/ellipse-reverse.dxf",
                    "dxf/ellipse-rot.dxf", "dxf/ellipse.dxf",
                    "dxf/lwpolyline-closed.dxf", "dxf/lwpolyline.dxf",
                    "dxf/lwpolyline2.dxf", "dxf/multiple-layers.dxf",
                    "dxf/open-polyline.dxf", "dxf/polygon-concave-hole.dxf",
                    "dxf/polygon-concave-simple.dxf", "dxf/polygon-concave.dxf",
                    "dxf/polygon-holes-touch.dxf", "dxf/polygon-intersect.dxf",
                    "dxf/polygon-many-holes.dxf", "dxf/polygon-mesh.dxf",
                    "dxf/polygon-overlap.dxf", "dxf/polygon-riser.dxf",
                    "dxf/polygon-self-intersect.dxf", "dxf/polygon8.dxf",
                    "dxf/polygons.dxf", "dxf/transform-insert.dxf",
                    "dxf/triangle-with-duplicate-vertex.dxf",
                    "scad/misc/localfiles_dir/localfile.dxf"));

INSTANTIATE_TEST_SUITE_P(
    Svg, Drawings,
    testing::Values("svg/box-w-holes.svg", "svg/line-cap-line-join.svg",
                    "svg/simple.svg", "svg/svg-spec/spec-paths-arcs01.svg",
                    "svg/svg-spec/spec-paths-arcs02.svg",
                    "svg/svg-spec/spec-paths-cubic01.svg",
                    "svg/svg-spec/spec-paths-cubic02.svg",
                    "svg/svg-spec/spec-paths-quad01.svg",
                    "svg/svg-spec/spec-paths-triangle01.svg",
                    "svg/svg-spec/spec-shapes-circle01.svg",
                    "svg/svg-spec/spec-shapes-ellipse01.svg",
                    "svg/svg-spec/spec-shapes-line01.svg",
                    "svg/svg-spec/spec-shapes-polygon01.svg",
                    "svg/svg-spec/spec-shapes-polyline01.svg",
                    "svg/svg-spec/spec-shapes-rect01.svg",
                    "svg/svg-spec/spec-shapes-rect02.svg",
                    "svg/viewbox/viewbox_300x400_meet_xMaxYMin.svg",
                    "svg/viewbox/viewbox_300x400_meet_xMidYMin.svg",
                    "svg/viewbox/viewbox_300x400_meet_xMinYMin.svg",
                    "svg/viewbox/viewbox_300x400_none.svg",
                    "svg/viewbox/viewbox_600x200_meet_xMinYMax.svg",
                    "svg/viewbox/viewbox_600x200_meet_xMinYMid.svg",
                    "svg/viewbox/viewbox_600x200_meet_xMinYMin.svg",
                    "svg/viewbox/viewbox_600x200_none.svg",
                    "svg/viewbox/viewbox_600x200_slice_xMaxYMin.svg",
                    "svg/viewbox/viewbox_600x200_slice_xMidYMin.svg",
                    "svg/viewbox/viewbox_600x200_slice_xMinYMin.svg",
                    "svg/viewbox/viewbox_600x600_slice_xMinYMax.svg",
                    "svg/viewbox/viewbox_600x600_slice_xMinYMid.svg",
                    "svg/viewbox/viewbox_600x600_slice_xMinYMin.svg"));

// OpenSCAD puts strokes on a grid of 1e-4 units of the drawing.
TEST(Drawings, StrokesHaveOpenScadsVertices) {
  expect_the_same_vertices(
      fmt::format("linear_extrude(1) import(\"{}svg/line-cap-line-join.svg\");",
                  kData),
      4 * kGrid);
}

TEST(Drawings, ParametersMoveScaleAndCentre) {
  for (const std::string call :
       {"import(\"{}dxf/multiple-layers.dxf\", layer = \"0\");",
        "import(\"{}dxf/polygons.dxf\", origin = [10, -5], scale = 0.5);",
        "import(\"{}dxf/circle.dxf\", $fn = 7);",
        "import(\"{}svg/box-w-holes.svg\", center = true);",
        "import(\"{}svg/simple.svg\", dpi = 96);"}) {
    SCOPED_TRACE(call);
    expect_the_same_vertices(
        "linear_extrude(2) " + fmt::format(fmt::runtime(call), kData), kGrid);
  }
}

TEST(Drawings, DeprecatedExtrusionsOfFilesAreTheSame) {
  for (const std::string call :
       {"linear_extrude(file = \"{}dxf/polygon8.dxf\", height = 3, "
        "origin = [2, 1], scale = 0.5);",
        "dxf_linear_extrude(\"{}dxf/polygons.dxf\", height = 2);",
        "rotate_extrude(file = \"{}dxf/circle-small.dxf\", "
        "origin = [-1000, 0], $fn = 8);"}) {
    SCOPED_TRACE(call);
    expect_the_same_vertices(fmt::format(fmt::runtime(call), kData), kGrid);
  }
}

class Surfaces : public testing::TestWithParam<std::string> {};

TEST_P(Surfaces, HaveOpenScadsVertices) {
  expect_the_same_vertices(
      fmt::format("surface(\"{}{}\", center = true);", kData, GetParam()),
      kFloat);
}

INSTANTIATE_TEST_SUITE_P(
    TestingData, Surfaces,
    testing::Values(
        "scad/3D/features/surface-simple.dat",
        "scad/3D/features/surface-simple2.dat", "scad/3D/features/surface.dat",
        "scad/3D/issues/issue1223.dat", "scad/3D/issues/issue1223-2.dat",
        "scad/3D/issues/issue1223b.dat", "scad/3D/issues/issue1223b.png",
        "scad/misc/localfiles_dir/localfile.dat",
        "image/black-white-gradient.png"));

TEST(Surfaces, InvertedImagesAreTheSame) {
  expect_the_same_vertices(
      fmt::format("surface(\"{}image/black-white-gradient.png\", "
                  "invert = true);",
                  kData),
      kFloat);
}

// Files that openscad writes itself: of OFF the data has none, and its 3MF has
// sizes of 64 bits.
class OwnFiles : public testing::TestWithParam<const char*> {};

TEST_P(OwnFiles, AreReadTheSame) {
  const support::TemporaryFolder folder;
  const std::string design = folder.write(
      "design.scad", "difference() { sphere(5, $fn = 20); cube(9); }");
  const std::string file = folder.file(std::string("design.") + GetParam());
  const support::ProcessResult result =
      support::run_process({"openscad", "-o", file, design});
  ASSERT_EQ(result.status, 0) << result.errors;
  expect_the_same_vertices(fmt::format("import(\"{}\");", file), kFloat);
}

INSTANTIATE_TEST_SUITE_P(Formats, OwnFiles,
                         testing::Values("off", "amf", "3mf", "stl"));

}  // namespace
}  // namespace lamina::csg
