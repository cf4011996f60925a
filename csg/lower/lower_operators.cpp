#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "csg/lower/detail/lowerer.h"
#include "plane/region/boolean.h"

namespace lamina::csg {
namespace {

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

// Whether it makes all that is solid flat. The columns are scaled by powers of
// two first, which rounds nothing: a matrix of small numbers is not 0.
bool is_singular(Affine m) {
  for (int column = 0; column < 3; ++column) {
    Vec3& v = m[column];
    const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (size == 0) return true;
    const int exponent = std::ilogb(size);
    for (int row = 0; row < 3; ++row) v[row] = std::ldexp(v[row], -exponent);
  }
  return glm::dot(m[0], glm::cross(m[1], m[2])) == 0;
}

plane::Region combine_regions(plane::BooleanOp op,
                              std::span<const plane::Region> regions) {
  switch (op) {
    case plane::BooleanOp::kDifference:
      return plane::subtract(regions);
    case plane::BooleanOp::kIntersection:
      return plane::intersect(regions);
    case plane::BooleanOp::kUnion:
      break;
  }
  return plane::unite(regions);
}

// Combines those operands of an operator that are no larger than the smaller
// ones together. So what an operator above sweeps again is at least doubled
// each time, and of operands that overlap deeply it gets little.
//
// regions  a minuend first
void combine_small_ones(plane::BooleanOp op,
                        std::vector<plane::Region>& regions) {
  const bool is_difference = op == plane::BooleanOp::kDifference;
  auto small = regions.begin() + (is_difference ? 1 : 0);
  std::stable_sort(small, regions.end(), [](const auto& a, const auto& b) {
    return plane::corner_count(a) > plane::corner_count(b);
  });
  std::size_t rest = 0;
  for (auto it = small; it != regions.end(); ++it) {
    rest += plane::corner_count(*it);
  }
  for (; small != regions.end(); ++small) {
    const std::size_t count = plane::corner_count(*small);
    rest -= count;
    if (count <= rest) break;
  }
  if (regions.end() - small < 2) return;
  *small = combine_regions(is_difference ? plane::BooleanOp::kUnion : op,
                           {small, regions.end()});
  regions.erase(small + 1, regions.end());
}

// Returns an operator's result, or its operands where an operator above joins
// them. It stays out of line, as operators nest and each frame counts.
//
// count  of the operands, of which a union leaves out the empty ones; around
//        one empty outline OpenSCAD makes none: the operator's siblings may be
//        solid
[[gnu::noinline]] Shape combine(plane::BooleanOp op,
                                std::vector<plane::Region> regions,
                                std::size_t count, bool is_joined) {
  const Shape none = {count == 1 ? Dimension::kNone : Dimension::kFlat};
  if (regions.empty()) return none;
  if (!is_joined) {
    plane::Region result = combine_regions(op, regions);
    if (result.is_empty()) return none;
    return {Dimension::kFlat, std::move(result)};
  }
  if (regions.size() > 1) plane::require_near(regions);
  combine_small_ones(op, regions);
  plane::Region first = std::move(regions.front());
  if (first.is_empty()) return none;
  regions.erase(regions.begin());
  return {Dimension::kFlat, std::move(first), false, std::move(regions)};
}

// Whether nothing is left of a shape in the plane.
bool is_empty_region(std::optional<plane::BooleanOp> joins,
                     const Shape& shape) {
  if (!joins || shape.more_regions.empty()) return shape.region.is_empty();
  std::vector<plane::Region> regions = shape.more_regions;
  regions.insert(regions.begin(), shape.region);
  return combine_regions(*joins, regions).is_empty();
}

// The operator that the i-th operand's own operands may join: (A - B) - C is
// A - B - C, A - (B ∪ C) as well, and A ∩ (B ∩ C) is A ∩ B ∩ C. Level by level
// each operator would sweep again what those below it leave.
std::optional<plane::BooleanOp> joint_of(std::optional<plane::BooleanOp> op,
                                         std::size_t i) {
  const bool is_subtrahend = op == plane::BooleanOp::kDifference && i > 0;
  return is_subtrahend ? plane::BooleanOp::kUnion : op;
}

// A child of an operator, an operator or an instance itself.
struct Child {
  std::uint32_t index = 0;
  bool is_operator = false;
};

// The children of each operator, the minuend of a difference first.
std::vector<std::vector<Child>> list_children(const Scene& scene) {
  std::vector<std::vector<Child>> children(scene.program.size());
  const auto add = [&](const auto& item, Child child) {
    std::vector<Child>& all = children[item.parent];
    all.insert(item.is_minuend ? all.begin() : all.end(), child);
  };
  for (std::uint32_t n = 1; n < scene.program.size(); ++n) {
    add(scene.program[n], {n, true});
  }
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    add(scene.instances[i], {i, false});
  }
  return children;
}

// Returns the color as an instance keeps it. What is not a number is 0.
std::int32_t to_rgb(const Vec4& rgba) {
  std::int32_t rgb = 0;
  for (int c = 0; c < 3; ++c) {
    const double share = std::min(1.0, std::max(0.0, rgba[c]));
    rgb = rgb << 8 | static_cast<std::int32_t>(std::lround(255 * share));
  }
  return rgb;
}

}  // namespace

