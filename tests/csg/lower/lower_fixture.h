#pragma once
// Lowering in tests: a tree by hand in, a scene out, diagnostics kept.

#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "csg/lower/lower.h"
#include "tests/csg/lower/mesh_checks.h"
#include "tests/csg/lower/tree_builder.h"

namespace lamina::csg {

// How far sizes, areas and volumes of solids of a few millimetres may be off.
inline constexpr double kRounding = 1e-6;

// The same after Booleans of regions, which take edges within 3e-8 mm for one.
inline constexpr double kBooleanRounding = 1e-5;

class LowerFixture : public ::testing::Test {
 protected:
  Lowered run(const TreeBuilder::Children& children) {
    Tree tree = b.tree(children);
    tree.language = language;
    return lower(tree, {}, diagnostics);
  }

  Scene run_solid(const TreeBuilder::Children& children) {
    Lowered lowered = run(children);
    EXPECT_NE(lowered.scene(), nullptr);
    if (!lowered.scene()) return {};
    Scene scene = std::move(std::get<Scene>(lowered.geometry));
    return scene;
  }

  plane::Region run_flat(const TreeBuilder::Children& children) {
    const Lowered lowered = run(children);
    EXPECT_NE(lowered.outline(), nullptr);
    return lowered.outline() ? *lowered.outline() : plane::Region{};
  }

  // Of the only instance, in the world; its mesh is closed.
  double run_volume(const TreeBuilder::Children& children) {
    const Scene scene = run_solid(children);
    EXPECT_EQ(scene.instances.size(), 1u);
    if (scene.instances.empty()) return 0;
    const Instance& instance = scene.instances[0];
    const Mesh mesh = explicit_mesh(scene.leaves[instance.leaf]);
    EXPECT_TRUE(is_closed(mesh));
    const Affine& m = instance.world_from_leaf;
    return signed_volume(mesh) * glm::dot(m[0], glm::cross(m[1], m[2]));
  }

  std::vector<std::string> messages() const {
    std::vector<std::string> result;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      result.push_back(diagnostic.message);
    }
    return result;
  }

  Language language = Language::k2021;
  TreeBuilder b;
  Diagnostics diagnostics;
};

}  // namespace lamina::csg
