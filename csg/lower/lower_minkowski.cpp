// minkowski(): the sum of its children.
//
// Each child is lowered apart, in the node's own coordinates, so that the sum
// is made before the world's matrix puts noise on what is flat or parallel.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "csg/boundary/convex_hull.h"
#include "csg/lower/detail/lowerer.h"
#include "csg/minkowski/minkowski.h"
#include "plane/region/minkowski.h"

namespace lamina::csg {
namespace {

bool is_flat(const Operand& term) {
  return term.bodies.empty() &&
         std::all_of(term.convex.begin(), term.convex.end(),
                     [](const Convex& part) { return part.is_flat; });
}

// Whether OpenSCAD, which adds one term after another, loses the sum: a sum
// without volume is empty to it, and so is all that is added to that.
bool is_lost(const std::vector<Operand>& terms) {
  if (terms.size() < 3 || !is_flat(terms[0]) || !is_flat(terms[1])) {
    return false;
  }
  const Operand first = add_operands(terms[0], terms[1]);
  return std::all_of(first.convex.begin(), first.convex.end(),
                     [](const Convex& part) {
                       return convex_hull(part.vertices).triangles.empty();
                     });
}

// The mesh of a convex part lies in it, and no deeper than its error, which is
// the other half: so what is convex always passes for that.
constexpr double kHullShare = 0.5;

// Returns the sum of all regions that are not empty; empty where the first one
// is, or all others are.
plane::Region add_regions(std::span<const plane::Region> regions) {
  plane::Region sum = regions[0];
  bool has_sum = regions.size() == 1;
  for (const plane::Region& region : regions.subspan(1)) {
    if (region.is_empty()) continue;
    sum = plane::add(sum, region);
    has_sum = true;
  }
  return has_sum ? sum : plane::Region{};
}

}  // namespace

Shape Lowerer::lower_op(const Minkowski&, const Place& at) {
  Lowerer apart = make_inner(at);
  // The errors of the terms add up.
  const auto shares =
      static_cast<double>(std::max<std::size_t>(at.node.children.size(), 1));
  apart.options_.chordal_error /= shares;
  apart.options_.chordal_error_of_parts /= shares;
  apart.options_.decimation /= shares;
  apart.options_.hull_share = kHullShare;
  const Operands operands =
      apart.lower_operands({at.node, Affine(1.0)}, {}, Dimension::kNone);
  report_strays(operands);
  switch (operands.dimension) {
    case Dimension::kNone:
      return {};
    case Dimension::kFlat:
      return {Dimension::kFlat, add_regions(operands.regions)};
    case Dimension::kSolid:
      break;
  }
  std::vector<Scene> solids = apart.take_scenes(operands.begins);
  std::erase_if(solids,
                [](const Scene& scene) { return scene.instances.empty(); });
  if (solids.empty()) return {};
  if (solids.size() == 1) {
    place_scene(solids[0], at.world);
    return {Dimension::kSolid, {}, operands.has_boolean};
  }
  std::vector<Operand> terms;
  terms.reserve(solids.size());
  for (const Scene& scene : solids) terms.push_back(make_operand(scene));
  std::erase_if(terms, [](const Operand& term) { return term.is_empty(); });
  if (terms.empty() || is_lost(terms)) return {};
  const Operand sum = add_terms(std::move(terms), at.node);
  place_sum(sum, at);
  return {Dimension::kSolid, {}, !sum.bodies.empty() || sum.convex.size() > 1};
}

Operand Lowerer::add_terms(std::vector<Operand> terms, const Node& node) {
  sort_for_sum(terms);
  Operand sum = std::move(terms[0]);
  for (std::size_t i = 1; i < terms.size(); ++i) {
    // Make bodies of what is a sum of surfaces so far.
    for (SurfacePair& pair : std::exchange(sum.pairs, {})) {
      Operand surfaces;
      surfaces.pairs.push_back(std::move(pair));
      Lowerer apart = make_inner({node, Affine(1.0)});
      apart.place_leaf(make_leaf(surfaces), {node, Affine(1.0)});
      const Scene scene = apart.take_scenes({0})[0];
      if (scene.instances.empty()) continue;
      Operand operand = make_operand(scene);
      std::move(operand.bodies.begin(), operand.bodies.end(),
                std::back_inserter(sum.bodies));
      std::move(operand.convex.begin(), operand.convex.end(),
                std::back_inserter(sum.convex));
    }
    sum = add_operands(std::move(sum), std::move(terms[i]));
  }
  return sum;
}

void Lowerer::place_sum(const Operand& sum, const Place& at) {
  for (const Body& body : sum.bodies) {
    Affine moved = at.world;
    moved[3] = at.world * Vec4(body.shift, 1);
    place_scene(*body.scene, moved);
  }
  place_leaf(make_leaf(sum), at);
}

// Takes the operands off the stack, each as a scene with all leaves.
std::vector<Scene> Lowerer::take_scenes(
    const std::vector<std::size_t>& begins) {
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    scenes.emplace_back();
    builder_.copy(begins[i],
                  i + 1 < begins.size() ? begins[i + 1] : builder_.mark(),
                  scenes.back());
  }
  const std::vector<Leaf> leaves = leaves_.take();
  for (Scene& scene : scenes) scene.leaves = leaves;
  return scenes;
}

}  // namespace lamina::csg