// The outermost of nested colors counts, as in OpenSCAD. One that could not be
// read is none.
Shape Lowerer::lower_op(const Color& op, const Place& at) {
  const bool counts = color_ == kNoColor && op.rgba.x >= 0;
  if (counts) color_ = to_rgb(op.rgba);
  Shape shape = lower_children(at, plane::BooleanOp::kUnion);
  if (counts) color_ = kNoColor;
  return shape;
}

Shape Lowerer::lower_op(const Transform& op, const Place& at) {
  const std::size_t mark = builder_.mark();
  if (!is_finite(*op.matrix)) {
    diagnostics_.warning(at.node.range,
                         "Transformation matrix contains Not-a-Number and/or "
                         "Infinity - removing object.");
    return {};
  }
  Shape shape =
      lower_children({at.node, compose(at.world, *op.matrix), at.joins},
                     plane::BooleanOp::kUnion);
  if (shape.dimension == Dimension::kFlat) {
    const auto transform = [&](plane::Region& region) {
      region = transform_region(std::move(region), *op.matrix, at.node.range,
                                diagnostics_);
    };
    transform(shape.region);
    // Without a first operand nothing is left.
    if (shape.region.is_empty()) shape.more_regions.clear();
    std::for_each(shape.more_regions.begin(), shape.more_regions.end(),
                  transform);
    return shape;
  }
  if (is_singular(Affine(*op.matrix))) flatten(mark, shape, at.node.range);
  return shape;
}

void Lowerer::flatten(std::size_t mark, const Shape& shape, SourceRange range) {
  builder_.flatten(mark);
  if (!shape.is_boolean || builder_.mark() == mark) return;
  diagnostics_.warning(range, "Scaling a 3D object with 0 - removing object");
  builder_.drop(mark);
}

// --- Children ----------------------------------------------------------------

Lowerer::Operands Lowerer::lower_operands(const Place& at,
                                          std::optional<plane::BooleanOp> op,
                                          Dimension dimension) {
  const bool is_union = op == plane::BooleanOp::kUnion;
  Operands operands;
  operands.dimension = dimension;
  for (const Node* child : at.node.children) {
    if (child->is_background) continue;
    const auto joins = joint_of(op, operands.count);
    add_operand({*child, at.world, joins}, is_union, operands);
  }
  return operands;
}

