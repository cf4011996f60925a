#include "csg/minkowski/minkowski.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/leaf_faces.h"
#include "csg/limits.h"
#include "csg/mesh/vertex_table.h"
#include "csg/minkowski/convex.h"
#include "csg/minkowski/convex_leaf.h"
#include "csg/minkowski/detail/surfaces.h"
#include "csg/minkowski/joined_faces.h"
#include "csg/minkowski/surface_sum.h"

namespace lamina::csg {

using detail::hull_of;
using detail::join;

namespace {

// --- Convex parts ------------------------------------------------------------

// base ⊕ (axis ⊕ other)
Convex add_prism(const Prism& prism, const Convex& other) {
  Convex swept = add_flat(prism.axis, other);
  find_edges(swept);
  return add_flat(prism.base, swept);
}

// The same body with few more vertices than it needs. A sum has facets side by
// side in one plane, and each further sum would multiply them.
Convex without_seams(Convex sum) {
  Convex hull = hull_of(sum.vertices);
  if (hull.facet_count() > 0) return hull;
  if (sum.edges.empty()) find_edges(sum);
  return sum;
}

// Two flat sums cost a share of a hull, but pass over corners where rounding
// bends facets.
Convex add_solids(const Convex& a, const Convex& b) {
  if (!a.is_hull && !b.is_hull) {
    if (const auto prism = as_prism(a)) return add_prism(*prism, b);
    if (const auto prism = as_prism(b)) return add_prism(*prism, a);
  }
  return hull_of(extreme_sums(a, b));
}

bool is_point(const Convex& body) { return body.vertices.size() == 1; }

// Both have their edges; the sum does not.
Convex add_convex(const Convex& a, const Convex& b) {
  if (is_point(a)) return move(b, a.vertices[0]);
  if (is_point(b)) return move(a, b.vertices[0]);
  if (a.is_flat) return add_flat(a, b);
  if (b.is_flat) return add_flat(b, a);
  return add_solids(a, b);
}

// --- Bodies ------------------------------------------------------------------

Mesh mesh_of(LeafFaces faces) {
  return {std::move(faces.vertices), std::move(faces.triangles)};
}

Body make_body(Scene scene, Mesh mesh, std::vector<Convex> parts) {
  return {std::make_shared<const Scene>(std::move(scene)),
          std::make_shared<const std::vector<Convex>>(std::move(parts)),
          std::make_shared<const JoinedFaces>(join(std::move(mesh)))};
}

// --- Parts of a scene --------------------------------------------------------

// Takes a scene apart into the children of its root, if that is a union.
class Divider {
 public:
  explicit Divider(const Scene& scene) : scene_(scene) {}

