#include "csg/solid/lower.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "csg/planar/facets.h"
#include "csg/solid/detail/extrude.h"
#include "csg/solid/detail/flat.h"
#include "csg/solid/detail/leaf_box.h"
#include "csg/solid/detail/leaf_store.h"
#include "csg/solid/detail/polyhedron.h"
#include "csg/solid/detail/program_builder.h"

namespace lamina::csg {
namespace {

// What a subtree is. A solid's parts stand on the program builder's stack, and
// there may be none: an empty solid still is three-dimensional.
enum class Dimension { kNone, kFlat, kSolid };
struct Shape {
  Dimension dimension = Dimension::kNone;
  planar::Region region = {};
};

double determinant(const Affine& m) {
  return glm::dot(m[0], glm::cross(m[1], m[2]));
}

bool is_finite(const Mat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

Vec3 apply_linear(const Affine& m, Vec3 v) {
  return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}

Affine compose(const Affine& outer, const Mat4& inner) {
  const Affine m(inner);
  return {apply_linear(outer, m[0]), apply_linear(outer, m[1]),
          apply_linear(outer, m[2]), apply_linear(outer, m[3]) + outer[3]};
}

// What a walk over the tree tells before it is lowered.
struct Survey {
  const Node* root_modifier = nullptr;  // first node with `!`
  std::size_t childless = 0;            // most of these are leaves
};

void survey(const Node& node, Survey& result) {
  if (node.children.empty()) ++result.childless;
  for (const Node* child : node.children) {
    if (child->is_root && !result.root_modifier) result.root_modifier = child;
    survey(*child, result);
  }
}

std::vector<Note> call_chain(const Node& node) {
  std::vector<Note> notes;
  for (const CallFrame* frame = node.caller; frame; frame = frame->caller) {
    notes.push_back({frame->range, fmt::format("called by '{}'", frame->name)});
  }
  return notes;
}

[[noreturn]] void fail_unsupported(const Node& node, std::string_view module) {
  throw GeometryError({Severity::kError, node.range,
                       fmt::format("Module '{}' is not supported yet", module),
                       call_chain(node)});
}

class Lowerer {
 public:
  // instances  about as many as there will be
  Lowerer(std::size_t instances, Diagnostics& diagnostics)
      : diagnostics_(diagnostics) {
    builder_.reserve(instances);
  }

  // The solid parts of the subtree are left on top of the builder's stack, in
  // world coordinates; a region is in the node's own coordinates.
  Shape lower(const Node& node, const Affine& world) {
    return std::visit([&](const auto& op) { return lower_op(op, node, world); },
                      node.op);
  }

  Scene take_scene() {
    Scene scene;
    builder_.finish(scene);
    scene.leaves = leaves_.take();
    return scene;
  }
  bool has_parts() const { return builder_.mark() > 0; }

 private:
  // --- Operators ----------------------------------------------------------

  Shape lower_op(const Group&, const Node& node, const Affine& world) {
    return lower_children(node, world, BooleanOp::kUnion);
  }
  Shape lower_op(const Union&, const Node& node, const Affine& world) {
    return lower_children(node, world, BooleanOp::kUnion);
  }
  Shape lower_op(const Render&, const Node& node, const Affine& world) {
    return lower_children(node, world, BooleanOp::kUnion);
  }
  Shape lower_op(const Color&, const Node& node, const Affine& world) {
    return lower_children(node, world, BooleanOp::kUnion);
  }
  Shape lower_op(const Difference&, const Node& node, const Affine& world) {
    return lower_children(node, world, BooleanOp::kDifference);
  }
  Shape lower_op(const Intersection&, const Node& node, const Affine& world) {
    return lower_children(node, world, BooleanOp::kIntersection);
  }

  Shape lower_op(const Transform& op, const Node& node, const Affine& world) {
    const std::size_t mark = builder_.mark();
    if (!is_finite(*op.matrix)) {
      diagnostics_.warning(node.range,
                           "Transformation matrix contains Not-a-Number and/or "
                           "Infinity - removing object.");
      return {};
    }
    Shape shape =
        lower_children(node, compose(world, *op.matrix), BooleanOp::kUnion);
    if (shape.dimension == Dimension::kFlat) {
      return {Dimension::kFlat,
              transform_region(std::move(shape.region), *op.matrix, node.range,
                               diagnostics_)};
    }
    if (shape.dimension == Dimension::kSolid &&
        determinant(Affine(*op.matrix)) == 0) {
      diagnostics_.warning(node.range,
                           "Scaling a 3D object with 0 - removing object");
      builder_.drop(mark);
    }
    return shape;
  }

  // --- Children -----------------------------------------------------------

  // The operands of an operator: those of the first child's dimension.
  struct Operands {
    Dimension dimension = Dimension::kNone;
    std::size_t count = 0;
    std::vector<std::size_t> begins;  // on the stack; not kept for a union
    std::vector<planar::Region> regions;
    std::vector<const Node*> strays;  // of the other dimension
    const Node* first_mixed = nullptr;
  };

  void add_operand(const Node& child, const Affine& world, bool is_union,
                   Operands& operands) {
    const std::size_t begin = builder_.mark();
    Shape shape = lower(child, world);
    if (operands.dimension == Dimension::kNone) {
      operands.dimension = shape.dimension;
    } else if (shape.dimension != Dimension::kNone &&
               shape.dimension != operands.dimension) {
      const bool is_empty = shape.region.is_empty() && builder_.mark() == begin;
      if (!is_empty && !operands.first_mixed) operands.first_mixed = &child;
      operands.strays.push_back(&child);
      builder_.drop(begin);
      shape.region = {};
    }
    ++operands.count;
    if (!is_union) operands.begins.push_back(begin);
    if (operands.dimension != Dimension::kSolid &&
        !(is_union && shape.region.is_empty())) {
      operands.regions.push_back(std::move(shape.region));
    }
  }

  void report_strays(const Operands& operands) {
    if (operands.first_mixed) {
      diagnostics_.warning(operands.first_mixed->range,
                           "Mixing 2D and 3D objects is not supported");
    }
    const bool is_solid = operands.dimension == Dimension::kSolid;
    for (const Node* stray : operands.strays) {
      diagnostics_.warning(
          stray->range, is_solid ? "Ignoring 2D child object for 3D operation"
                                 : "Ignoring 3D child object for 2D operation");
    }
  }

  Shape lower_children(const Node& node, const Affine& world, BooleanOp op) {
    const std::size_t mark = builder_.mark();
    Operands operands;
    for (const Node* child : node.children) {
      if (child->is_background) continue;
      add_operand(*child, world, op == BooleanOp::kUnion, operands);
    }
    report_strays(operands);
    switch (operands.dimension) {
      case Dimension::kNone:
        return {};
      case Dimension::kFlat:
        if (operands.regions.empty()) return {Dimension::kFlat};
        return {Dimension::kFlat, combine_regions(op, operands.regions,
                                                  node.range, diagnostics_)};
      case Dimension::kSolid:
        break;
    }
    if (op == BooleanOp::kDifference) {
      builder_.apply_difference(operands.begins);
    } else if (op == BooleanOp::kIntersection) {
      builder_.apply_intersection(operands.begins);
    }
    const bool is_nothing = builder_.mark() == mark && operands.count > 1;
    return {is_nothing ? Dimension::kNone : Dimension::kSolid};
  }

  // --- Leaves -------------------------------------------------------------

  Shape lower_op(const Cube& cube, const Node& node, const Affine& world) {
    if (is_size(cube.size.x) && is_size(cube.size.y) && is_size(cube.size.z)) {
      place(leaves_.unit_cube(cube.center), cube.size, node, world);
    }
    return {Dimension::kSolid};
  }

  Shape lower_op(const Sphere& sphere, const Node& node, const Affine& world) {
    if (is_size(sphere.r)) {
      const int n = planar::fragment_count(sphere.r, sphere.facets);
      place(leaves_.unit_sphere(n), Vec3(sphere.r), node, world);
    }
    return {Dimension::kSolid};
  }

  Shape lower_op(const Cylinder& c, const Node& node, const Affine& world) {
    const double r = std::fmax(c.r1, c.r2);
    if (!is_size(c.h) || !is_size(r) || !(c.r1 >= 0 && c.r2 >= 0)) {
      return {Dimension::kSolid};
    }
    const int n = planar::fragment_count(r, c.facets);
    // A cone keeps its radii: their ratio would not give back the same bits.
    const bool is_straight = c.r1 == c.r2;
    const Vec3 size = is_straight ? Vec3(r, r, c.h) : Vec3(1, 1, c.h);
    const std::uint32_t leaf =
        is_straight ? leaves_.unit_height_cone(1, 1, c.center, n)
                    : leaves_.unit_height_cone(c.r1, c.r2, c.center, n);
    place(leaf, size, node, world);
    return {Dimension::kSolid};
  }

  Shape lower_op(const Polyhedron& polyhedron, const Node& node,
                 const Affine& world) {
    Leaf leaf;
    leaf.meshes.push_back(
        make_polyhedron(polyhedron, node.range, diagnostics_));
    leaf.may_overlap_itself = true;
    place_leaf(std::move(leaf), node, world);
    return {Dimension::kSolid};
  }

  Shape lower_op(const LinearExtrude& op, const Node& node,
                 const Affine& world) {
    const Shape shape = flatten_children(node, world);
    if (shape.dimension == Dimension::kNone) return {};
    place_leaf(extrude_linearly(*op.params, shape.region), node, world);
    return {Dimension::kSolid};
  }

  Shape lower_op(const RotateExtrude& op, const Node& node,
                 const Affine& world) {
    const Shape shape = flatten_children(node, world);
    if (shape.dimension == Dimension::kNone || op.angle_deg == 0) return {};
    const ProfileRange range = profile_range(shape.region);
    if (range.crosses_axis()) {
      diagnostics_.error(
          node.range,
          fmt::format("all points for rotate_extrude() must have the same X "
                      "coordinate sign (range is {:.2f} -> {:.2f})",
                      range.low, range.high));
      return {};
    }
    const int n = planar::fragment_count(range.high - range.low, op.facets);
    place_leaf(extrude_around(shape.region, op.angle_deg, n), node, world);
    return {Dimension::kSolid};
  }

  // --- 2D -------------------------------------------------------------------

  Shape lower_op(const Square& square, const Node&, const Affine&) {
    return {Dimension::kFlat, planar::square(square.size, square.center)};
  }

  Shape lower_op(const Circle& circle, const Node&, const Affine&) {
    const int n = planar::fragment_count(circle.r, circle.facets);
    return {Dimension::kFlat, planar::circle(circle.r, n)};
  }

  Shape lower_op(const Polygon& polygon, const Node& node, const Affine&) {
    return {Dimension::kFlat, make_polygon(polygon, node.range, diagnostics_)};
  }

  Shape lower_op(const Offset& op, const Node& node, const Affine& world) {
    const Shape shape = flatten_children(node, world);
    if (shape.dimension == Dimension::kNone) return {};
    return {Dimension::kFlat,
            offset_region(op, shape.region, node.range, diagnostics_)};
  }

  // The children's union in the plane, whatever else there is.
  Shape flatten_children(const Node& node, const Affine& world) {
    Operands operands;
    operands.dimension = Dimension::kFlat;
    for (const Node* child : node.children) {
      if (child->is_background) continue;
      add_operand(*child, world, true, operands);
    }
    operands.first_mixed = nullptr;
    report_strays(operands);
    if (operands.regions.empty()) {
      return {operands.count > 1 ? Dimension::kFlat : Dimension::kNone};
    }
    return {Dimension::kFlat,
            combine_regions(BooleanOp::kUnion, operands.regions, node.range,
                            diagnostics_)};
  }

  // --- Not yet (issue 4) ----------------------------------------------------

  Shape lower_op(const Hull&, const Node& node, const Affine&) {
    return lower_later(node, "hull");
  }
  Shape lower_op(const Minkowski&, const Node& node, const Affine& world) {
    // The sum of one operand is that operand.
    if (count_operands(node) == 1) {
      return lower_children(node, world, BooleanOp::kUnion);
    }
    return lower_later(node, "minkowski");
  }
  Shape lower_op(const Resize&, const Node& node, const Affine&) {
    return lower_later(node, "resize");
  }
  Shape lower_op(const Projection&, const Node& node, const Affine&) {
    return lower_later(node, "projection");
  }
  Shape lower_op(const Text&, const Node& node, const Affine&) {
    fail_unsupported(node, "text");
  }
  Shape lower_op(const Import&, const Node& node, const Affine&) {
    fail_unsupported(node, "import");
  }
  Shape lower_op(const Surface&, const Node& node, const Affine&) {
    fail_unsupported(node, "surface");
  }
  Shape lower_op(const Unsupported& op, const Node& node, const Affine&) {
    fail_unsupported(node, op.name);
  }

  static std::size_t count_operands(const Node& node) {
    return static_cast<std::size_t>(
        std::count_if(node.children.begin(), node.children.end(),
                      [](const Node* child) { return !child->is_background; }));
  }

  static Shape lower_later(const Node& node, std::string_view module) {
    if (count_operands(node) > 0) fail_unsupported(node, module);
    return {};
  }

  // Other sizes than these make OpenSCAD's primitives empty.
  static bool is_size(double x) { return x > 0 && std::isfinite(x); }

  void place_leaf(Leaf leaf, const Node& node, const Affine& world) {
    const bool is_empty =
        leaf.sweeps.empty() &&
        (leaf.meshes.empty() || leaf.meshes.front().triangles.empty());
    if (!is_empty) {
      place(leaves_.add(std::move(leaf)), Vec3(1), node, world);
    }
  }

  void place(std::uint32_t leaf, Vec3 size, const Node& node,
             const Affine& world) {
    Instance instance;
    instance.leaf = leaf;
    instance.world_from_leaf = {world[0] * size.x, world[1] * size.y,
                                world[2] * size.z, world[3]};
    instance.box = bound(leaf, instance.world_from_leaf);
    instance.range = node.range;
    instance.caller = node.caller;
    builder_.push(instance);
  }

  // Many instances of a leaf differ in their shift only: recent boxes are
  // kept.
  Box3 bound(std::uint32_t leaf, const Affine& m) {
    const double mix = m[0].x + 3 * m[0].y + 5 * m[1].y + 7 * m[2].z + leaf;
    const std::size_t slot =
        (std::bit_cast<std::uint64_t>(mix) * 0x9e3779b97f4a7c15u) >> 58;
    KeptBox& kept = kept_boxes_[slot];
    const bool is_same = kept.leaf == leaf && kept.linear[0] == m[0] &&
                         kept.linear[1] == m[1] && kept.linear[2] == m[2];
    if (!is_same) kept = {leaf, m, bound_leaf(leaves_[leaf], m)};
    return shift_box(kept.box, m[3]);
  }

  struct KeptBox {
    std::uint32_t leaf = 0;
    Affine linear{0.0};
    Box3 box;
  };

  Diagnostics& diagnostics_;
  LeafStore leaves_;
  ProgramBuilder builder_;
  std::array<KeptBox, 64> kept_boxes_;
};

}  // namespace

Lowered lower(const Tree& tree, const LowerOptions& options,
              Diagnostics& diagnostics) {
  Survey found;
  survey(*tree.root, found);
  const Node* root = found.root_modifier ? found.root_modifier : tree.root;
  Lowerer lowerer(found.childless, diagnostics);
  Shape shape = lowerer.lower(*root, options.world_from_design);
  if (!shape.region.is_empty()) return {std::move(shape.region)};
  if (lowerer.has_parts()) return {lowerer.take_scene()};
  return {};
}

}  // namespace lamina::csg
