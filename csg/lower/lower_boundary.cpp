#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/projection.h"
#include "csg/lower/detail/lowerer.h"
#include "plane/region/boolean.h"
#include "plane/region/region.h"

namespace lamina::csg {
namespace {

plane::Region hull_of(const std::vector<plane::Region>& regions) {
  std::vector<Vec2> points;
  for (const plane::Region& region : regions) {
    for (const plane::Contour& contour : region.contours) {
      points.insert(points.end(), contour.begin(), contour.end());
    }
  }
  return plane::convex_hull(std::move(points));
}

Mat4 scaling(Vec3 factor) {
  Mat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i][i] = factor[i];
  return m;
}

bool only_unites(const Scene& scene) {
  return scene.program.size() == 1 &&
         scene.program[0].op == plane::BooleanOp::kUnion;
}

// The box of the solid itself, however its leaves are combined.
Box3 box_of_result(const Scene& scene) {
  if (only_unites(scene)) return scene.box;
  Box3 box;
  const auto reaches_out = [&](const Box3& part) {
    return glm::any(glm::lessThan(part.low, box.low)) ||
           glm::any(glm::greaterThan(part.high, box.high));
  };
  visit_boundary_faces(scene, reaches_out, [&](const BoundaryFace& face) {
    box.add(box_of(face));
  });
  return box;
}

// Other facets make a box larger or smaller by about the chordal error, and the
// factors differ by as much from one lowering to the next.
constexpr double kGrowthSlack = 1.01;

// How often what is resized is lowered until its factors settle. They do at
// once unless it is about as small as the chordal error; each lowering after
// the draft then brings a factor nearer to what it comes to, by as much as the
// result is larger than the error.
constexpr int kMostLowerings = 4;

// Coarse facets may leave nothing of what is resized. Where they do it is
// lowered with facets finer by so much, to know whether there is something.
// Files of CAD programs take longer the finer they are.
constexpr double kShareToFind = 0.01;
constexpr double kShareToFindParts = 0.1;

// The factors of resize(), by OpenSCAD's rules. A size of 0 keeps that
// direction, or with `auto` scales it as the direction of the greatest new
// size. So does a negative size, except that it mirrors the result of a Boolean
// (OpenSCAD 2021.01 has other code for that). A direction without extent is
// kept.
//
// size  of what is resized
template <int kDimensions>
glm::vec<kDimensions, double> factor_for(
    const Resize& op, const glm::vec<kDimensions, double>& size,
    bool may_mirror) {
  int greatest = 0;
  for (int i = 1; i < kDimensions; ++i) {
    if (op.new_size[i] > op.new_size[greatest]) greatest = i;
  }
  const auto is_given = [&](int i) {
    return may_mirror ? op.new_size[i] != 0 : op.new_size[i] > 0;
  };
  glm::vec<kDimensions, double> factor(1.0);
  for (int i = 0; i < kDimensions; ++i) {
    const bool follows =
        op.auto_size[static_cast<std::size_t>(i)] && !is_given(i);
    const int axis = follows ? greatest : i;
    if (is_given(axis) && size[axis] > 0) {
      factor[i] = op.new_size[axis] / size[axis];
    }
  }
  return factor;
}

// None of what is empty.
std::optional<Vec3> resize_factor(const Resize& op,
                                  const plane::Region& region) {
  if (region.is_empty()) return std::nullopt;
  Box2 box;
  for (const plane::Contour& contour : region.contours) box.add(contour);
  return Vec3(factor_for<2>(op, box.size(), false), 1);
}

std::optional<Vec3> resize_factor(const Resize& op, const Scene& scene,
                                  bool is_boolean) {
  if (scene.instances.empty()) return std::nullopt;
  const Box3 box = box_of_result(scene);
  if (box.is_empty()) return std::nullopt;
  return factor_for<3>(op, box.size(), is_boolean);
}

}  // namespace

Lowerer Lowerer::make_inner(const Place& at) {
  LowerOptions options = options_;
  options.chordal_error = fineness({}, at.world).chordal_error;
  options.chordal_error_of_parts = chordal_error_of_parts_at(at.world);
  options.decimation = decimation_at(at.world);
  Lowerer inner(at.node.children.size(), options, shared_, diagnostics_);
  inner.is_rigid_ = is_rigid_;
  inner.is_apart_ = true;
  return inner;
}

Lowerer::Apart Lowerer::lower_apart(const Place& at, bool takes_corners) {
  Lowerer inner = make_inner(at);
  inner.takes_corners_ = takes_corners;
  Operands operands = inner.lower_operands(
      {at.node, Affine(1.0)}, plane::BooleanOp::kUnion, Dimension::kNone);
  report_strays(operands);
  return {operands.dimension, std::move(operands.regions), inner.take_scene(),
          is_boolean(plane::BooleanOp::kUnion, operands), operands.count};
}

Shape Lowerer::lower_op(const Hull&, const Place& at) {
  Apart apart = lower_apart(at, true);
  if (apart.dimension == Dimension::kFlat) {
    return {Dimension::kFlat, hull_of(apart.regions)};
  }
  if (apart.scene.instances.empty()) return {};
  Leaf leaf;
  leaf.meshes.push_back(shared_.hulls.find_or_make(std::move(apart.scene)));
  leaf.is_convex = true;
  place_leaf(std::move(leaf), at);
  return {Dimension::kSolid};
}