void Lowerer::add_operand(const Place& child, bool is_union,
                          Operands& operands) {
  const std::size_t begin = builder_.mark();
  Shape shape = lower(child);
  if (operands.dimension == Dimension::kNone) {
    operands.dimension = shape.dimension;
  } else if (shape.dimension != Dimension::kNone &&
             shape.dimension != operands.dimension) {
    const bool is_empty =
        is_empty_region(child.joins, shape) && builder_.mark() == begin;
    if (!is_empty && !operands.first_mixed) operands.first_mixed = &child.node;
    operands.strays.push_back(&child.node);
    builder_.drop(begin);
    shape.region = {};
    shape.more_regions.clear();
  }
  if (operands.count == 0) {
    operands.is_first_none = shape.dimension == Dimension::kNone;
  }
  if (builder_.mark() > begin) {
    ++operands.solid_count;
    operands.has_boolean = operands.has_boolean || shape.is_boolean;
  } else if (operands.count > 0) {
    operands.is_later_empty = true;
  }
  ++operands.count;
  if (!is_union) operands.begins.push_back(begin);
  if (operands.dimension != Dimension::kSolid &&
      !(is_union && shape.region.is_empty())) {
    operands.regions.push_back(std::move(shape.region));
    std::move(shape.more_regions.begin(), shape.more_regions.end(),
              std::back_inserter(operands.regions));
  }
}

bool Lowerer::is_boolean(plane::BooleanOp op, const Operands& operands) {
  // What is empty takes no part in a union.
  const bool is_union = op == plane::BooleanOp::kUnion;
  return operands.has_boolean ||
         (is_union ? operands.solid_count : operands.count) > 1;
}

bool Lowerer::is_nothing(plane::BooleanOp op, const Operands& operands) {
  switch (op) {
    case plane::BooleanOp::kUnion:
      return operands.count > 1 && operands.solid_count == 0;
    case plane::BooleanOp::kDifference:
      return operands.is_first_none;
    case plane::BooleanOp::kIntersection:
      break;
  }
  return operands.is_first_none || operands.is_later_empty;
}

void Lowerer::report_strays(const Operands& operands) {
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

Shape Lowerer::lower_children(const Place& at, plane::BooleanOp op) {
  // An operator of one operand is that operand, and any operator.
  if (at.joins && at.node.children.size() == 1) op = *at.joins;
  const bool took_corners = takes_corners_;
  takes_corners_ = takes_corners_ && at.node.children.size() == 1;
  Operands operands = lower_operands(at, op, Dimension::kNone);
  takes_corners_ = took_corners;
  report_strays(operands);
  switch (operands.dimension) {
    case Dimension::kNone:
      return {};
    case Dimension::kFlat:
      return combine(op, std::move(operands.regions), operands.count,
                     at.joins == op);
    case Dimension::kSolid:
      break;
  }
  builder_.apply(op, operands.begins);
  return {is_nothing(op, operands) ? Dimension::kNone : Dimension::kSolid,
          {},
          is_boolean(op, operands)};
}

// --- Scenes ------------------------------------------------------------------

void Lowerer::place_scene(const Scene& scene, const Affine& world) {
  const auto children = list_children(scene);
  std::vector<std::uint32_t> leaves;
  for (const Leaf& leaf : scene.leaves) leaves.push_back(leaves_.add(leaf));
  const auto place_instance = [&](Instance instance) {
    const Affine& m = instance.world_from_leaf;
    instance.leaf = leaves[instance.leaf];
    instance.world_from_leaf = world * Mat4(m);
    instance.box = bound(instance.leaf, instance.world_from_leaf);
    instance.color = color_;
    builder_.push(instance);
  };
  const auto place_operator = [&](const auto& self, std::uint32_t n) -> void {
    std::vector<std::size_t> begins;
    for (const Child& child : children[n]) {
      begins.push_back(builder_.mark());
      if (child.is_operator) {
        self(self, child.index);
      } else {
        place_instance(scene.instances[child.index]);
      }
    }
    builder_.apply(scene.program[n].op, begins);
  };
  place_operator(place_operator, 0);
}

}  // namespace lamina::csg
