#include <algorithm>

#include <gtest/gtest.h>

#include "tests/csg/lower/lower_fixture.h"
#include "tests/support/text.h"

namespace lamina::csg {
namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

const std::vector<Vec3> kBoxPoints{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0},
                                   {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}};
// Clockwise from outside, as OpenSCAD wants it.
const Faces kBoxFaces{{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                      {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};

class PolyhedronTest : public LowerFixture {
 protected:
  double volume(const std::vector<Vec3>& points, const Faces& faces) {
    return run_volume({b.polyhedron(points, faces)});
  }
};

TEST_F(PolyhedronTest, FacesAreClockwiseFromOutside) {
  EXPECT_DOUBLE_EQ(volume(kBoxPoints, kBoxFaces), 24);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST_F(PolyhedronTest, TurnedInsideOutItIsTheSameSolid) {
  Faces faces = kBoxFaces;
  for (auto& face : faces) std::reverse(face.begin(), face.end());
  EXPECT_DOUBLE_EQ(volume(kBoxPoints, faces), 24);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST_F(PolyhedronTest, OverlapsItselfOnlyWhereItIsNotSeenWholeFromItsMiddle) {
  const auto may_overlap = [this](std::vector<Vec3> points,
                                  const Faces& faces) {
    return run_solid({b.polyhedron(std::move(points), faces)})
        .leaves[0]
        .may_overlap_itself;
  };
  EXPECT_FALSE(may_overlap(kBoxPoints, kBoxFaces));
  // A dent in the lid, seen from the middle all the same.
  std::vector<Vec3> points = kBoxPoints;
  points.push_back({1, 1.5, 3});
  Faces faces = kBoxFaces;
  faces[1] = {4, 7, 8};
  faces.insert(faces.end(), {{7, 6, 8}, {6, 5, 8}, {5, 4, 8}});
  EXPECT_FALSE(may_overlap(points, faces));
  // As deep as to come out below, the box is inside out there.
  points.back().z = -1;
  EXPECT_TRUE(may_overlap(points, faces));
  // A box in a box: seen whole, yet twice.
  points = kBoxPoints;
  faces = kBoxFaces;
  for (const Vec3& point : kBoxPoints) {
    points.push_back(0.5 * (point + Vec3(1, 1.5, 2)));
  }
  for (std::vector<std::uint32_t> face : kBoxFaces) {
    for (std::uint32_t& corner : face) corner += 8;
    faces.push_back(face);
  }
  EXPECT_TRUE(may_overlap(points, faces));
}

TEST_F(PolyhedronTest, ATurnedFaceIsTurnedBack) {
  Faces faces = kBoxFaces;
  std::reverse(faces[2].begin(), faces[2].end());
  EXPECT_DOUBLE_EQ(volume(kBoxPoints, faces), 24);
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "The given mesh has faces of both orientations: "
                            "turned 2 of 12 triangles"}));
}

TEST_F(PolyhedronTest, AMissingFaceIsClosed) {
  Faces faces = kBoxFaces;
  faces.erase(faces.begin() + 1);
  EXPECT_DOUBLE_EQ(volume(kBoxPoints, faces), 24);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].severity, Severity::kWarning);
  EXPECT_EQ(diagnostics.all()[0].message, "The given mesh is not closed!");
  EXPECT_EQ(diagnostics.all()[0].notes.at(0).message,
            "closed a hole of 4 edges around [1, 1.5, 4], 2 x 3 x 0 mm");
}

TEST_F(PolyhedronTest, AFaceGivenTwiceCountsOnce) {
  Faces faces = kBoxFaces;
  faces.push_back(faces[3]);
  EXPECT_DOUBLE_EQ(volume(kBoxPoints, faces), 24);
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "The given mesh has faces more than once: dropped "
                            "2 of 14 triangles"}));
}

// Its surface winds round it twice, which is as much inside as once.
TEST_F(PolyhedronTest, AClosedBoxKeepsAllItsFaces) {
  Faces faces = kBoxFaces;
  faces.insert(faces.end(), kBoxFaces.begin(), kBoxFaces.end());
  EXPECT_DOUBLE_EQ(volume(kBoxPoints, faces), 48);
  EXPECT_TRUE(diagnostics.all().empty());
}

// Each edge has two sides here, but not one in each direction.
TEST_F(PolyhedronTest, AnyFaceTurnedIsFound) {
  for (std::size_t i = 0; i < kBoxFaces.size(); ++i) {
    Faces faces = kBoxFaces;
    std::reverse(faces[i].begin(), faces[i].end());
    EXPECT_DOUBLE_EQ(volume(kBoxPoints, faces), 24);
    EXPECT_EQ(diagnostics.all().size(), i + 1);
  }
}

