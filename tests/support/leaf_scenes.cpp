#include "tests/support/leaf_scenes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace lamina::support {
namespace {

using plane::BooleanOp;

// Triangles of a polygon given by consecutive vertex indices, as a fan.
void add_fan(csg::Mesh& mesh, const std::vector<std::uint32_t>& polygon) {
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
}

// Sides between rings of `sides` vertices each, ring after ring; the last ring
// joins the first where `is_closed`, else both end in a cap.
void join_rings(csg::Mesh& mesh, std::uint32_t sides, bool is_closed) {
  const auto rings = static_cast<std::uint32_t>(mesh.vertices.size()) / sides;
  for (std::uint32_t ring = 0; ring + (is_closed ? 0 : 1) < rings; ++ring) {
    const std::uint32_t low = ring * sides;
    const std::uint32_t high = (ring + 1) % rings * sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      add_fan(mesh, {low + i, low + j, high + j, high + i});
    }
  }
  if (is_closed) return;
  std::vector<std::uint32_t> bottom;
  std::vector<std::uint32_t> top;
  for (std::uint32_t i = 0; i < sides; ++i) {
    bottom.push_back(sides - 1 - i);
    top.push_back((rings - 1) * sides + i);
  }
  add_fan(mesh, bottom);
  add_fan(mesh, top);
}

void add_ring(csg::Mesh& mesh, int sides, double r, double z) {
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
}

}  // namespace

csg::Mesh box_mesh(const Vec3& low, const Vec3& high) {
  csg::Mesh mesh;
  for (const double z : {low.z, high.z}) {
    mesh.vertices.emplace_back(low.x, low.y, z);
    mesh.vertices.emplace_back(high.x, low.y, z);
    mesh.vertices.emplace_back(high.x, high.y, z);
    mesh.vertices.emplace_back(low.x, high.y, z);
  }
  join_rings(mesh, 4, false);
  return mesh;
}

csg::Mesh prism_mesh(int sides, double r, double low, double high) {
  csg::Mesh mesh;
  add_ring(mesh, sides, r, low);
  add_ring(mesh, sides, r, high);
  join_rings(mesh, static_cast<std::uint32_t>(sides), false);
  return mesh;
}

csg::Mesh sphere_mesh(int sides, double r) {
  csg::Mesh mesh;
  const int rings = (sides + 1) / 2;
  for (int i = 0; i < rings; ++i) {
    const double polar = std::numbers::pi * (i + 0.5) / rings;
    add_ring(mesh, sides, r * std::sin(polar), -r * std::cos(polar));
  }
  join_rings(mesh, static_cast<std::uint32_t>(sides), false);
  return mesh;
}

csg::Mesh torus_mesh(int sides, double ring_radius, double tube_radius) {
  csg::Mesh mesh;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    add_ring(mesh, sides, ring_radius + tube_radius * std::cos(angle),
             tube_radius * std::sin(angle));
  }
  join_rings(mesh, static_cast<std::uint32_t>(sides), true);
  return mesh;
}

csg::Leaf mesh_leaf(csg::Mesh mesh, bool may_overlap_itself) {
  csg::Leaf leaf;
  for (const Vec3& vertex : mesh.vertices) {
    leaf.box.low = glm::min(leaf.box.low, vertex);
    leaf.box.high = glm::max(leaf.box.high, vertex);
  }
  leaf.meshes.push_back(std::move(mesh));
  leaf.may_overlap_itself = may_overlap_itself;
  return leaf;
}

Affine shift_by(const Vec3& by) {
  Affine result(1.0);
  result[3] = by;
  return result;
}

Affine turn_about(const Vec3& axis, double angle) {
  const Vec3 u = glm::normalize(axis);
  Affine result(1.0);
  for (int column = 0; column < 3; ++column) {
    Vec3 unit(0);
    unit[column] = 1;
    // The formula of Rodrigues.
    result[column] = unit * std::cos(angle) +
                     glm::cross(u, unit) * std::sin(angle) +
                     u * (glm::dot(u, unit) * (1 - std::cos(angle)));
  }
  return result;
}

