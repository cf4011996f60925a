// OpenMesh's own writer makes the files.

#include <sstream>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include "csg/import/mesh_file.h"
#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

struct Doubles : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<>;
using Triangles = OpenMesh::TriMesh_ArrayKernelT<Doubles>;
using OpenMesh::IO::Options;

template <typename Mesh>
void add_pyramid(Mesh& mesh) {
  using Point = typename Mesh::Point;
  std::vector<typename Mesh::VertexHandle> v;
  for (const Point& point : {Point(0, 0, 0), Point(2, 0, 0), Point(2, 2, 0),
                             Point(0, 2, 0), Point(1, 1, 3)}) {
    v.push_back(mesh.add_vertex(point));
  }
  mesh.add_face(std::vector{v[3], v[2], v[1], v[0]});
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.add_face(v[i], v[(i + 1) % 4], v[4]);
  }
}

template <typename Mesh>
std::string to_om(const Mesh& mesh, Options options = Options::Default) {
  std::ostringstream stream;
  // The writer prints how much it wrote.
  testing::internal::CaptureStdout();
  const bool is_written =
      OpenMesh::IO::write_mesh(mesh, stream, ".om", options);
  testing::internal::GetCapturedStdout();
  EXPECT_TRUE(is_written);
  return stream.str();
}

// A ring may begin anywhere.
std::vector<std::uint32_t> from_least(std::vector<std::uint32_t> ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()),
              ring.end());
  return ring;
}

std::vector<std::vector<std::uint32_t>> faces_of(const RawMesh& raw) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (const auto& t : raw.mesh.triangles) {
    faces.push_back(from_least({t.begin(), t.end()}));
  }
  for (const auto& polygon : raw.polygons) faces.push_back(from_least(polygon));
  return faces;
}

const std::vector<Vec3> kCorners = {
    {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};

TEST(ParseOm, ReadsPolygonsThatOpenMeshWrote) {
  Polygons mesh;
  add_pyramid(mesh);
  const RawMesh raw = parse_om(to_om(mesh));
  EXPECT_EQ(raw.mesh.vertices, kCorners);
  EXPECT_EQ(faces_of(raw),
            (std::vector<std::vector<std::uint32_t>>{
                {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 3}, {0, 3, 2, 1}}));
}

TEST(ParseOm, ReadsDoublesAndPassesOverOtherProperties) {
  Triangles mesh;
  add_pyramid(mesh);
  mesh.point(mesh.vertex_handle(4))[0] = 0.1;
  mesh.request_vertex_normals();
  mesh.request_face_normals();
  mesh.request_vertex_colors();
  mesh.request_face_colors();
  mesh.request_vertex_texcoords2D();
  mesh.request_edge_status();
  mesh.update_normals();
  const RawMesh raw =
      parse_om(to_om(mesh, Options::VertexNormal | Options::FaceNormal |
                               Options::VertexColor | Options::FaceColor |
                               Options::VertexTexCoord | Options::Status));
  ASSERT_EQ(raw.mesh.vertices.size(), 5U);
  EXPECT_EQ(raw.mesh.vertices[4], Vec3(0.1, 1, 3));
  EXPECT_EQ(raw.mesh.triangles.size(), 6U);
  expect_whole(raw);
}

TEST(ParseOm, ReadsMeshesOfManyVertices) {
  Triangles mesh;  // indices of two bytes
  std::vector<Triangles::VertexHandle> last;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Triangles::VertexHandle> row = {
        mesh.add_vertex({1.0 * i, 0, 0}), mesh.add_vertex({1.0 * i, 1, 0})};
    if (i > 0) {
      mesh.add_face(last[0], row[0], row[1]);
      mesh.add_face(last[0], row[1], last[1]);
    }
    last = row;
  }
  const RawMesh raw = parse_om(to_om(mesh));
  EXPECT_EQ(raw.mesh.vertices.size(), 800U);
  ASSERT_EQ(raw.mesh.triangles.size(), 798U);
  EXPECT_EQ(from_least({raw.mesh.triangles[797].begin(),
                        raw.mesh.triangles[797].end()}),
            (std::vector<std::uint32_t>{796, 799, 797}));
}

TEST(ParseOm, SaysWhatWasExpected) {
  const auto fault = [](const std::string& bytes) {
    return fault_of([&] { parse_om(bytes); });
  };
  Polygons mesh;
  add_pyramid(mesh);
  const std::string good = to_om(mesh);
  EXPECT_EQ(fault("garbage"), "OM file, expected 'OM'");
  EXPECT_EQ(fault("OMT"), "OM file, expected the version");
  EXPECT_EQ(fault("OMT\x21" + std::string(12, '\0')),
            "OM file of version 1.1 instead of 2.x,");
  std::string many = good;
  many.replace(4, 4, "\xff\xff\xff\x7f");
  EXPECT_EQ(fault(many),
            "OM file, expected 25769803638 bytes more than the 126 that there "
            "are");
  // The first half-edge behind itself: its face never closes.
  std::string tangled = good;
  tangled[good.find("\xf8\x16") + 2] = 2;
  tangled[good.find("\xf8\x16") + 2 + 6] = 2;
  EXPECT_EQ(fault(tangled),
            "OM file, expected a ring of half-edges around face 0");
}

TEST(ParseOm, SurvivesWhateverBefallsAFile) {
  Polygons mesh;
  add_pyramid(mesh);
  expect_no_harm(to_om(mesh),
                 [](std::string_view bytes) { expect_whole(parse_om(bytes)); });
}

}  // namespace
}  // namespace lamina::csg
