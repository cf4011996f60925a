// What is read from files, against the installed openscad: the same vertices.
//
// openscad writes single precision, so vertices are equal within a float's
// spacing.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "csg/solid/leaf_mesh.h"
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

std::vector<Vec3> openscad_vertices(const std::string& scad) {
  const support::TemporaryFolder folder;
  const std::string design = folder.write("design.scad", scad);
  const std::string stl = folder.file("design.stl");
  const support::ProcessResult result = support::run_process(
      {"openscad", "--export-format", "binstl", "-o", stl, design});
  EXPECT_EQ(result.status, 0) << result.errors;
  return oracle::read_binary_stl(stl).vertices;
}

std::vector<Vec3> lamina_vertices(const std::string& scad) {
  const support::Design design = support::Design::from_text(scad);
  std::vector<Vec3> vertices;
  for (const Instance& instance : design.scene().instances) {
    const Mesh mesh = explicit_mesh(design.scene().leaves[instance.leaf]);
    for (const Vec3& vertex : mesh.vertices) {
      vertices.push_back(instance.world_from_leaf * Vec4(vertex, 1));
    }
  }
  return vertices;
}

bool are_near(Vec3 a, Vec3 b, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(a[i] - b[i]) > tolerance * (1 + std::abs(a[i]))) return false;
  }
  return true;
}

// The vertices of `some` that have no partner in `others`.
std::vector<std::string> strangers(const std::vector<Vec3>& some,
                                   std::vector<Vec3> others, double tolerance) {
  const auto by_x = [](Vec3 a, Vec3 b) { return a.x < b.x; };
  std::sort(others.begin(), others.end(), by_x);
  std::vector<std::string> found;
  for (const Vec3 vertex : some) {
    const double reach = 2 * tolerance * (1 + std::abs(vertex.x));
    auto other = std::lower_bound(others.begin(), others.end(),
                                  vertex - Vec3(reach), by_x);
    bool has_partner = false;
    for (; other != others.end() && other->x <= vertex.x + reach; ++other) {
      has_partner = has_partner || are_near(vertex, *other, tolerance);
    }
    if (!has_partner) {
      found.push_back(
          fmt::format("[{}, {}, {}]", vertex.x, vertex.y, vertex.z));
    }
  }
  return found;
}

void expect_the_same_vertices(const std::string& scad, double tolerance) {
  const auto expected = openscad_vertices(scad);
  const auto actual = lamina_vertices(scad);
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(strangers(expected, actual, tolerance), std::vector<std::string>());
  EXPECT_EQ(strangers(actual, expected, tolerance), std::vector<std::string>());
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

// There is no OFF file in the data: openscad writes one.
TEST(Off, WrittenByOpenScadIsReadTheSame) {
  const support::TemporaryFolder folder;
  const std::string design = folder.write(
      "design.scad", "difference() { sphere(5, $fn = 20); cube(9); }");
  const std::string off = folder.file("design.off");
  const support::ProcessResult result =
      support::run_process({"openscad", "-o", off, design});
  ASSERT_EQ(result.status, 0) << result.errors;
  expect_the_same_vertices(fmt::format("import(\"{}\");", off), kFloat);
}

}  // namespace
}  // namespace lamina::csg
