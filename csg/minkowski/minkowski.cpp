#include "csg/minkowski/minkowski.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/convex_hull.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/limits.h"
#include "csg/minkowski/connected_faces.h"
#include "csg/minkowski/convex_leaf.h"
#include "csg/minkowski/convex_pairs.h"
#include "csg/plane/convex_faces.h"
#include "csg/plane/triangulate.h"
#include "csg/vertex_table.h"

namespace lamina::csg {
namespace {

// --- Convex parts ------------------------------------------------------------

// base ⊕ (axis ⊕ other)
Convex add_prism(const Prism& prism, const Convex& other) {
  Convex swept = add_flat(prism.axis, other);
  find_edges(swept);
  return add_flat(prism.base, swept);
}

Convex add_solids(const Convex& a, const Convex& b) {
  if (const auto prism = as_prism(a)) return add_prism(*prism, b);
  if (const auto prism = as_prism(b)) return add_prism(*prism, a);
  const Mesh hull = convex_hull(extreme_sums(a, b));
  std::vector<std::vector<std::uint32_t>> loops;
  for (planar::Face& face :
       planar::merge_to_convex(hull.vertices, hull.triangles)) {
    loops.push_back(std::move(face.corners));
  }
  return make_solid(hull.vertices, loops);
}

bool is_point(const Convex& body) { return body.vertices.size() == 1; }

Convex move(Convex body, const Vec3& shift) {
  for (Vec3& vertex : body.vertices) vertex += shift;
  return body;
}

// Both have their edges; the sum does not.
Convex add_convex(const Convex& a, const Convex& b) {
  if (is_point(a)) return move(b, a.vertices[0]);
  if (is_point(b)) return move(a, b.vertices[0]);
  if (a.is_flat) return add_flat(a, b);
  if (b.is_flat) return add_flat(b, a);
  return add_solids(a, b);
}

// --- Bodies ------------------------------------------------------------------

// Flat convex polygons of triangles.
std::vector<Convex> make_faces(const Mesh& mesh) {
  std::vector<Convex> faces;
  for (const planar::Face& face :
       planar::merge_to_convex(mesh.vertices, mesh.triangles)) {
    if (face.normal == Vec3(0)) continue;
    std::vector<Vec3> polygon;
    for (const std::uint32_t corner : face.corners) {
      polygon.push_back(mesh.vertices[corner]);
    }
    faces.push_back(make_flat(std::move(polygon), face.normal));
  }
  return faces;
}

// The faces of a Boolean as triangles; equal vertices are one.
Mesh triangulate(std::span<const BoundaryFace> faces) {
  Mesh mesh;
  VertexTable names;
  for (const BoundaryFace& face : faces) {
    // A plane that turns the face's normal to the viewer.
    const Vec3 n = face.normal;
    const Vec3 other = std::abs(n.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 x_axis = glm::normalize(glm::cross(other, n));
    const Vec3 y_axis = glm::cross(n, x_axis);
    planar::Region region;
    std::vector<std::uint32_t> corners;
    for (const std::vector<Vec3>& contour : face.contours) {
      region.contours.emplace_back();
      for (const Vec3& p : contour) {
        region.contours.back().emplace_back(glm::dot(p, x_axis),
                                            glm::dot(p, y_axis));
        corners.push_back(names.name(p));
      }
    }
    for (const auto& t : planar::triangulate(region)) {
      mesh.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
    }
  }
  mesh.vertices = names.take_points();
  return mesh;
}

Mesh transform(Mesh mesh, const Affine& matrix) {
  for (Vec3& vertex : mesh.vertices) vertex = matrix * Vec4(vertex, 1);
  if (glm::dot(matrix[0], glm::cross(matrix[1], matrix[2])) < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

Body make_body(Scene scene, std::vector<Convex> faces) {
  return {std::make_shared<const Scene>(std::move(scene)),
          std::make_shared<const std::vector<Convex>>(std::move(faces))};
}

// --- Parts of a scene --------------------------------------------------------

// Takes a scene apart into the children of its root, if that is a union.
class Divider {
 public:
  explicit Divider(const Scene& scene) : scene_(scene) {}

  Operand divide() {
    if (scene_.program[0].op != BooleanOp::kUnion) {
      add_boolean(0);
      return std::move(operand_);
    }
    for (std::uint32_t n = 1; n < scene_.program.size(); ++n) {
      if (scene_.program[n].parent == 0) add_boolean(n);
    }
    for (const Instance& instance : scene_.instances) {
      if (instance.parent == 0) add_instance(instance);
    }
    return std::move(operand_);
  }

 private:
  void add_boolean(std::uint32_t node) {
    Scene part = node == 0 ? scene_ : cut_out(node);
    std::vector<Convex> faces = make_faces(triangulate(boundary_faces(part)));
    if (faces.empty()) return;  // nothing is left of it
    operand_.bodies.push_back(make_body(std::move(part), std::move(faces)));
  }

  void add_instance(const Instance& instance) {
    const Leaf& leaf = scene_.leaves[instance.leaf];
    const Affine& matrix = instance.world_from_leaf;
    auto parts = instance.is_flat ? flat_parts(leaf, matrix)
                                  : convex_parts(leaf, matrix);
    if (parts) {
      std::move(parts->begin(), parts->end(),
                std::back_inserter(operand_.convex));
      return;
    }
    Scene part;
    part.leaves.push_back(leaf);
    part.instances.push_back(instance);
    part.instances[0].leaf = 0;
    part.program.push_back({BooleanOp::kUnion, 0, false, 1});
    part.box = instance.box;
    const Mesh mesh = transform(explicit_mesh(leaf), instance.world_from_leaf);
    operand_.bodies.push_back(make_body(std::move(part), make_faces(mesh)));
  }

  // The subtree of one operator as a scene of its own.
  Scene cut_out(std::uint32_t root) const {
    constexpr std::uint32_t kOutside = ~std::uint32_t{0};
    Scene part;
    std::vector<std::uint32_t> names(scene_.program.size(), kOutside);
    for (std::uint32_t n = root; n < scene_.program.size(); ++n) {
      BooleanNode node = scene_.program[n];
      if (n != root && names[node.parent] == kOutside) continue;
      names[n] = static_cast<std::uint32_t>(part.program.size());
      node.parent = n == root ? 0 : names[node.parent];
      if (n == root) node.is_minuend = false;
      part.program.push_back(node);
    }
    std::vector<std::uint32_t> leaf_names(scene_.leaves.size(), kOutside);
    for (Instance instance : scene_.instances) {
      if (names[instance.parent] == kOutside) continue;
      std::uint32_t& leaf = leaf_names[instance.leaf];
      if (leaf == kOutside) {
        leaf = static_cast<std::uint32_t>(part.leaves.size());
        part.leaves.push_back(scene_.leaves[instance.leaf]);
      }
      instance.parent = names[instance.parent];
      instance.leaf = leaf;
      part.box.low = glm::min(part.box.low, instance.box.low);
      part.box.high = glm::max(part.box.high, instance.box.high);
      part.instances.push_back(instance);
    }
    return part;
  }

  const Scene& scene_;
  Operand operand_;
};

// --- Sums --------------------------------------------------------------------

Body move(Body body, const Vec3& shift) {
  body.shift += shift;
  return body;
}

// A ⊕ B with A a body and B convex.
void add(const Body& a, const Convex& b, Operand& sum) {
  sum.bodies.push_back(move(a, middle(b)));
  if (is_point(b)) return;
  const Convex moved = move(b, a.shift);
  for (const Convex& face : *a.faces) {
    sum.convex.push_back(add_flat(face, moved));
  }
}

void add(const Body& a, const Body& b, Operand& sum) {
  for (const Vec3& point : points_of_components(*b.faces)) {
    sum.bodies.push_back(move(a, b.shift + point));
  }
  for (const Vec3& point : points_of_components(*a.faces)) {
    sum.bodies.push_back(move(b, a.shift + point));
  }
  for (const Convex& face : *a.faces) {
    const Convex moved = move(face, a.shift + b.shift);
    for (const Convex& other : *b.faces) {
      sum.convex.push_back(add_flat(moved, other));
    }
  }
}

// What takes part in a sum: convex parts, and faces of bodies.
struct Extent {
  double parts = 0;
  double vertices = 0;

  void add(const std::vector<Convex>& convex) {
    parts += static_cast<double>(convex.size());
    for (const Convex& part : convex) {
      vertices += static_cast<double>(part.vertices.size());
    }
  }
};

Extent extent_of(const Operand& operand) {
  Extent extent;
  extent.add(operand.convex);
  for (const Body& body : operand.bodies) extent.add(*body.faces);
  return extent;
}

// Each part of one meets each of the other, and their sum has no fewer vertices
// than either.
double least_triangles(const Operand& a, const Operand& b) {
  const Extent of_a = extent_of(a);
  const Extent of_b = extent_of(b);
  return 2 * std::max(of_a.parts * of_b.vertices, of_b.parts * of_a.vertices);
}

Operand add(const Operand& a, const Operand& b) {
  require_triangles(least_triangles(a, b));
  Operand sum;
  for (const Convex& p : a.convex) {
    for (const Convex& q : b.convex) sum.convex.push_back(add_convex(p, q));
  }
  for (const Body& p : a.bodies) {
    for (const Convex& q : b.convex) add(p, q, sum);
    for (const Body& q : b.bodies) add(p, q, sum);
  }
  for (const Body& q : b.bodies) {
    for (const Convex& p : a.convex) add(q, p, sum);
  }
  return sum;
}

}  // namespace

Operand make_operand(const Scene& scene) { return Divider(scene).divide(); }

Operand add_operands(std::vector<Operand> operands) {
  // Few convex parts first: then faces meet their sum, not each of them.
  std::stable_sort(operands.begin(), operands.end(),
                   [](const Operand& a, const Operand& b) {
                     return std::tuple(a.bodies.size(), a.convex.size()) <
                            std::tuple(b.bodies.size(), b.convex.size());
                   });
  Operand sum = std::move(operands[0]);
  for (std::size_t i = 1; i < operands.size(); ++i) {
    if (i > 1) {
      for (Convex& part : sum.convex) {
        if (part.edges.empty()) find_edges(part);
      }
    }
    sum = add(sum, operands[i]);
  }
  return sum;
}

Leaf make_leaf(std::span<const Convex> parts) {
  Leaf leaf;
  Mesh mesh;
  std::size_t count = 0;
  for (const Convex& part : parts) {
    if (part.is_flat) continue;
    append_triangles(part, mesh);
    ++count;
  }
  leaf.may_overlap_itself = count > 1;
  if (count > 0) leaf.meshes.push_back(std::move(mesh));
  return leaf;
}

}  // namespace lamina::csg
