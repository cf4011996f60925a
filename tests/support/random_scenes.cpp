#include "tests/support/random_scenes.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include "csg/boundary/leaf_mesh.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::support {
namespace {

using Outline = std::vector<Vec2>;

Box3 box_of(const csg::Leaf& leaf, const Affine& placement) {
  Box3 box;
  for (const Vec3& vertex : csg::explicit_mesh(leaf).vertices) {
    const Vec3 placed = placement * Vec4(vertex, 1);
    box.low = glm::min(box.low, placed);
    box.high = glm::max(box.high, placed);
  }
  return box;
}

class SceneMaker {
 public:
  SceneMaker(std::uint64_t seed, SceneStyle style)
      : random_(seed), style_(style) {}

  csg::Scene make(int leaf_count) {
    add_leaves();
    scene_.program.push_back({any_operator(), 0, false, 0});
    for (std::size_t operators = below(6); operators > 0; --operators) {
      add_operator(scene_, any_operator(), any_of(scene_.program.size()));
    }
    // Every operator has a child, the others go anywhere.
    for (std::uint32_t i = 0; i < scene_.program.size(); ++i) {
      if (scene_.program[i].child_count == 0) add_instance(i);
    }
    while (scene_.instances.size() < static_cast<std::size_t>(leaf_count)) {
      add_instance(any_of(scene_.program.size()));
    }
    cover_instances(scene_);
    return std::move(scene_);
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  std::uint32_t any_of(std::size_t count) {
    return static_cast<std::uint32_t>(below(count));
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  // Unions twice as often: random intersections are mostly empty.
  plane::BooleanOp any_operator() {
    const std::size_t choice = below(5);
    if (choice < 3) return plane::BooleanOp::kUnion;
    return choice == 3 ? plane::BooleanOp::kDifference
                       : plane::BooleanOp::kIntersection;
  }

  static Outline circle(int sides) {
    Outline points;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      points.emplace_back(std::cos(angle), std::sin(angle));
    }
    return points;
  }

  static csg::Loft make_loft(Outline outline, std::vector<Vec2> profile,
                             bool is_closed_profile = false) {
    return {std::make_shared<const Outline>(std::move(outline)),
            std::move(profile), is_closed_profile};
  }
  void add_loft(Outline outline, std::vector<Vec2> profile,
                bool is_closed_profile = false) {
    csg::Leaf leaf;
    leaf.lofts = {
        make_loft(std::move(outline), std::move(profile), is_closed_profile)};
    add_leaf(std::move(leaf));
  }
  void add_leaf(csg::Leaf leaf) {
    for (const Vec3& vertex : csg::explicit_mesh(leaf).vertices) {
      leaf.box.low = glm::min(leaf.box.low, vertex);
      leaf.box.high = glm::max(leaf.box.high, vertex);
    }
    scene_.leaves.push_back(std::move(leaf));
  }

  // An extruded frame: its hole is a cavity, whose caps lie in those of the
  // outside.
  csg::Leaf frame_leaf() {
    csg::Leaf leaf;
    leaf.lofts = {
        make_loft({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{1, 0}, {1, 1}}),
        make_loft({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}},
                  {{1, 0}, {1, 1}})};
    leaf.lofts[1].is_cavity = true;
    return leaf;
  }
  // Boxes in one mesh: two overlap, a third one, inside out, takes a bite.
  csg::Leaf overlapping_leaf() {
    csg::Mesh mesh;
    const auto add = [&](const Vec3& low, const Vec3& high, bool inside_out) {
      const csg::Mesh box = box_mesh(low, high);
      const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), box.vertices.begin(),
                           box.vertices.end());
      for (auto [a, b, c] : box.triangles) {
        if (inside_out) std::swap(b, c);
        mesh.triangles.push_back({a + shift, b + shift, c + shift});
      }
    };
    add(Vec3(0, 0, 0), Vec3(2, 1, 1), false);
    add(Vec3(1, 0, 0), Vec3(3, 2, 1), false);
    add(Vec3(0.5, 0.5, -0.5), Vec3(1.5, 1.5, 0.5), true);
    return mesh_leaf(std::move(mesh), true);
  }

  // The first kAlignedLeaves ones have faces that grids make coincide.
  static constexpr std::size_t kAlignedLeaves = 7;
  void add_leaves() {
    const Outline square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const Outline bracket = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    add_loft(square, {{1, 0}, {1, 1}});
    scene_.leaves.push_back(mesh_leaf(box_mesh(Vec3(0), Vec3(1))));
    add_loft(bracket, {{1, 0}, {1, 1}});
    add_loft(square, {{1, 0}, {0.5, 1}});
    scene_.leaves.push_back(mesh_leaf(prism_mesh(8, 1, 0, 1)));
    add_leaf(frame_leaf());
    scene_.leaves.push_back(overlapping_leaf());

    add_loft(circle(7), {{1, 0}, {0.3, 1}});
    add_loft(circle(16), {{0, -1}, {1, 0}, {0, 1}});
    add_loft(circle(12), {{1.4, -0.4}, {1.8, 0}, {1.4, 0.4}, {1, 0}}, true);
    scene_.leaves.push_back(mesh_leaf(sphere_mesh(10, 1)));
    scene_.leaves.push_back(mesh_leaf(torus_mesh(9, 1.5, 0.4)));
  }

  Affine quarter_turn() {
    const auto quarters = static_cast<double>(below(4));
    Vec3 axis(0);
    axis[static_cast<int>(below(3))] = 1;
    Affine turn = turn_about(axis, quarters * std::numbers::pi / 2);
    // Exact, but for kNoisy.
    for (int i = 0; i < 3; ++i) turn[i] = glm::round(turn[i]);
    return turn;
  }
  double grid_step() { return 0.5 * static_cast<double>(below(9)) - 2; }
  Affine aligned_placement() {
    const auto size = [&] { return 0.5 * static_cast<double>(1 + below(5)); };
    Affine placement = scale_by({size(), size(), size()});
    if (below(4) == 0) placement = compose(scale_by({-1, 1, 1}), placement);
    placement = compose(quarter_turn(), placement);
    return compose(shift_by({grid_step(), grid_step(), grid_step()}),
                   placement);
  }
  Affine generic_placement() {
    Affine placement =
        scale_by({between(0.2, 2.5), between(0.2, 2.5), between(0.2, 2.5)});
    if (below(4) == 0) placement = compose(scale_by({1, -1, 1}), placement);
    if (below(4) == 0) placement[1].x += between(-1, 1);
    const Vec3 axis(between(-1, 1), between(-1, 1), between(0.1, 1));
    placement =
        compose(turn_about(axis, between(0, 2 * std::numbers::pi)), placement);
    return compose(shift_by({between(-2, 2), between(-2, 2), between(-2, 2)}),
                   placement);
  }
  Affine noisy(const Affine& placement) {
    const Vec3 axis(between(-1, 1), between(-1, 1), between(0.1, 1));
    const double angle = between(0, 3);
    return compose(turn_about(axis, -angle),
                   compose(turn_about(axis, angle), placement));
  }
  Affine skewed(const Affine& placement) {
    const double angle = std::pow(10, between(-8, -3));
    const Vec3 axis(between(-1, 1), between(-1, 1), between(-1, 1));
    return compose(turn_about(axis, angle), placement);
  }

  void add_instance(std::uint32_t parent) {
    SceneStyle style = style_;
    if (style == SceneStyle::kMixed) {
      style = static_cast<SceneStyle>(below(kSceneStyleCount - 1));
    }
    const bool is_generic =
        style == SceneStyle::kGeneric || style == SceneStyle::kDuplicate;
    std::uint32_t leaf =
        any_of(is_generic ? scene_.leaves.size() : kAlignedLeaves);
    Affine placement = is_generic ? generic_placement() : aligned_placement();
    if (style == SceneStyle::kNoisy) placement = noisy(placement);
    if (style == SceneStyle::kSkewed) placement = skewed(placement);
    if (style == SceneStyle::kDuplicate && !scene_.instances.empty() &&
        below(2) == 0) {
      const csg::Instance& model =
          scene_.instances[below(scene_.instances.size())];
      leaf = model.leaf;
      placement = model.world_from_leaf;
      // As it is, with rounding noise, or moved by well under a tie.
      const std::size_t kind = below(3);
      if (kind == 1) placement = noisy(placement);
      if (kind == 2) {
        placement[3] +=
            Vec3(between(-1, 1), between(-1, 1), between(-1, 1)) * 1e-9;
      }
    }
    place(leaf, placement, parent);
  }

  // place_leaf knows the vertices of meshes only.
  void place(std::uint32_t leaf, const Affine& placement,
             std::uint32_t parent) {
    const std::uint32_t index = place_leaf(scene_, leaf, placement, parent);
    scene_.instances[index].box = box_of(scene_.leaves[leaf], placement);
  }

  std::mt19937_64 random_;
  SceneStyle style_;
  csg::Scene scene_;
};

}  // namespace

csg::Scene random_scene(std::uint64_t seed, SceneStyle style, int leaf_count) {
  return SceneMaker(seed, style).make(leaf_count);
}

csg::Scene placed_scene(csg::Scene scene, const Affine& placement) {
  for (csg::Instance& instance : scene.instances) {
    instance.world_from_leaf = compose(placement, instance.world_from_leaf);
    instance.box =
        box_of(scene.leaves[instance.leaf], instance.world_from_leaf);
  }
  cover_instances(scene);
  return scene;
}

}  // namespace lamina::support