Lowerer::Resized Lowerer::resize(const Resize& op, const Place& at) {
  const auto [entry, is_first] = shared_.growths.try_emplace(&at.node, 1);
  const Vec3 growth = entry->second;
  Resized resized{lower_apart({at.node, at.world * scaling(growth)}), {}};
  Apart& apart = resized.apart;
  if (apart.dimension == Dimension::kFlat) {
    apart.regions = {apart.regions.empty() ? plane::Region()
                                           : plane::unite(apart.regions)};
    resized.factor = resize_factor(op, apart.regions[0]);
  } else {
    resized.factor = resize_factor(op, apart.scene, apart.is_boolean);
  }
  const Vec3 needed = glm::abs(resized.factor.value_or(Vec3(1)));
  if (is_first || glm::any(glm::greaterThan(needed, growth))) {
    shared_.growths[&at.node] = is_first
                                    ? kGrowthSlack * needed
                                    : glm::max(kGrowthSlack * needed, growth);
    shared_.has_grown = true;
  }
  if (!resized.factor) shared_.empty.insert(&at.node);
  return resized;
}

void Lowerer::draft_sizes(const Resize& op, const Place& at) {
  const auto draft = [&](const LowerOptions& options) {
    Diagnostics unheard;
    shared_.empty.clear();
    Lowerer(at.node.children.size(), options, shared_, unheard).resize(op, at);
  };
  // Decimation is slow, and a size changes little by it.
  LowerOptions options = options_;
  options.decimation = 0;
  draft(options);
  if (shared_.empty.empty()) return;
  options.chordal_error *= kShareToFind;
  options.chordal_error_of_parts *= kShareToFindParts;
  try {
    draft(options);
  } catch (const GeometryError&) {
    return;  // so fine it is too large to know
  }
  shared_.known_empty.merge(shared_.empty);
}

Lowerer::Resized Lowerer::resize_finely(const Resize& op, const Place& at) {
  std::set<std::string> known;
  for (const auto& [key, leaf] : shared_.decimated) known.insert(key);
  shared_.is_resizing = true;
  if (!shared_.growths.contains(&at.node)) draft_sizes(op, at);
  Resized resized;
  Diagnostics heard;
  for (int i = 0; i < kMostLowerings; ++i) {
    // What files have to say is said when they are read.
    std::erase_if(shared_.decimated, [&](const auto& entry) {
      return !known.contains(entry.first);
    });
    shared_.has_grown = false;
    shared_.empty.clear();
    heard = Diagnostics();
    resized = Lowerer(at.node.children.size(), options_, shared_, heard)
                  .resize(op, at);
    if (!shared_.has_grown) break;
  }
  shared_.is_resizing = false;
  for (const Diagnostic& message : heard.all()) diagnostics_.report(message);
  const bool has_lost =
      !std::includes(shared_.known_empty.begin(), shared_.known_empty.end(),
                     shared_.empty.begin(), shared_.empty.end());
  if (shared_.has_grown || has_lost) {
    diagnostics_.own_warning(
        at.node.range,
        "The size of what resize() scales changes with its facets, which may "
        "be farther off than asked for");
  }
  return resized;
}

Shape Lowerer::lower_op(const Resize& op, const Place& at) {
  const bool depends = options_.chordal_error > 0 ||
                       options_.chordal_error_of_parts > 0 ||
                       options_.decimation > 0;
  Resized resized =
      depends && !shared_.is_resizing ? resize_finely(op, at) : resize(op, at);
  Apart& apart = resized.apart;
  const Mat4 scale = scaling(resized.factor.value_or(Vec3(1)));
  if (apart.dimension == Dimension::kFlat) {
    if (apart.count == 1 && apart.regions[0].is_empty()) return {};
    return {Dimension::kFlat,
            transform_region(std::move(apart.regions[0]), scale, at.node.range,
                             diagnostics_)};
  }
  if (apart.scene.instances.empty()) {
    return {apart.count > 1 ? Dimension::kNone : apart.dimension};
  }
  place_scene(apart.scene, at.world * scale);
  return {Dimension::kSolid, {}, apart.is_boolean};
}

Shape Lowerer::lower_op(const Projection& op, const Place& at) {
  Lowerer inner = make_inner(at);
  Operands operands = inner.lower_operands(
      {at.node, Affine(1.0)}, plane::BooleanOp::kUnion, Dimension::kSolid);
  operands.first_mixed = nullptr;
  if (op.cut) report_strays(operands);
  const Scene scene = inner.take_scene();
  if (scene.instances.empty()) return {};
  plane::Region region =
      op.cut ? cut_at_zero(scene, options_.language == Language::k2021
                                      ? Touch::kBothSides
                                      : Touch::kAbove)
             : project(scene);
  if (!region.is_empty()) return {Dimension::kFlat, std::move(region)};
  if (op.cut && misses_zero(scene)) {
    diagnostics_.warning({}, "Projection() failed.");
  }
  return {};
}

}  // namespace lamina::csg
