#include "tests/ldni/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "plane/predicates.h"

namespace lamina::testing {
namespace {

constexpr double kPi = std::numbers::pi;

csg::Loft make_loft(std::vector<Vec2> outline, std::vector<Vec2> profile,
                    bool is_closed) {
  csg::Loft loft;
  loft.outline = std::make_shared<const std::vector<Vec2>>(std::move(outline));
  loft.profile = std::move(profile);
  loft.is_closed_profile = is_closed;
  return loft;
}

csg::Leaf leaf_of(csg::Loft loft) {
  csg::Leaf leaf;
  leaf.lofts.push_back(std::move(loft));
  return leaf;
}

void extend(Box3& box, const Vec3& point) {
  box.low = glm::min(box.low, point);
  box.high = glm::max(box.high, point);
}

// All vertices of a leaf in leaf coordinates.
std::vector<Vec3> vertices_of(const csg::Leaf& leaf) {
  std::vector<Vec3> vertices;
  for (const csg::Loft& loft : leaf.lofts) {
    for (const Vec2& ring : loft.profile) {
      for (const Vec2& corner : *loft.outline) {
        vertices.push_back({ring.x * corner.x, ring.x * corner.y, ring.y});
      }
    }
  }
  for (const csg::Mesh& mesh : leaf.meshes) {
    vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  return vertices;
}

double signed_area_of(const std::vector<Vec2>& polygon) {
  double doubled = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    doubled += cross(a, b);
  }
  return doubled / 2;
}

// Whether `p` lies in the counter-clockwise triangle or on its boundary.
bool in_triangle(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto side = [&p](const Vec2& from, const Vec2& to) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  return side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0;
}

// Triangles of a simple polygon by cutting ears; index triples.
std::vector<std::array<std::uint32_t, 3>> triangulated(
    const std::vector<Vec2>& polygon) {
  std::vector<std::uint32_t> rest(polygon.size());
  for (std::uint32_t i = 0; i < rest.size(); ++i) rest[i] = i;
  const bool is_clockwise = signed_area_of(polygon) < 0;
  if (is_clockwise) std::reverse(rest.begin(), rest.end());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (rest.size() >= 3) {
    const std::size_t n = rest.size();
    std::size_t ear = n;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const Vec2& a = polygon[rest[(i + n - 1) % n]];
      const Vec2& b = polygon[rest[i]];
      const Vec2& c = polygon[rest[(i + 1) % n]];
      if ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) <= 0) continue;
      bool is_ear = true;
      for (std::size_t k = 0; k < n && is_ear; ++k) {
        if (k == i || (k + 1) % n == i || (i + 1) % n == k) continue;
        is_ear = !in_triangle(polygon[rest[k]], a, b, c);
      }
      if (is_ear) ear = i;
    }
    if (ear == n) ear = 0;  // collinear rest
    triangles.push_back(
        // Three at least. NOLINTNEXTLINE(clang-analyzer-core.DivideZero)
        {rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (is_clockwise) {
    for (auto& triangle : triangles) std::swap(triangle[0], triangle[2]);
  }
  return triangles;
}

}  // namespace

std::vector<Vec2> regular_polygon(int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return points;
}

csg::Leaf cube_leaf(const Vec3& size) {
  return extrusion_leaf({{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}},
                        size.z);
}

csg::Leaf cylinder_leaf(double r1, double r2, double height, int facets) {
  return leaf_of(
      make_loft(regular_polygon(facets), {{r1, 0}, {r2, height}}, false));
}

csg::Leaf sphere_leaf(double radius, int facets) {
  const int rings = (facets + 1) / 2;
  std::vector<Vec2> profile;
  for (int i = rings; i-- > 0;) {
    const double angle = kPi * (i + 0.5) / rings;
    profile.push_back({radius * std::sin(angle), radius * std::cos(angle)});
  }
  return leaf_of(make_loft(regular_polygon(facets), profile, false));
}

csg::Leaf torus_leaf(double radius, double tube_radius, int around,
                     int facets) {
  std::vector<Vec2> profile;
  for (const Vec2& point : regular_polygon(facets)) {
    profile.push_back({radius + tube_radius * point.x, tube_radius * point.y});
  }
  return leaf_of(make_loft(regular_polygon(around), profile, true));
}

csg::Leaf extrusion_leaf(std::vector<Vec2> outline, double height) {
  return leaf_of(make_loft(std::move(outline), {{1, 0}, {1, height}}, false));
}

csg::Leaf as_mesh(const csg::Leaf& leaf) {
  csg::Leaf result;
  result.may_overlap_itself = leaf.may_overlap_itself;
  result.meshes = leaf.meshes;
  for (const csg::Loft& loft : leaf.lofts) {
    const auto corners = static_cast<std::uint32_t>(loft.outline->size());
    const auto rings = static_cast<std::uint32_t>(loft.profile.size());
    csg::Leaf single;
    single.lofts = {loft};
    csg::Mesh mesh;
    mesh.vertices = vertices_of(single);
    const std::uint32_t strips = loft.is_closed_profile ? rings : rings - 1;
    for (std::uint32_t i = 0; i < strips; ++i) {
      for (std::uint32_t j = 0; j < corners; ++j) {
        const std::uint32_t a = i * corners + j;
        const std::uint32_t b = i * corners + (j + 1) % corners;
        const std::uint32_t c = (i + 1) % rings * corners + (j + 1) % corners;
        const std::uint32_t d = (i + 1) % rings * corners + j;
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
    if (!loft.is_closed_profile) {
      for (const auto& t : triangulated(*loft.outline)) {
        mesh.triangles.push_back({t[2], t[1], t[0]});
        const std::uint32_t top = (rings - 1) * corners;
        mesh.triangles.push_back({top + t[0], top + t[1], top + t[2]});
      }
    }
    // Turn it outward: natural order is outward where the outline and the
    // profile turn the same way.
    double volume = 0;
    for (const auto& t : mesh.triangles) {
      volume += glm::dot(mesh.vertices[t[0]],
                         glm::cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
    }
    if ((volume < 0) != loft.is_cavity) {
      for (auto& t : mesh.triangles) std::swap(t[0], t[2]);
    }
    result.meshes.push_back(std::move(mesh));
  }
  return result;
}

Affine operator*(const Affine& a, const Affine& b) {
  return Affine(glm::dmat4(a) * glm::dmat4(b));
}

Affine translated(const Vec3& by) {
  return Affine(glm::translate(glm::dmat4(1.0), by));
}

Affine rotated(double angle_deg, const Vec3& axis) {
  return Affine(glm::rotate(glm::dmat4(1.0), angle_deg * kPi / 180, axis));
}

Affine scaled(const Vec3& by) {
  return Affine(glm::scale(glm::dmat4(1.0), by));
}

SceneBuilder::SceneBuilder(plane::BooleanOp root) {
  scene_.program.push_back({root, 0, false, 0});
  open_.push_back(0);
}

void SceneBuilder::begin(plane::BooleanOp op) {
  const std::uint32_t parent = open_.back();
  const bool is_first = scene_.program[parent].child_count++ == 0;
  open_.push_back(static_cast<std::uint32_t>(scene_.program.size()));
  scene_.program.push_back({op, parent, is_first, 0});
}

void SceneBuilder::end() { open_.pop_back(); }

void SceneBuilder::add(csg::Leaf leaf, const Affine& world_from_leaf) {
  for (const Vec3& vertex : vertices_of(leaf)) extend(leaf.box, vertex);
  scene_.leaves.push_back(std::move(leaf));
  add_instance(static_cast<std::uint32_t>(scene_.leaves.size() - 1),
               world_from_leaf);
}

void SceneBuilder::add_instance(std::uint32_t leaf,
                                const Affine& world_from_leaf) {
  csg::Instance instance;
  instance.leaf = leaf;
  instance.parent = open_.back();
  instance.is_minuend = scene_.program[open_.back()].child_count++ == 0;
  instance.world_from_leaf = world_from_leaf;
  for (const Vec3& vertex : vertices_of(scene_.leaves[leaf])) {
    extend(instance.box, world_from_leaf * Vec4(vertex, 1));
  }
  scene_.instances.push_back(instance);
}

csg::Scene SceneBuilder::finish() {
  // Boxes of operators, children before parents.
  std::vector<Box3> boxes(scene_.program.size());
  std::vector<bool> has_box(scene_.program.size(), false);
  const auto join = [&](std::uint32_t parent, bool is_minuend,
                        const Box3& box) {
    Box3& whole = boxes[parent];
    switch (scene_.program[parent].op) {
      case plane::BooleanOp::kUnion:
        whole.low = glm::min(whole.low, box.low);
        whole.high = glm::max(whole.high, box.high);
        break;
      case plane::BooleanOp::kDifference:
        if (is_minuend) whole = box;
        break;
      case plane::BooleanOp::kIntersection:
        if (!has_box[parent]) whole = box;
        whole.low = glm::max(whole.low, box.low);
        whole.high = glm::min(whole.high, box.high);
        break;
    }
    has_box[parent] = true;
  };
  for (const csg::Instance& instance : scene_.instances) {
    join(instance.parent, instance.is_minuend, instance.box);
  }
  for (std::size_t i = scene_.program.size(); i-- > 1;) {
    join(scene_.program[i].parent, scene_.program[i].is_minuend, boxes[i]);
  }
  scene_.box = boxes[0];
  return std::move(scene_);
}

}  // namespace lamina::testing
