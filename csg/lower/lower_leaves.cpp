#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "csg/boundary/leaf_mesh.h"
#include "csg/degrees.h"
#include "csg/lower/detail/extrude.h"
#include "csg/lower/detail/face.h"
#include "csg/lower/detail/lowerer.h"
#include "csg/lower/detail/repair.h"
#include "csg/roof/roof.h"

namespace lamina::csg {
namespace {

// Whether the map turns and scales nothing.
bool is_shift(const Affine& m) {
  return m[0] == Vec3(1, 0, 0) && m[1] == Vec3(0, 1, 0) &&
         m[2] == Vec3(0, 0, 1);
}

// Other sizes than these make OpenSCAD's primitives empty.
bool is_size(double x) { return x > 0 && std::isfinite(x); }

// Returns the face's vertices counter-clockwise, without those that do not
// exist and without repeats.
std::vector<std::uint32_t> read_face(const PolyhedronParams& polyhedron,
                                     std::size_t face, SourceRange range,
                                     Diagnostics& diagnostics) {
  std::vector<std::uint32_t> loop;
  const auto& indices = polyhedron.faces[face];
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= polyhedron.points.size()) {
      // OpenSCAD's indices are of 64 bits here, of 32 in a polygon.
      const auto index =
          static_cast<std::int64_t>(static_cast<std::int32_t>(indices[i]));
      warn_of_index(static_cast<std::uint64_t>(index), "faces", face, i, range,
                    diagnostics);
    } else if (loop.empty() || loop.back() != indices[i]) {
      loop.push_back(indices[i]);
    }
  }
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  std::reverse(loop.begin(), loop.end());
  return loop;
}

// Returns the faces as a closed mesh. They are clockwise from outside, as
// OpenSCAD has them; the mesh is counter-clockwise.
Mesh make_polyhedron(const PolyhedronParams& polyhedron, SourceRange range,
                     Diagnostics& diagnostics) {
  Mesh mesh;
  for (const Vec3& point : polyhedron.points) {
    // What is not finite is in no face. 0 · x is NaN there.
    const bool is_finite = glm::dot(point, Vec3(0)) == 0;
    mesh.vertices.push_back(is_finite ? point : Vec3(0));
  }
  std::optional<std::size_t> degenerate;  // the first such face
  for (std::size_t face = 0; face < polyhedron.faces.size(); ++face) {
    const auto loop = read_face(polyhedron, face, range, diagnostics);
    if (loop.size() < 3) {
      if (!degenerate) degenerate = face;
      continue;
    }
    add_face(mesh, loop);
  }
  if (degenerate) {
    diagnostics.warning(
        range, "PolySet has degenerate polygons",
        {{range, fmt::format("faces[{}] names fewer than 3 points: expected a "
                             "list such as [0, 1, 2]",
                             *degenerate)}});
  }
  repair_and_report(mesh, range, diagnostics);
  return mesh;
}

// Whether every ray from the mean of the mesh's vertices leaves the solid once,
// as of every convex solid: then it cannot overlap itself. Turned inside out it
// is not star-shaped.
//
// All faces are seen from inside, and together they cover the sphere of
// directions once. That sphere is covered as often in every direction, since
// the mesh is closed. Solid angles by Van Oosterom and Strackee 1983.
bool is_star_shaped(const Mesh& mesh) {
  // Faces that pass nearer to the mean may be seen either way [of the size].
  constexpr double kLeastDistance = 1e-6;
  if (mesh.triangles.empty()) return false;
  Vec3 mean(0);
  for (const Vec3& vertex : mesh.vertices) mean += vertex;
  mean /= static_cast<double>(mesh.vertices.size());
  double size = 0;
  for (const Vec3& vertex : mesh.vertices) {
    size = std::max(size, glm::distance(vertex, mean));
  }
  double solid_angle = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = mesh.vertices[triangle[0]] - mean;
    const Vec3 b = mesh.vertices[triangle[1]] - mean;
    const Vec3 c = mesh.vertices[triangle[2]] - mean;
    const double volume = glm::dot(a, glm::cross(b, c));
    const double area = glm::length(glm::cross(b - a, c - a));
    if (volume < kLeastDistance * size * area) return false;
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    solid_angle +=
        2 * std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc +
                                   glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return std::abs(solid_angle - 4 * std::numbers::pi) < std::numbers::pi;
}