Affine scale_by(const Vec3& factors) {
  Affine result(1.0);
  for (int i = 0; i < 3; ++i) result[i][i] = factors[i];
  return result;
}

Affine compose(const Affine& outer, const Affine& inner) {
  Affine result;
  for (int i = 0; i < 4; ++i) {
    result[i] = outer * Vec4(inner[i], i == 3 ? 1 : 0);
  }
  return result;
}

std::uint32_t place_leaf(csg::Scene& scene, std::uint32_t leaf,
                         const Affine& world_from_leaf, std::uint32_t parent) {
  csg::Instance instance;
  instance.leaf = leaf;
  instance.parent = parent;
  instance.is_minuend = scene.program[parent].op == BooleanOp::kDifference &&
                        scene.program[parent].child_count == 0;
  instance.world_from_leaf = world_from_leaf;
  for (const csg::Mesh& mesh : scene.leaves[leaf].meshes) {
    for (const Vec3& vertex : mesh.vertices) {
      const Vec3 placed = world_from_leaf * Vec4(vertex, 1);
      instance.box.low = glm::min(instance.box.low, placed);
      instance.box.high = glm::max(instance.box.high, placed);
    }
  }
  ++scene.program[parent].child_count;
  scene.instances.push_back(instance);
  return static_cast<std::uint32_t>(scene.instances.size() - 1);
}

std::uint32_t add_operator(csg::Scene& scene, BooleanOp op,
                           std::uint32_t parent) {
  plane::BooleanNode node;
  node.op = op;
  node.parent = parent;
  node.is_minuend = scene.program[parent].op == BooleanOp::kDifference &&
                    scene.program[parent].child_count == 0;
  ++scene.program[parent].child_count;
  scene.program.push_back(node);
  return static_cast<std::uint32_t>(scene.program.size() - 1);
}

csg::Scene scene_of(BooleanOp op) {
  csg::Scene scene;
  scene.program.push_back({op, 0, false, 0});
  return scene;
}

void cover_instances(csg::Scene& scene) {
  scene.box = {};
  for (const csg::Instance& instance : scene.instances) {
    scene.box.low = glm::min(scene.box.low, instance.box.low);
    scene.box.high = glm::max(scene.box.high, instance.box.high);
  }
}

bool evaluate_program(const csg::Scene& scene,
                      const std::vector<bool>& inside) {
  struct Operands {
    int holding = 0;
    int count = 0;
    bool minuend = false;
    bool subtrahend = false;
  };
  std::vector<Operands> operands(scene.program.size());
  const auto add = [&](std::uint32_t parent, bool is_minuend, bool value) {
    Operands& of = operands[parent];
    ++of.count;
    if (!value) return;
    ++of.holding;
    (is_minuend ? of.minuend : of.subtrahend) = true;
  };
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    add(scene.instances[i].parent, scene.instances[i].is_minuend, inside[i]);
  }
  // Parents stand before their children, so backwards every operator is
  // complete when it is reached.
  for (std::size_t i = scene.program.size();;) {
    const plane::BooleanNode& node = scene.program[--i];
    const Operands& of = operands[i];
    bool value = of.holding > 0;
    if (node.op == BooleanOp::kIntersection) {
      value = of.count > 0 && of.holding == of.count;
    } else if (node.op == BooleanOp::kDifference) {
      value = of.minuend && !of.subtrahend;
    }
    if (i == 0) return value;
    add(node.parent, node.is_minuend, value);
  }
}

Affine random_turn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vec3 axis(normal(random), normal(random), normal(random));
  return turn_about(axis, std::uniform_real_distribution<double>(
                              0, 2 * std::numbers::pi)(random));
}

}  // namespace lamina::support
