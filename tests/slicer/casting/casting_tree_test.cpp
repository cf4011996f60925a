// Pieces on a trunk: distances are kept, whatever the pieces are.

#include "slicer/casting/casting_tree.h"

#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace lamina::slicer {
namespace {

// A block whose root is below it, as points of a lattice on its surface.
TreePiece block(Vec3 size, double step) {
  TreePiece piece;
  piece.cover = step * std::sqrt(0.5);
  const auto count = [&](double length) {
    return static_cast<int>(std::ceil(length / step));
  };
  const int nx = count(size.x);
  const int ny = count(size.y);
  const int nz = count(size.z);
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      for (int k = 0; k <= nz; ++k) {
        if (i % nx != 0 && j % ny != 0 && k % nz != 0) continue;
        piece.points.push_back(
            size * (Vec3(i, j, k) / Vec3(nx, ny, nz) - Vec3(0.5, 0.5, 0)));
      }
    }
  }
  for (double z = -6; z < 0; z += step) piece.sprue.emplace_back(0, 0, z);
  piece.root = Vec3(0, 0, -6);
  piece.root_diameter = 2;
  piece.volume = size.x * size.y * size.z;
  return piece;
}

std::vector<Vec3> placed(const TreePiece& piece, const Affine& at) {
  std::vector<Vec3> points;
  for (const Vec3 point : piece.points) points.push_back(at * Vec4(point, 1));
  return points;
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 p : a) {
    for (const Vec3 q : b) least = std::min(least, glm::distance(p, q));
  }
  return least;
}

TEST(PlantTree, KeepsDistances) {
  const std::vector<TreePiece> pieces = {
      block({8, 3, 10}, 1), block({12, 6, 5}, 1), block({4, 4, 4}, 1)};
  const TreeSizes sizes = {.flask_diameter = 75, .flask_height = 110};
  std::vector<std::size_t> wanted = {0, 1, 2, 2, 0, 1, 0, 2, 1, 0};
  const CastingTree tree = plant_tree(pieces, wanted, sizes);
  EXPECT_TRUE(wanted.empty());
  ASSERT_EQ(tree.placements.size(), 10U);
  std::vector<std::vector<Vec3>> all;
  for (const TreePlacement& placement : tree.placements) {
    const TreePiece& piece = pieces[placement.piece];
    all.push_back(placed(piece, placement.tree_from_piece));
    for (const Vec3 point : all.back()) {
      const double out = std::hypot(point.x, point.y);
      EXPECT_LE(out, sizes.flask_diameter / 2 - sizes.wall);
      EXPECT_GE(out, sizes.trunk / 2 + sizes.gap);
      EXPECT_GE(point.z, sizes.foot);
      EXPECT_LE(point.z, sizes.flask_height - sizes.top);
    }
    // The stem goes on as the sprue does, and the piece leans upwards.
    const Vec3 root = placement.tree_from_piece * Vec4(piece.root, 1);
    const Vec3 up = placement.tree_from_piece * Vec4(-piece.direction, 0);
    EXPECT_EQ(Vec2(placement.stem), Vec2(0));
    EXPECT_LE(placement.stem.z, tree.trunk_height);
    EXPECT_NEAR(glm::dot(root - placement.stem, up),
                glm::distance(root, placement.stem), 1e-9);
    EXPECT_NEAR(glm::length(up), 1, 1e-12);
    EXPECT_GE(up.z, std::sqrt(0.5) - 1e-9);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(distance(all[i], all[j]), sizes.gap);
    }
  }
}

TEST(PlantTree, PutsHeavyPiecesLow) {
  const std::vector<TreePiece> pieces = {block({4, 4, 4}, 1),
                                         block({9, 9, 9}, 1)};
  std::vector<std::size_t> wanted = {0, 0, 0, 0, 1, 1, 1};
  const CastingTree tree = plant_tree(pieces, wanted, {.flask_height = 150});
  ASSERT_EQ(tree.placements.size(), 7U);
  double highest_heavy = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(tree.placements[i].piece, 1U);
    highest_heavy =
        std::max(highest_heavy, tree.placements[i].tree_from_piece[3].z);
  }
  EXPECT_LT(highest_heavy, 60);
}

TEST(PlantTree, LeavesWhatDoesNotFit) {
  const std::vector<TreePiece> pieces = {block({4, 4, 4}, 1),
                                         block({40, 40, 40}, 2)};
  std::vector<std::size_t> wanted = {1, 0, 1};
  const CastingTree tree = plant_tree(pieces, wanted, {});
  EXPECT_EQ(tree.placements.size(), 1U);
  EXPECT_EQ(wanted, (std::vector<std::size_t>{1, 1}));
}

TEST(PlantTree, IsTheSameEveryTime) {
  const std::vector<TreePiece> pieces = {block({8, 3, 10}, 1)};
  std::vector<std::size_t> first(12, 0);
  std::vector<std::size_t> second(12, 0);
  const CastingTree a = plant_tree(pieces, first, {});
  const CastingTree b = plant_tree(pieces, second, {});
  ASSERT_EQ(a.placements.size(), b.placements.size());
  for (std::size_t i = 0; i < a.placements.size(); ++i) {
    EXPECT_EQ(a.placements[i].tree_from_piece, b.placements[i].tree_from_piece);
  }
}

}  // namespace
}  // namespace lamina::slicer