  Operand divide() {
    if (scene_.program[0].op != plane::BooleanOp::kUnion) {
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
    const std::vector<BoundaryFace> faces = boundary_faces(part);
    if (faces.empty()) return;  // nothing is left of it
    if (is_convex(faces)) {
      operand_.convex.push_back(hull_of(corners_of(faces)));
    } else {
      operand_.bodies.push_back(
          make_body(std::move(part), triangulate(faces), {}));
    }
  }

  void add_instance(const Instance& instance) {
    const Leaf& leaf = scene_.leaves[instance.leaf];
    const Affine& matrix = instance.world_from_leaf;
    auto parts = instance.is_flat ? flat_parts(leaf, matrix)
                                  : convex_parts(leaf, matrix);
    if (parts && (instance.is_flat || parts->size() == 1)) {
      if (!instance.is_flat && !leaf.meshes.empty()) {
        parts->front() = without_seams(std::move(parts->front()));
      }
      std::move(parts->begin(), parts->end(),
                std::back_inserter(operand_.convex));
      return;
    }
    Scene part;
    part.leaves.push_back(leaf);
    part.instances.push_back(instance);
    part.instances[0].leaf = 0;
    part.program.push_back({plane::BooleanOp::kUnion, 0, false, 1});
    part.box = instance.box;
    operand_.bodies.push_back(
        make_body(std::move(part), mesh_of(faces_of(leaf, matrix)),
                  std::move(parts).value_or(std::vector<Convex>{})));
  }

  // The subtree of one operator as a scene of its own.
  Scene cut_out(std::uint32_t root) const {
    constexpr std::uint32_t kOutside = ~std::uint32_t{0};
    Scene part;
    std::vector<std::uint32_t> names(scene_.program.size(), kOutside);
    for (std::uint32_t n = root; n < scene_.program.size(); ++n) {
      plane::BooleanNode node = scene_.program[n];
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
      part.box.add(instance.box);
      part.instances.push_back(instance);
    }
    return part;
  }

  const Scene& scene_;
  Operand operand_;
};

// --- Sums --------------------------------------------------------------------

Vec3 middle_of(const JoinedFaces& surface) {
  Box3 box;
  box.add(surface.vertices());
  return box.center();
}

Body move(Body body, const Vec3& shift) {
  body.shift += shift;
  return body;
}

// Convex parts, moved.
struct Parts {
  std::span<const Convex> convex;
  Vec3 shift = Vec3(0);
};

Parts parts_of(const Body& body) { return {*body.parts, body.shift}; }
Parts parts_of(const Convex& part) { return {std::span(&part, 1), Vec3(0)}; }

// Each part of one meets each of the other, and their sum has about as many
// vertices as both.
double count_vertices(const Parts& a, const Parts& b) {
  const auto count = [](const Parts& parts) {
    double sum = 0;
    for (const Convex& part : parts.convex) {
      sum += static_cast<double>(part.vertices.size());
    }
    return sum;
  };
  return static_cast<double>(a.convex.size()) * count(b) +
         static_cast<double>(b.convex.size()) * count(a);
}

void add(const Parts& a, const Parts& b, Operand& sum) {
  for (const Convex& p : a.convex) {
    for (const Convex& q : b.convex) {
      sum.convex.push_back(move(add_convex(p, q), a.shift + b.shift));
    }
  }
}

// The sums of parts that have a corner in common cross each other about it,
// each with each.
double count_crossings(const std::vector<Convex>& parts) {
  VertexTable names;
  std::vector<std::size_t> counts;
  for (const Convex& part : parts) {
    for (const Vec3& vertex : part.vertices) {
      const std::uint32_t name = names.name(vertex);
      if (name == counts.size()) counts.push_back(0);
      ++counts[name];
    }
  }
  double sum = 0;
  for (const std::size_t count : counts) {
    sum += static_cast<double>(count) * static_cast<double>(count);
  }
  return sum;
}

// The parts of a body meet b in as many sums, and these cross; its surface
// meets b once.
bool is_cheaper_in_parts(const Body& a, const Convex& b,
                         const JoinedFaces& b_surface) {
  return !a.parts->empty() &&
         count_vertices(parts_of(a), parts_of(b)) + count_crossings(*a.parts) <=
             count_summits(*a.surface, b_surface);
}

void add(const Body& a, const Convex& b, Operand& sum) {
  const auto surface = std::make_shared<const JoinedFaces>(b);
  if (is_point(b)) {
    sum.bodies.push_back(move(a, b.vertices[0]));
    return;
  }
  if (is_cheaper_in_parts(a, b, *surface)) {
    add(parts_of(a), parts_of(b), sum);
    return;
  }
  sum.bodies.push_back(move(a, middle(b)));
  if (!b.is_flat) {
    const Vec3 aim = middle_of(*a.surface);
    for (const Vec3& point : points_of_components(*a.surface, aim)) {
      sum.convex.push_back(move(b, a.shift + point));
    }
  }
  sum.pairs.push_back({a.surface, surface, a.shift});
}

// One copy of the body for each component of the other's boundary, in the
// middle of the sum if it can be: the box of a body may be larger than itself,
// and should not reach beyond the sum.
void add_copies(const Body& body, const Body& other, Operand& sum) {
  const Vec3 aim = middle_of(*body.surface) + middle_of(*other.surface) -
                   body.scene->box.center();
  for (const Vec3& point : points_of_components(*other.surface, aim)) {
    sum.bodies.push_back(move(body, other.shift + point));
  }
}

void add(const Body& a, const Body& b, Operand& sum) {
  add_copies(a, b, sum);
  add_copies(b, a, sum);
  sum.pairs.push_back({a.surface, b.surface, a.shift + b.shift});
}

Operand add(const Operand& a, const Operand& b) {
  require_triangles(2 * count_vertices({a.convex}, {b.convex}));
  Operand sum;
  add(Parts{a.convex}, Parts{b.convex}, sum);
  for (const Body& p : a.bodies) {
    for (const Convex& q : b.convex) add(p, q, sum);
    for (const Body& q : b.bodies) add(p, q, sum);
  }
  for (const Body& q : b.bodies) {
    for (const Convex& p : a.convex) add(q, p, sum);
  }
  return sum;
}

std::size_t face_count(const Operand& operand) {
  std::size_t count = 0;
  for (const Body& body : operand.bodies) count += body.surface->face_count();
  return count;
}

void find_missing_edges(Operand& operand) {
  for (Convex& part : operand.convex) {
    if (!part.edges.empty()) continue;
    if (part.is_flat) {
      find_edges(part);
    } else {
      part = without_seams(std::move(part));
    }
  }
}

}  // namespace

Operand make_operand(const Scene& scene) { return Divider(scene).divide(); }

void sort_for_sum(std::vector<Operand>& operands) {
  std::stable_sort(
      operands.begin(), operands.end(), [](const Operand& a, const Operand& b) {
        return std::tuple(a.bodies.size(), face_count(a), a.convex.size()) <
               std::tuple(b.bodies.size(), face_count(b), b.convex.size());
      });
}

Operand add_operands(Operand a, Operand b) {
  find_missing_edges(a);
  find_missing_edges(b);
  return add(a, b);
}

Leaf make_leaf(const Operand& sum) {
  Leaf leaf;
  Mesh mesh;
  std::size_t count = 0;
  for (const Convex& part : sum.convex) {
    if (part.is_flat) continue;
    append_triangles(part, mesh);
    ++count;
  }
  leaf.may_overlap_itself = count > 1 || !sum.pairs.empty();
  leaf.is_convex = !leaf.may_overlap_itself;
  if (count > 0) leaf.meshes.push_back(std::move(mesh));
  for (const SurfacePair& pair : sum.pairs) {
    leaf.meshes.push_back(add_surfaces(*pair.a, *pair.b, pair.shift));
  }
  return leaf;
}

}  // namespace lamina::csg
