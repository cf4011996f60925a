#include "csg/lower/detail/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "csg/boundary/leaf_mesh.h"
#include "tests/csg/lower/mesh_checks.h"
#include "tests/support/text.h"

namespace lamina::csg {
namespace {

// A tetrahedron of volume 1/6, its triangles counter-clockwise from outside.
Mesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// The same with three vertices of its own for each triangle, as STL has it;
// those of triangle i are off by i · shift.
Mesh apart(const Mesh& mesh, double shift = 0) {
  Mesh soup;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : mesh.triangles[i]) {
      soup.vertices.push_back(mesh.vertices[corner] +
                              static_cast<double>(i) * shift);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// The triangles by their corners, in an order that neither numbering nor the
// first corner decides.
std::vector<std::array<std::array<double, 3>, 3>> faces_of(const Mesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 3>> faces;
  for (const auto& triangle : mesh.triangles) {
    auto& face = faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& corner = mesh.vertices[triangle[i]];
      face[i] = {corner.x, corner.y, corner.z};
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()),
                face.end());
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

bool is_clean(const Repairs& repairs) {
  return repairs.dropped_triangles == 0 && repairs.turned_triangles == 0 &&
         repairs.repeated_triangles == 0 && repairs.closed_holes.empty();
}

TEST(Repair, LeavesASoundMeshAsItIs) {
  Mesh mesh = tetrahedron();
  EXPECT_TRUE(is_clean(repair(mesh, Vertices::kJoined)));
  EXPECT_EQ(mesh, tetrahedron());
}

TEST(Repair, MakesEqualVerticesOne) {
  Mesh mesh = apart(tetrahedron());
  EXPECT_TRUE(is_clean(repair(mesh)));
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_TRUE(is_closed(mesh));
}

TEST(Repair, MakesNearVerticesOneWhereTheMeshIsOpenOtherwise) {
  Mesh mesh = apart(tetrahedron(), 1e-8);
  EXPECT_TRUE(is_clean(repair(mesh)));
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_TRUE(is_closed(mesh));
}

TEST(Repair, JoinsTrianglesThatAreALittleApart) {
  Mesh mesh = apart(tetrahedron(), 1e-5);
  const Repairs repairs = repair(mesh);
  EXPECT_EQ(repairs.joined_edges, 12U);
  EXPECT_GE(repairs.join_distance, 1e-5 * std::sqrt(3) * (1 - 1e-6));
  EXPECT_LE(repairs.join_distance, 3e-5 * std::sqrt(3) * (1 + 1e-6));
  EXPECT_TRUE(repairs.closed_holes.empty());
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_TRUE(is_closed(mesh));
}

TEST(Repair, KeepsTrianglesApartThatAreNotNear) {
  Mesh mesh = apart(tetrahedron(), 1e-3);
  EXPECT_EQ(repair(mesh).closed_holes.size(), 4U);
  EXPECT_EQ(mesh.vertices.size(), 12U);
}

std::vector<std::string> warnings_of(Mesh mesh) {
  Diagnostics diagnostics;
  repair_and_report(mesh, {}, diagnostics);
  std::vector<std::string> messages;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    messages.push_back(diagnostic.message);
  }
  return messages;
}

TEST(Repair, SaysOnceOverWhatDistanceItJoined) {
  Mesh mesh = apart(tetrahedron());
  for (Vec3& vertex : mesh.vertices) vertex *= 10;
  for (std::size_t i = 0; i < 3; ++i) mesh.vertices[i].x += 1.5e-4;
  EXPECT_EQ(warnings_of(mesh),
            std::vector<std::string>{"The given mesh is not welded: joined 6 "
                                     "open edges within 0.00015 mm"});
}

TEST(Repair, MendsWhatIsFarAway) {
  Mesh mesh = tetrahedron();
  for (Vec3& vertex : mesh.vertices) vertex *= 1e12;
  mesh.triangles.pop_back();
  EXPECT_EQ(warnings_of(mesh),
            std::vector<std::string>{"The given mesh is not closed!"});
}

TEST(Repair, SaysNothingOfWhatOpenScadWouldMerge) {
  EXPECT_TRUE(warnings_of(apart(tetrahedron(), 1e-8)).empty());
}

// Two tetrahedra of one size, of which one is inside out: their volumes cancel,
// while layers show both.
TEST(Repair, WarnsWhereTheLayersHaveAnotherVolume) {
  Mesh mesh = tetrahedron();
  for (const auto& t : tetrahedron().triangles) {
    mesh.triangles.push_back({t[0] + 4, t[2] + 4, t[1] + 4});
  }
  for (const Vec3& vertex : tetrahedron().vertices) {
    mesh.vertices.push_back(vertex + Vec3(5, 0, 0));
  }
  EXPECT_TRUE(warnings_of(mesh).empty());  // closed: as the file says
  mesh.triangles.pop_back();
  const std::vector<std::string> warnings = warnings_of(mesh);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0], "The given mesh is not closed!");
  EXPECT_TRUE(support::has(warnings[1], "does not keep its volume"))
      << warnings[1];
}

