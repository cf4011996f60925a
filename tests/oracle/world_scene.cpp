#include "tests/oracle/world_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "csg/boundary/leaf_mesh.h"

namespace lamina::oracle {
namespace {

// Distance from `value` to the nearest of `sorted`.
double distance_to_nearest(const std::vector<double>& sorted, double value) {
  const auto above = std::lower_bound(sorted.begin(), sorted.end(), value);
  double distance = INFINITY;
  if (above != sorted.end()) distance = *above - value;
  if (above != sorted.begin()) {
    distance = std::min(distance, value - *std::prev(above));
  }
  return distance;
}

}  // namespace

WorldScene world_scene(const csg::Scene& scene) {
  std::vector<csg::Mesh> leaves;
  leaves.reserve(scene.leaves.size());
  for (const csg::Leaf& leaf : scene.leaves) {
    leaves.push_back(csg::explicit_mesh(leaf));
  }
  WorldScene world;
  world.program = scene.program;
  for (const csg::Instance& instance : scene.instances) {
    csg::Mesh mesh = leaves[instance.leaf];
    for (Vec3& vertex : mesh.vertices) {
      vertex = instance.world_from_leaf * Vec4(vertex, 1);
    }
    world.meshes.push_back(std::move(mesh));
    world.parent.push_back(instance.parent);
    world.is_minuend.push_back(instance.is_minuend);
  }
  return world;
}

bool evaluate_program(const WorldScene& scene, std::span<const int> winding) {
  // What each node has heard from its children.
  struct Heard {
    std::uint32_t true_children = 0;
    bool is_minuend_true = false;
  };
  std::vector<Heard> heard(scene.program.size());
  const auto tell = [&](std::uint32_t node, bool is_minuend) {
    ++heard[node].true_children;
    if (is_minuend) heard[node].is_minuend_true = true;
  };
  for (std::size_t i = 0; i < scene.parent.size(); ++i) {
    if (winding[i] != 0) tell(scene.parent[i], scene.is_minuend[i]);
  }

  // Children stand behind their parents.
  bool value = false;
  for (std::size_t n = scene.program.size(); n-- > 0;) {
    const plane::BooleanNode& node = scene.program[n];
    switch (node.op) {
      case plane::BooleanOp::kUnion:
        value = heard[n].true_children > 0;
        break;
      case plane::BooleanOp::kIntersection:
        value =
            node.child_count > 0 && heard[n].true_children == node.child_count;
        break;
      case plane::BooleanOp::kDifference:
        value = heard[n].is_minuend_true && heard[n].true_children == 1;
        break;
    }
    if (n > 0 && value) tell(node.parent, node.is_minuend);
  }
  return value;
}

std::vector<double> generic_heights(const WorldScene& scene, double low,
                                    double high, std::size_t count) {
  std::vector<double> levels;
  for (const csg::Mesh& mesh : scene.meshes) {
    for (const Vec3& vertex : mesh.vertices) levels.push_back(vertex.z);
  }
  std::sort(levels.begin(), levels.end());

  // One height in each of `count` equal bands, at the first of some scattered
  // places that is far from every vertex, else at the farthest.
  constexpr double kGoldenShare = 0.6180339887498949;
  constexpr double kFar = 1e-4;  // of a band
  constexpr int kPlaces = 100;
  const double band = (high - low) / static_cast<double>(count);
  std::vector<double> heights;
  double share = 0.5;
  for (std::size_t i = 0; i < count; ++i) {
    double best = 0;
    double best_distance = -1;
    for (int k = 0; k < kPlaces && best_distance < kFar * band; ++k) {
      share = std::fmod(share + kGoldenShare, 1.0);
      const double z = low + band * (static_cast<double>(i) + share);
      const double distance = distance_to_nearest(levels, z);
      if (distance > best_distance) {
        best = z;
        best_distance = distance;
      }
    }
    heights.push_back(best);
  }
  return heights;
}

}  // namespace lamina::oracle
