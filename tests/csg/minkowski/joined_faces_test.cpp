#include "csg/minkowski/joined_faces.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

using Loops = std::vector<std::vector<std::uint32_t>>;

// Two squares side by side, the second with corners of its own.
JoinedFaces two_squares(double gap) {
  return {
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
       Vec3(1 + gap, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(1 + gap, 1, 0)},
      Loops{{0, 1, 2, 3}, {4, 5, 6, 7}},
      std::vector<Vec3>(2, Vec3(0, 0, 1))};
}

TEST(JoinedFaces, ShareAnEdgeWhereCornersDifferByRounding) {
  const JoinedFaces faces = two_squares(3e-8);
  EXPECT_EQ(faces.vertices().size(), 6u);
  ASSERT_EQ(faces.edges().size(), 7u);
  int shared = 0;
  for (std::size_t e = 0; e < faces.edges().size(); ++e) {
    const auto at = faces.faces_at(e);
    if (at.size() != 2) continue;
    ++shared;
    EXPECT_NE(at[0].is_forward, at[1].is_forward);
  }
  EXPECT_EQ(shared, 1);
}

TEST(JoinedFaces, StayApartWhereCornersDifferByMore) {
  EXPECT_EQ(two_squares(1e-6).edges().size(), 8u);
}

TEST(JoinedFaces, KnowTheirSidesAndTheEdgesOfTheirVertices) {
  const JoinedFaces faces = two_squares(0);
  for (std::size_t f = 0; f < faces.face_count(); ++f) {
    const auto corners = faces.corners_of(f);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const JoinedFaces::Side side = faces.sides_of(f)[i];
      const JoinedFaces::Edge edge = faces.edges()[side.edge];
      EXPECT_EQ(side.is_forward ? edge.from : edge.to, corners[i]);
    }
  }
  std::size_t ends = 0;
  for (std::uint32_t v = 0; v < faces.vertices().size(); ++v) {
    for (const std::uint32_t e : faces.edges_at(v)) {
      const JoinedFaces::Edge edge = faces.edges()[e];
      EXPECT_TRUE(edge.from == v || edge.to == v);
      ++ends;
    }
  }
  EXPECT_EQ(ends, 2 * faces.edges().size());
}

TEST(JoinedFaces, LoseAFaceThatIsALine) {
  const JoinedFaces faces({Vec3(0), Vec3(1, 0, 0), Vec3(1, 2e-8, 0)},
                          Loops{{0, 1, 2}}, std::vector<Vec3>{Vec3(0, 0, 1)});
  EXPECT_EQ(faces.face_count(), 0u);
}

// The polygon of a flat body, and a segment, which has no face.
TEST(JoinedFaces, OfFlatBodies) {
  const JoinedFaces square(make_flat(
      {Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, Vec3(0, 0, 1)));
  EXPECT_EQ(square.face_count(), 1u);
  EXPECT_EQ(square.edges().size(), 4u);
  const JoinedFaces segment(make_flat({Vec3(0), Vec3(1, 0, 0)}, Vec3(0, 0, 1)));
  EXPECT_EQ(segment.face_count(), 0u);
  ASSERT_EQ(segment.edges().size(), 1u);
  EXPECT_TRUE(segment.faces_at(0).empty());
}

}  // namespace
}  // namespace lamina::csg