TEST(Repair, DropsTrianglesWithACornerTwice) {
  Mesh mesh = tetrahedron();
  mesh.triangles.push_back({1, 1, 2});
  EXPECT_EQ(repair(mesh).dropped_triangles, 1U);
  EXPECT_EQ(faces_of(mesh), faces_of(tetrahedron()));
}

TEST(Repair, TurnsTheMinority) {
  Mesh mesh = tetrahedron();
  std::swap(mesh.triangles[1][1], mesh.triangles[1][2]);
  EXPECT_EQ(repair(mesh).turned_triangles, 1U);
  EXPECT_EQ(faces_of(mesh), faces_of(tetrahedron()));
}

TEST(Repair, TurnsAMeshThatIsInsideOut) {
  Mesh mesh = tetrahedron();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_TRUE(is_clean(repair(mesh)));
  EXPECT_NEAR(signed_volume(mesh), 1.0 / 6, 1e-15);
}

TEST(Repair, DropsATriangleThatIsThereTwice) {
  Mesh mesh = tetrahedron();
  mesh.triangles.push_back({2, 3, 1});
  EXPECT_EQ(repair(mesh).repeated_triangles, 1U);
  EXPECT_EQ(faces_of(mesh), faces_of(tetrahedron()));
}

TEST(Repair, ClosesAHoleAndSaysWhereItWas) {
  Mesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  const Repairs repairs = repair(mesh);
  ASSERT_EQ(repairs.closed_holes.size(), 1U);
  EXPECT_EQ(repairs.closed_holes[0].edge_count, 3U);
  EXPECT_EQ(repairs.closed_holes[0].box.low, Vec3(0, 0, 0));
  EXPECT_EQ(repairs.closed_holes[0].box.high, Vec3(1, 1, 1));
  EXPECT_TRUE(is_closed(mesh));
}

TEST(Repair, KeepsTwoSolidsThatShareAnEdge) {
  Mesh mesh = tetrahedron();
  mesh.vertices.insert(mesh.vertices.end(), {{0, -1, 0}, {0, 0, -1}});
  // The first one turned by half a turn about the x axis: both have 0-1.
  for (const auto& t : tetrahedron().triangles) {
    std::array<std::uint32_t, 3> turned = t;
    for (std::uint32_t& corner : turned) corner += corner > 1 ? 2 : 0;
    mesh.triangles.push_back(turned);
  }
  const Mesh before = mesh;
  EXPECT_TRUE(is_clean(repair(mesh)));
  EXPECT_EQ(faces_of(mesh), faces_of(before));
}

TEST(Repair, LeavesOutVerticesThatNoTriangleNames) {
  Mesh mesh = tetrahedron();
  mesh.vertices.push_back({9, 9, 9});
  EXPECT_TRUE(is_clean(repair(mesh)));
  EXPECT_EQ(mesh.vertices.size(), 4U);
}

}  // namespace
}  // namespace lamina::csg
