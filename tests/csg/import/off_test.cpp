#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "csg/import/mesh_file.h"
#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

const std::string kOffPyramid =
    "# a pyramid\n"
    "OFF\n"
    "5 5 0\n"
    "0 0 0\n"
    "2 0 0  # the second\n"
    "\n"
    "2 2 0\n"
    "0 2 0\n"
    "1 1 3e0\n"
    "4 3 2 1 0\n"
    "3 0 1 4\n"
    "3 1 2 4 255 0 0\n"
    "3 2 3 4\n"
    "3 3 0 4\n";

TEST(ParseOff, ReadsVerticesTrianglesAndPolygons) {
  const RawMesh raw = parse_off(kOffPyramid);
  EXPECT_EQ(raw.mesh.vertices,
            (std::vector<Vec3>{
                {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}}));
  ASSERT_EQ(raw.polygons.size(), 1U);
  EXPECT_EQ(raw.polygons[0], (std::vector<std::uint32_t>{3, 2, 1, 0}));
  ASSERT_EQ(raw.mesh.triangles.size(), 4U);
  EXPECT_EQ(raw.mesh.triangles[1], (std::array<std::uint32_t, 3>{1, 2, 4}));
}

TEST(ParseOff, ReadsAHeaderThatTheNumbersFollowAtOnce) {
  std::string glued = kOffPyramid;
  glued.replace(glued.find("OFF\n"), 4, "OFF");
  EXPECT_EQ(parse_off(glued).mesh, parse_off(kOffPyramid).mesh);
  EXPECT_EQ(parse_off(glued).polygons, parse_off(kOffPyramid).polygons);
}

TEST(ParseOff, ReadsLinesThatEndAsOnOldMacintoshes) {
  std::string returns = kOffPyramid;
  std::ranges::replace(returns, '\n', '\r');
  EXPECT_EQ(parse_off(returns).mesh, parse_off(kOffPyramid).mesh);
}

TEST(ParseOff, PassesOverColoursAndNormals) {
  const std::string rest =
      "3 1 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n";
  for (const std::string header : {"COFF ", "NOFF ", "STCNOFF\n", "CNOFF\n"}) {
    const RawMesh raw = parse_off(header + rest);
    EXPECT_EQ(raw.mesh.vertices,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}))
        << header;
  }
}

TEST(ParseOff, DividesHomogeneousCoordinates) {
  const RawMesh raw = parse_off("4OFF\n1 0 0\n2 4 6 2\n");
  EXPECT_EQ(raw.mesh.vertices, (std::vector<Vec3>{{1, 2, 3}}));
}

TEST(ParseOff, SaysWhatWasExpectedWhere) {
  const auto fault = [](const std::string& text) {
    return fault_of([&] { parse_off(text); });
  };
  EXPECT_EQ(fault("garbage"), "OFF line 1, expected OFF, [ST][C][N][4][n]OFF");
  EXPECT_EQ(fault("OFF BINARY\n"), "OFF line 1, expected text, not BINARY");
  EXPECT_EQ(fault("OFF\n2 1 0\n0 0 0\n1 x 0\n"),
            "OFF line 4, expected coordinates of a vertex");
  EXPECT_EQ(fault("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"),
            "OFF line 4, expected indices of vertices");
  EXPECT_EQ(fault("OFF\n1 1 0\n0 0 0\n3 0 -1 0\n"),
            "OFF line 4, expected indices of vertices");
}

TEST(ParseOff, CountsThatTheFileCannotHoldTakeNoMemory) {
  EXPECT_EQ(
      fault_of([] { parse_off("OFF\n4000000000 4000000000 0\n0 0 0\n"); }),
      "OFF line 4, expected coordinates of a vertex");
  EXPECT_EQ(fault_of([] { parse_off("OFF\n1 1 0\n0 0 0\n4000000000 0 0\n"); }),
            "OFF line 4, expected indices of vertices");
}

TEST(ParseOff, SurvivesWhateverBefallsAFile) {
  expect_no_harm(kOffPyramid, [](std::string_view bytes) {
    expect_whole(parse_off(bytes));
  });
}

}  // namespace
}  // namespace lamina::csg
