#include "slicer/hollow/hollow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/text.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/boundary/move_scene.h"
#include "csg/minkowski/shell.h"
#include "plane/region/offset.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/contour/layer_solids.h"
#include "slicer/hollow/detail/cavities.h"
#include "slicer/hollow/detail/closing.h"
#include "slicer/hollow/detail/drains.h"
#include "slicer/slice/scene_parts.h"
#include "slicer/slice/slice.h"

namespace lamina::slicer {
namespace {

using detail::Cavity;

// What fills a cavity reaches into the wall by this [mm].
constexpr double kFillOverlap = 0.02;

// Of drains and plugs.
constexpr int kRodFacets = 32;

// A drain of the user's that is farther from all cavities than so many walls
// is a mistake.
constexpr double kFarDrain = 5;

double volume_of(const std::vector<Layer>& layers) {
  double volume = 0;
  for (const Layer& layer : layers) {
    volume += measure(layer.contours).area * (layer.top - layer.bottom);
  }
  return volume;
}

// The unit circle, shared by all rods.
std::shared_ptr<const std::vector<Vec2>> circle() {
  std::vector<Vec2> points;
  for (int i = 0; i < kRodFacets; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRodFacets;
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return std::make_shared<const std::vector<Vec2>>(std::move(points));
}

// A rod of diameter 1 and height 1 on the plane z = 0.
csg::Leaf make_rod() {
  csg::Leaf leaf;
  leaf.lofts.push_back({circle(), {{0.5, 0}, {0.5, 1}}});
  leaf.is_convex = true;
  leaf.box = csg::bound_leaf(leaf, Affine(1.0));
  return leaf;
}

// Takes the rod to a drain.
Affine place_of(const Drain& drain) {
  const Vec3 axis = drain.to - drain.from;
  const Vec3 up = glm::normalize(axis);
  const Vec3 aside = csg::perpendicular_to(up);
  return {drain.diameter * aside, drain.diameter * glm::cross(up, aside), axis,
          drain.from};
}

// A stack of prisms, one for each of the cavity's layers.
//
// overlap  how far they reach beyond the cavity [mm]
// extra    and above and below each layer [mm]
csg::Leaf stack_of(const Cavity& cavity, const std::vector<Layer>& layers,
                   double overlap, double extra) {
  csg::Leaf leaf;
  leaf.may_overlap_itself = true;
  for (const detail::CavityLayer& one : cavity.layers) {
    const Layer& layer = layers[one.layer];
    const plane::Region region =
        overlap == 0
            ? one.region
            : plane::offset(one.region, overlap, plane::Join::kMiter, overlap);
    for (const plane::Contour& contour : region.contours) {
      plane::Region alone{{contour}};
      const bool is_hole = plane::area(alone) < 0;
      std::vector<Vec2> outline = contour;
      if (is_hole) std::ranges::reverse(outline);
      leaf.lofts.push_back(
          {std::make_shared<const std::vector<Vec2>>(std::move(outline)),
           {{1, layer.bottom - extra}, {1, layer.top + extra}},
           false,
           is_hole});
    }
  }
  leaf.box = csg::bound_leaf(leaf, Affine(1.0));
  return leaf;
}

// What fills a cavity: into the wall, and beyond its ends, which may be between
// two sections.
csg::Leaf fill_of(const Cavity& cavity, const std::vector<Layer>& layers) {
  return stack_of(cavity, layers, kFillOverlap,
                  layers.front().top - layers.front().bottom);
}

// Builds the program of a hollow part, (hollow − drains) ∪ plugs, where hollow
// is part ∩ (shell ∪ fills) or part − cavities.
class HollowScene {
 public:
  HollowScene(const csg::Scene& part, csg::Leaf shell) : part_(part) {
    shell_ = add_leaf(std::move(shell));
    begin();
  }
  HollowScene(const csg::Scene& part, std::vector<csg::Leaf> cavities)
      : part_(part) {
    for (csg::Leaf& cavity : cavities) {
      carved_.push_back(add_leaf(std::move(cavity)));
    }
    begin();
  }

  void fill(csg::Leaf leaf) {
    place(add_leaf(std::move(leaf)), Affine(1.0), wall_);
  }

  void drill(const Drain& drain) { place(rod_, place_of(drain), kDrilled); }

  // What a drain takes away, a little narrower, standing upright at a place.
  void add_plug(const Drain& drain, Vec3 foot) {
    Drain rod = drain;
    rod.diameter -= kPlugPlay;
    rod.from += drain.diameter / 2 * glm::normalize(drain.to - drain.from);
    const Affine from_rod = place_of(rod);
    // Without the rod's sizes: a turn.
    const Affine turn = {glm::normalize(from_rod[0]),
                         glm::normalize(from_rod[1]),
                         glm::normalize(from_rod[2]), Vec3(0)};
    Affine motion = csg::inverse_of(turn);
    motion[3] = foot - motion * Vec4(rod.from, 0);
    const std::uint32_t plug = add_node(plane::BooleanOp::kIntersection, 0);
    scene_.program[add_hollow(plug, motion)].is_minuend = false;
    place(rod_, motion * Mat4(from_rod), plug);
    scene_.box.add(scene_.instances.back().box);
  }

  // Adds what is no part of the hollow one, without any Boolean.
  void add_beside(const csg::Scene& rest) {
    std::vector<std::uint32_t> names;
    for (const csg::Leaf& leaf : rest.leaves) names.push_back(add_leaf(leaf));
    for (csg::Instance instance : rest.instances) {
      instance.leaf = names[instance.leaf];
      instance.parent = 0;
      ++scene_.program[0].child_count;
      scene_.instances.push_back(instance);
    }
    scene_.box.add(rest.box);
  }

  csg::Scene take() { return std::move(scene_); }

 private:
  static constexpr std::uint32_t kDrilled = 1;

  void begin() {
    rod_ = add_leaf(make_rod());
    add_node(plane::BooleanOp::kUnion, 0);
    const std::uint32_t drilled = add_node(plane::BooleanOp::kDifference, 0);
    scene_.program[drilled].is_minuend = true;
    add_hollow(drilled, Affine(1.0));
    scene_.box = part_.box;
  }

  std::uint32_t add_leaf(csg::Leaf leaf) {
    scene_.leaves.push_back(std::move(leaf));
    return static_cast<std::uint32_t>(scene_.leaves.size() - 1);
  }

  std::uint32_t add_node(plane::BooleanOp op, std::uint32_t parent) {
    const auto node = static_cast<std::uint32_t>(scene_.program.size());
    if (node > 0) ++scene_.program[parent].child_count;
    scene_.program.push_back({op, parent, false, 0});
    return node;
  }

  // It points to the part's first line: the user has written no other.
  void place(std::uint32_t leaf, const Affine& matrix, std::uint32_t parent) {
    csg::Instance instance;
    instance.leaf = leaf;
    instance.parent = parent;
    instance.world_from_leaf = matrix;
    instance.box =
        csg::bound_leaf(scene_.leaves[leaf], matrix).shifted(matrix[3]);
    instance.range = part_.instances.front().range;
    instance.caller = part_.instances.front().caller;
    ++scene_.program[parent].child_count;
    scene_.instances.push_back(instance);
  }

  // The hollow part, moved. Returns the operator, its parent's minuend.
  std::uint32_t add_hollow(std::uint32_t parent, const Affine& motion) {
    const bool has_shell = shell_ != kNoLeaf;
    const std::uint32_t hollow =
        add_node(has_shell ? plane::BooleanOp::kIntersection
                           : plane::BooleanOp::kDifference,
                 parent);
    scene_.program[hollow].is_minuend = true;
    if (has_shell) {
      const std::uint32_t wall = add_node(plane::BooleanOp::kUnion, hollow);
      if (wall_ == 0) wall_ = wall;
      place(shell_, motion, wall);
    }
    for (const std::uint32_t leaf : carved_) place(leaf, motion, hollow);
    add_part(hollow, motion);
    return hollow;
  }

  void add_part(std::uint32_t parent, const Affine& motion) {
    if (leaves_ == kNoLeaf) {
      leaves_ = static_cast<std::uint32_t>(scene_.leaves.size());
      for (const csg::Leaf& leaf : part_.leaves) add_leaf(leaf);
    }
    const std::uint32_t part =
        csg::add_operand(part_, motion, parent, leaves_, scene_);
    scene_.program[part].is_minuend = true;
  }

  static constexpr std::uint32_t kNoLeaf = 0xffffffff;

  const csg::Scene& part_;
  csg::Scene scene_;
  std::uint32_t shell_ = kNoLeaf;
  std::vector<std::uint32_t> carved_;
  std::uint32_t rod_ = 0;
  std::uint32_t leaves_ = kNoLeaf;  // where the part's leaves begin
  std::uint32_t wall_ = 0;          // of the part itself
};

// What the shell leaves out of the part.
csg::Scene cavities_of(const csg::Scene& part, const csg::Leaf& shell) {
  csg::Scene rest;
  rest.leaves = part.leaves;
  rest.leaves.push_back(shell);
  rest.program.push_back({plane::BooleanOp::kDifference, 0, false, 1});
  rest.program[csg::add_operand(part, Affine(1.0), 0, 0, rest)].is_minuend =
      true;
  csg::Instance& wall = rest.instances.emplace_back();
  wall.leaf = static_cast<std::uint32_t>(part.leaves.size());
  wall.box = shell.box;
  rest.box = part.box;
  return rest;
}

double drain_diameter(const HollowSizes& sizes, const Box3& box) {
  if (sizes.drain_diameter > 0) return sizes.drain_diameter;
  const Vec3 size = box.size();
  return std::max({size.x, size.y, size.z}) <= kSmallPart ? kSmallDrain
                                                          : kLargeDrain;
}

// Which cavities stay, and the drains of each.
struct Plan {
  std::vector<bool> is_kept;  // as the cavities
  std::vector<Drain> drains;
};

Plan plan_drains(const std::vector<Cavity>& cavities, const LayerSolids& solids,
                 const HollowSizes& sizes, double diameter,
                 Diagnostics& diagnostics) {
  Plan plan;
  plan.is_kept.resize(cavities.size(), !sizes.has_drains);
  for (const DrainPlace& place : sizes.drains) {
    const auto nearest = detail::find_nearest(place.place, cavities, solids);
    if (nearest.distance > kFarDrain * sizes.wall + place.diameter) {
      diagnostics.own_warning(
          {}, fmt::format("the drain at {:g}, {:g}, {:g} is {:.3g} mm away "
                          "from the nearest cavity: it is left out",
                          place.place.x, place.place.y, place.place.z,
                          nearest.distance));
      continue;
    }
    plan.is_kept[nearest.cavity] = true;
    plan.drains.push_back(detail::drain_from(place, nearest.point));
  }
  if (!sizes.has_drains || !sizes.drains.empty()) return plan;
  for (std::size_t i = 0; i < cavities.size(); ++i) {
    if (!detail::has_room(cavities[i], diameter)) continue;
    plan.is_kept[i] = true;
    std::ranges::move(detail::choose_drains(cavities[i], solids, diameter),
                      std::back_inserter(plan.drains));
  }
  return plan;
}

// The part without the cavities that are kept.
HollowScene make_hollow(const csg::Scene& part, csg::Leaf shell,
                        const std::vector<Cavity>& cavities, const Plan& plan,
                        const std::vector<Layer>& layers,
                        const HollowSizes& sizes) {
  std::vector<csg::Leaf> stacks;
  for (std::size_t i = 0; i < cavities.size(); ++i) {
    if (sizes.closing > 0 && plan.is_kept[i]) {
      stacks.push_back(stack_of(cavities[i], layers, 0, 0));
    } else if (sizes.closing == 0 && !plan.is_kept[i]) {
      stacks.push_back(fill_of(cavities[i], layers));
    }
  }
  if (sizes.closing > 0) return {part, std::move(stacks)};
  HollowScene hollow(part, std::move(shell));
  for (csg::Leaf& fill : stacks) hollow.fill(std::move(fill));
  return hollow;
}

// The cavities' layers by their numbers among those of the part.
void number_layers(std::vector<Cavity>& cavities,
                   const std::vector<Layer>& hollow,
                   const std::vector<Layer>& layers) {
  for (Cavity& cavity : cavities) {
    for (detail::CavityLayer& one : cavity.layers) {
      const auto same = std::ranges::lower_bound(
          layers, hollow[one.layer].section_z - 1e-9, {}, &Layer::section_z);
      one.layer = static_cast<std::size_t>(same - layers.begin());
    }
  }
}

}  // namespace

HollowSizes HollowSizes::scaled(double factor) const {
  HollowSizes sizes = *this;
  sizes.wall *= factor;
  sizes.closing *= factor;
  sizes.drain_diameter *= factor;
  for (DrainPlace& drain : sizes.drains) drain.diameter *= factor;
  return sizes;
}

HollowReport hollow_out(csg::Scene& scene, const HollowSizes& sizes,
                        const Settings& settings, Diagnostics& diagnostics) {
  HollowReport report;
  const std::optional<csg::Scene> supports = supports_of(scene);
  const csg::Scene part = supports ? without_supports(scene) : scene;
  const std::vector<Layer> layers = layers_or_none(part, settings);
  if (layers.empty()) return report;
  report.solid_volume = volume_of(layers);
  csg::Leaf shell = csg::make_shell(part, sizes.wall + sizes.closing);
  std::vector<Layer> left_out =
      layers_or_none(cavities_of(part, shell), settings);
  if (sizes.closing > 0) {
    left_out = detail::dilate(left_out, layers, sizes.closing);
  }
  std::vector<Cavity> cavities = detail::find_cavities(left_out);
  number_layers(cavities, left_out, layers);
  if (cavities.empty()) {
    diagnostics.own_warning(
        {}, fmt::format("nothing is hollowed: no place is farther than {:g} mm "
                        "from the surface",
                        sizes.wall + sizes.closing));
    return report;
  }
  const double diameter = drain_diameter(sizes, part.box);
  const Plan plan =
      plan_drains(cavities, LayerSolids(layers), sizes, diameter, diagnostics);
  report.drains = plan.drains;
  report.cavities =
      static_cast<std::size_t>(std::ranges::count(plan.is_kept, true));
  report.filled = cavities.size() - report.cavities;
  if (report.cavities == 0) {
    diagnostics.own_warning(
        {}, fmt::format("nothing is hollowed: {} no drain of {:g} mm",
                        counted(cavities.size(), "cavity has", "cavities have"),
                        diameter));
    return report;
  }
  HollowScene hollow =
      make_hollow(part, std::move(shell), cavities, plan, layers, sizes);
  for (std::size_t i = 0; i < cavities.size(); ++i) {
    if (plan.is_kept[i]) report.saved_volume += cavities[i].volume;
  }
  for (const Drain& drain : plan.drains) hollow.drill(drain);
  if (supports) hollow.add_beside(*supports);
  if (sizes.has_plugs) {
    const double bed =
        supports ? std::min(supports->box.low.z, layers.front().bottom)
                 : layers.front().bottom;
    Vec3 foot(scene.box.high.x, scene.box.center().y, bed);
    for (const Drain& drain : plan.drains) {
      foot.x += kPlugDistance + drain.diameter / 2;
      hollow.add_plug(drain, foot);
      foot.x += drain.diameter / 2;
    }
  }
  scene = hollow.take();
  return report;
}

}  // namespace lamina::slicer