// The corners of the faces alone, each as a triangle of no area. Faults of the
// faces do not matter.
Mesh make_corners(const PolyhedronParams& polyhedron, SourceRange range,
                  Diagnostics& diagnostics) {
  Mesh mesh;
  for (std::size_t face = 0; face < polyhedron.faces.size(); ++face) {
    for (const std::uint32_t corner :
         read_face(polyhedron, face, range, diagnostics)) {
      const auto name = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(polyhedron.points[corner]);
      mesh.triangles.push_back({name, name, name});
    }
  }
  return mesh;
}

}  // namespace

bool check_points(std::string_view wrong_point, std::string_view type,
                  SourceRange range, Diagnostics& diagnostics) {
  if (wrong_point.empty()) return true;
  diagnostics.error(
      range, fmt::format("Unable to convert {} to a {} of numbers", wrong_point,
                         type));
  return false;
}

void warn_of_index(std::uint64_t index, std::string_view list, std::size_t i,
                   std::size_t k, SourceRange range, Diagnostics& diagnostics) {
  diagnostics.warning(
      range, fmt::format("Point index {} is out of bounds (from {}[{}][{}])",
                         index, list, i, k));
}

Shape Lowerer::lower_op(const Cube& cube, const Place& at) {
  if (is_size(cube.size.x) && is_size(cube.size.y) && is_size(cube.size.z)) {
    place(leaves_.unit_cube(cube.center), cube.size, at);
  }
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const Sphere& sphere, const Place& at) {
  if (is_size(sphere.r)) {
    const int n = sphere_fragments(sphere.r, fineness(sphere.facets, at.world));
    place(leaves_.unit_sphere(n), Vec3(sphere.r), at);
  }
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const Cylinder& c, const Place& at) {
  const double r = std::fmax(c.r1, c.r2);
  if (!is_size(c.h) || !is_size(r) || !(c.r1 >= 0 && c.r2 >= 0)) {
    return {Dimension::kSolid};
  }
  const int n = circle_fragments(r, fineness(c.facets, at.world));
  // A cone keeps its radii: their ratio would not give back the same bits.
  const double unit = c.r1 == c.r2 ? r : 1;
  place(leaves_.unit_height_cone(c.r1 / unit, c.r2 / unit, c.center, n),
        Vec3(unit, unit, c.h), at);
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const Polyhedron& polyhedron, const Place& at) {
  const PolyhedronParams& params = *polyhedron.params;
  if (!check_points(params.wrong_point, "vec3", at.node.range, diagnostics_)) {
    return {Dimension::kSolid};
  }
  Leaf leaf;
  leaf.meshes.push_back(
      takes_corners_ ? make_corners(params, at.node.range, diagnostics_)
                     : make_polyhedron(params, at.node.range, diagnostics_));
  leaf.may_overlap_itself = !is_star_shaped(leaf.meshes.front());
  place_leaf(std::move(leaf), at);
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const LinearExtrude& op, const Place& at) {
  const LinearExtrudeParams& params = *op.params;
  // Where the sides are curved they and the outline share the chordal error.
  const bool is_curved = params.has_twist || params.scale.x != params.scale.y;
  const double share = is_curved ? 0.25 : 1;
  const double growth =
      std::max({1.0, std::abs(params.scale.x), std::abs(params.scale.y)});
  const Shape shape = flatten_finely(at, share, growth);
  if (shape.dimension == Dimension::kNone) return {};
  Fineness sides = fineness(params.facets, at.world);
  sides.chordal_error *= 1 - share;
  Leaf leaf = extrude_linearly(params, shape.region, sides);
  if (params.shift == Vec2(0) || !(params.height > 0)) {
    place_leaf(std::move(leaf), at);
  } else {
    Mat4 shear(1.0);
    shear[2] = Vec4(params.shift / params.height, 1, 0);
    place_leaf(std::move(leaf), {at.node, at.world * shear});
  }
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const RotateExtrude& op, const Place& at) {
  // The turn and its profile share the chordal error.
  constexpr double kShare = 0.5;
  const Shape shape = flatten_finely(at, kShare);
  if (shape.dimension == Dimension::kNone || op.angle_deg == 0) return {};
  const plane::Region profile = put_on_axis(shape.region);
  const ProfileRange range = profile_range(profile);
  if (range.crosses_axis()) {
    diagnostics_.error(
        at.node.range,
        options_.language == Language::k2021
            ? fmt::format("all points for rotate_extrude() must have the same "
                          "X coordinate sign (range is {:.2f} -> {:.2f})",
                          range.low, range.high)
            : fmt::format("Children of rotate_extrude() may not lie across the "
                          "Y axis (Range of X coords for all children [{:.2f} "
                          ": {:.2f}])",
                          range.low, range.high));
    return {};
  }
  Fineness turn = fineness(op.facets, at.world);
  turn.chordal_error *= 1 - kShare;
  const int n = turn_fragments(range, op.angle_deg, turn);
  place_leaf(extrude_around(profile, op.start_deg, op.angle_deg, n), at);
  return {Dimension::kSolid};
}

