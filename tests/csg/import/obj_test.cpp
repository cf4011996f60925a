#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "csg/import/mesh_file.h"
#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

const std::string kObjPyramid =
    "# a pyramid\n"
    "mtllib some.mtl\n"
    "o pyramid\n"
    "v 0 0 0\n"
    "v 2 0 0 1.0\n"
    "v 2 2 0\n"
    "vn 0 0 -1\n"
    "v 0 2 0\n"
    "v 1 1 3\n"
    "f 4//1 3//1 2//1 1//1\n"
    "f 1/1 2/1 5/1\n"
    "f -4 -3 \\\n"
    "  -1\n"
    "s off\n"
    "f 3/1/1 4/1/1 5/1/1 # a side\n"
    "f 4 1 5\n";

TEST(ParseObj, ReadsVerticesAndFacesOfAllForms) {
  const RawMesh raw = parse_obj(kObjPyramid);
  EXPECT_EQ(raw.mesh.vertices,
            (std::vector<Vec3>{
                {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}}));
  ASSERT_EQ(raw.polygons.size(), 1U);
  EXPECT_EQ(raw.polygons[0], (std::vector<std::uint32_t>{3, 2, 1, 0}));
  EXPECT_EQ(raw.mesh.triangles,
            (std::vector<std::array<std::uint32_t, 3>>{
                {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
}

TEST(ParseObj, SaysWhatWasExpectedWhere) {
  const auto fault = [](const std::string& text) {
    return fault_of([&] { parse_obj(text); });
  };
  EXPECT_EQ(fault("v 0 0 0\nf 1 2 1\n"),
            "OBJ line 2, expected indices of vertices");
  EXPECT_EQ(fault("v 0 0 0\nf 1 -2 1\n"),
            "OBJ line 2, expected indices of vertices");
  EXPECT_EQ(fault("v 0 0 0\nf 1 0 1\n"),
            "OBJ line 2, expected indices of vertices");
  EXPECT_EQ(fault("\nv 0 0\n"), "OBJ line 2, expected coordinates of a vertex");
}

TEST(ParseObj, SurvivesWhateverBefallsAFile) {
  expect_no_harm(kObjPyramid, [](std::string_view bytes) {
    expect_whole(parse_obj(bytes));
  });
}

}  // namespace
}  // namespace lamina::csg