TEST_F(PolyhedronTest, EveryFaceMayHaveItsOwnPoints) {
  std::vector<Vec3> points;
  Faces faces;
  for (const auto& face : kBoxFaces) {
    faces.emplace_back();
    for (const std::uint32_t i : face) {
      faces.back().push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(kBoxPoints[i]);
    }
  }
  EXPECT_DOUBLE_EQ(volume(points, faces), 24);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST_F(PolyhedronTest, PointsThatDifferByRoundingAreOne) {
  std::vector<Vec3> points;
  Faces faces;
  for (const auto& face : kBoxFaces) {
    faces.emplace_back();
    for (const std::uint32_t i : face) {
      faces.back().push_back(static_cast<std::uint32_t>(points.size()));
      const double noise = 1e-13 * static_cast<double>(points.size() % 5);
      points.push_back(kBoxPoints[i] + Vec3(noise, -noise, noise));
    }
  }
  EXPECT_NEAR(volume(points, faces), 24, 1e-10);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST_F(PolyhedronTest, FacesThatAreALittleApartAreJoined) {
  for (const double gap : {1e-6, 1e-5, 1e-4}) {
    std::vector<Vec3> points;
    Faces faces;
    for (const auto& face : kBoxFaces) {
      faces.emplace_back();
      const Vec3 shift =
          gap * static_cast<double>(faces.size()) * Vec3(0.5, 1, -0.5);
      for (const std::uint32_t i : face) {
        faces.back().push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back(kBoxPoints[i] + shift);
      }
    }
    EXPECT_NEAR(volume(points, faces), 24, 500 * gap);
    ASSERT_FALSE(diagnostics.all().empty());
    EXPECT_TRUE(support::has(diagnostics.all().back().message,
                             "not welded: joined 24 open edges"))
        << diagnostics.all().back().message;
  }
}

TEST_F(PolyhedronTest, ConcaveFacesAreNotFilled) {
  // An L-shaped prism.
  const std::vector<Vec2> outline{{0, 0}, {3, 0}, {3, 1},
                                  {1, 1}, {1, 3}, {0, 3}};
  std::vector<Vec3> points;
  Faces faces{{}, {}};
  const std::uint32_t n = 6;
  for (const double z : {0.0, 2.0}) {
    for (const Vec2 p : outline) points.push_back({p, z});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    faces[0].push_back(i);
    faces[1].push_back(2 * n - 1 - i);
    faces.push_back({i, n + i, n + (i + 1) % n, (i + 1) % n});
  }
  EXPECT_DOUBLE_EQ(volume(points, faces), 10);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST_F(PolyhedronTest, UnusedPointsDoNotCount) {
  std::vector<Vec3> points = kBoxPoints;
  points.push_back({100, 100, 100});
  const Scene scene = run_solid({b.polyhedron(points, kBoxFaces)});
  EXPECT_EQ(scene.box.high, Vec3(2, 3, 4));
}

TEST_F(PolyhedronTest, BadIndicesAndFacesAreReported) {
  Faces faces = kBoxFaces;
  faces[5].push_back(77);
  faces.push_back({1, 2});
  EXPECT_DOUBLE_EQ(volume(kBoxPoints, faces), 24);
  EXPECT_EQ(messages(),
            (std::vector<std::string>{"Point index 77 is out of bounds (from "
                                      "faces[5][4])",
                                      "PolySet has degenerate polygons"}));
  ASSERT_EQ(diagnostics.all()[1].notes.size(), 1U);
  EXPECT_EQ(diagnostics.all()[1].notes[0].message,
            "faces[6] names fewer than 3 points: expected a list such as "
            "[0, 1, 2]");
}

TEST_F(PolyhedronTest, TwoBoxesOnOneEdgeAreClosed) {
  std::vector<Vec3> points = kBoxPoints;
  Faces faces = kBoxFaces;
  for (const Vec3& p : kBoxPoints) points.push_back(p + Vec3(2, 3, 0));
  for (auto face : kBoxFaces) {
    for (std::uint32_t& i : face) i += 8;
    faces.push_back(face);
  }
  EXPECT_DOUBLE_EQ(volume(points, faces), 48);
  EXPECT_TRUE(diagnostics.all().empty());
}

}  // namespace
}  // namespace lamina::csg