Shape Lowerer::lower_op(const Roof& op, const Place& at) {
  // The drawing and the rounded corners share the chordal error.
  constexpr double kShare = 0.5;
  const Shape shape = flatten_finely(at, kShare);
  if (shape.dimension == Dimension::kNone) return {};
  if (shape.region.is_empty()) return {Dimension::kSolid};
  Fineness corners = fineness(op.facets, at.world);
  corners.chordal_error *= 1 - kShare;
  std::vector<RoofStage> stages = op.is_straight
                                      ? sharp_roof(shape.region)
                                      : round_roof(shape.region, [&](double r) {
                                          return arc_step_deg(r, corners);
                                        });
  for (RoofStage& stage : stages) {
    const std::size_t mark = builder_.mark();
    LinearExtrudeParams prism;
    prism.height = stage.top - stage.bottom;
    Mat4 shift(1.0);
    shift[3].z = stage.bottom;
    place_leaf(extrude_linearly(prism, stage.region, {}),
               {at.node, at.world * shift});
    const std::array begins = {mark, builder_.mark()};
    Leaf cutters;
    cutters.may_overlap_itself = true;
    cutters.meshes.push_back(std::move(stage.cutters));
    place_leaf(std::move(cutters), at);
    builder_.apply(plane::BooleanOp::kDifference, begins);
  }
  return {Dimension::kSolid};
}

Fineness Lowerer::fineness(const Facets& facets, const Affine& world) const {
  Fineness fineness{facets, options_.language};
  if (options_.chordal_error > 0) {
    fineness.chordal_error = options_.chordal_error / greatest_stretch(world);
  }
  return fineness;
}

Shape Lowerer::flatten_finely(const Place& at, double share, double growth) {
  const LowerOptions whole = options_;
  options_.chordal_error *= share / growth;
  options_.chordal_error_of_parts /= growth;
  options_.decimation /= growth;
  Shape shape = flatten_children(at);
  options_ = whole;
  return shape;
}

void Lowerer::place_leaf(Leaf leaf, const Place& at) {
  if (const auto index = add_leaf(std::move(leaf))) {
    place(*index, Vec3(1), at);
  }
}

std::optional<std::uint32_t> Lowerer::add_leaf(Leaf leaf) {
  std::erase_if(leaf.meshes,
                [](const Mesh& mesh) { return mesh.triangles.empty(); });
  if (leaf.lofts.empty() && leaf.meshes.empty()) return std::nullopt;
  return leaves_.add(std::move(leaf));
}

void Lowerer::place(std::uint32_t leaf, Vec3 size, const Place& at) {
  Instance instance;
  instance.leaf = leaf;
  instance.world_from_leaf = {at.world[0] * size.x, at.world[1] * size.y,
                              at.world[2] * size.z, at.world[3]};
  instance.box = bound(leaf, instance.world_from_leaf);
  instance.range = at.node.range;
  instance.caller = at.node.caller;
  instance.support_tip = at.node.support_tip;
  // Supports are enlarged with the print.
  if (instance.support_tip > 0) {
    const Vec3 scale = options_.scale;
    instance.support_tip *=
        static_cast<float>(std::min({scale.x, scale.y, scale.z}));
  }
  instance.is_visible = at.node.is_visible;
  instance.color = color_;
  builder_.push(instance);
}

// Many instances of a leaf differ in their shift only: recent boxes are kept.
Box3 Lowerer::bound(std::uint32_t leaf, const Affine& m) {
  const double mix = m[0].x + 3 * m[0].y + 5 * m[1].y + 7 * m[2].z + leaf;
  const std::size_t slot =
      (std::bit_cast<std::uint64_t>(mix) * 0x9e3779b97f4a7c15u) >> 58;
  KeptBox& kept = kept_boxes_[slot];
  const bool is_same = kept.leaf == leaf && kept.linear[0] == m[0] &&
                       kept.linear[1] == m[1] && kept.linear[2] == m[2];
  if (!is_same) {
    const Box3 box =
        is_shift(m) ? leaves_[leaf].box : bound_leaf(leaves_[leaf], m);
    kept = {leaf, m, box};
  }
  return kept.box.shifted(m[3]);
}

}  // namespace lamina::csg
