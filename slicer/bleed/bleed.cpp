#include "slicer/bleed/bleed.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/parallel.h"
#include "base/text.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/boundary/move_scene.h"
#include "plane/region/boolean.h"
#include "plane/region/offset.h"
#include "slicer/check/print/pole.h"
#include "slicer/contour/layer.h"
#include "slicer/plan/orientation.h"
#include "slicer/slice/scene_parts.h"
#include "slicer/slice/slice.h"

namespace lamina::slicer {
namespace {

using plane::BooleanOp;
using plane::Region;

// The box around what may rise is larger than that, so that no faces tie [mm].
constexpr double kMargin = 1;

// What is lost at the rim of a slope is no wall: a face that looks down by 27°
// or more, from the horizontal, loses no more than so many depths at its rim.
constexpr double kRimDepths = 2;

// Of what is dilated, as a share of the distance.
constexpr double kArcShare = 0.05;

// All above a height, as far as a scene reaches.
csg::Leaf box_above(double height, const Box3& box) {
  const auto square = std::make_shared<const std::vector<Vec2>>(
      std::vector<Vec2>{{box.low.x - kMargin, box.low.y - kMargin},
                        {box.high.x + kMargin, box.low.y - kMargin},
                        {box.high.x + kMargin, box.high.y + kMargin},
                        {box.low.x - kMargin, box.high.y + kMargin}});
  csg::Leaf leaf;
  leaf.lofts.push_back(
      {square, {{1, height}, {1, std::max(height, box.high.z) + kMargin}}});
  leaf.is_convex = true;
  leaf.box = csg::bound_leaf(leaf, Affine(1.0));
  return leaf;
}

// A part without, or within, the places that light from above cures by mistake:
// those of (box − moved), with `moved` the whole scene moved up by the depth
// and the box all that is above the bed by more than that.
class BledScene {
 public:
  // op    kDifference: what is printed; kIntersection: what is left out
  // whole  the part and its supports
  BledScene(BooleanOp op, const csg::Scene& part, const csg::Scene& whole,
            double depth, double bed) {
    scene_.leaves = whole.leaves;
    scene_.program.emplace_back();
    const std::uint32_t bled = add_node(op, 0);
    // without_supports() keeps all leaves, so these are the part's, too.
    scene_.program[csg::add_operand(part, Affine(1.0), bled, 0, scene_)]
        .is_minuend = true;
    const std::uint32_t cured = add_node(BooleanOp::kDifference, bled);
    add_box(box_above(bed + depth, whole.box), cured, whole);
    Affine up(1.0);
    up[3].z = depth;
    csg::add_operand(whole, up, cured, 0, scene_);
    scene_.box = part.box;
  }

  // Adds what stays as it is.
  void add_beside(const csg::Scene& rest) {
    const auto leaves = static_cast<std::uint32_t>(scene_.leaves.size());
    scene_.leaves.insert(scene_.leaves.end(), rest.leaves.begin(),
                         rest.leaves.end());
    csg::add_operand(rest, Affine(1.0), 0, leaves, scene_);
    scene_.box.add(rest.box);
  }

  csg::Scene take() { return std::move(scene_); }

 private:
  std::uint32_t add_node(BooleanOp op, std::uint32_t parent) {
    const auto node = static_cast<std::uint32_t>(scene_.program.size());
    ++scene_.program[parent].child_count;
    scene_.program.push_back({op, parent, false, 0});
    return node;
  }

  // It points to the part's first line: the user has written no other.
  void add_box(csg::Leaf leaf, std::uint32_t parent, const csg::Scene& whole) {
    csg::Instance& box = scene_.instances.emplace_back();
    box.leaf = static_cast<std::uint32_t>(scene_.leaves.size());
    box.parent = parent;
    box.is_minuend = true;
    box.box = leaf.box;
    box.range = whole.instances.front().range;
    box.caller = whole.instances.front().caller;
    ++scene_.program[parent].child_count;
    scene_.leaves.push_back(std::move(leaf));
  }

  csg::Scene scene_;
};

Region subtract(const Region& region, const Region& other) {
  if (region.is_empty() || other.is_empty()) return region;
  const Region both[] = {region, other};
  return plane::subtract(both);
}

Region unite(const Region& region, const Region& other) {
  if (region.is_empty()) return other;
  if (other.is_empty()) return region;
  const Region both[] = {region, other};
  return plane::unite(both);
}

Region intersect(const Region& region, const Region& other) {
  if (region.is_empty() || other.is_empty()) return {};
  const Region both[] = {region, other};
  return plane::intersect(both);
}

Region grow(const Region& region, double amount) {
  if (region.is_empty()) return region;
  return plane::offset(region, amount, plane::Join::kRound,
                       kArcShare * std::abs(amount));
}

// Finds what is lower than the depth.
//
// A place of a layer is left out where no solid is a depth below it. It cures
// all the same if the solid goes on upwards, without a gap, to a layer that
// keeps the place. If not, a wall is lost there. And where a layer keeps what
// lies right below a place that is left out, a gap is there that will close.
class LossFinder {
 public:
  // whole     layers of the scene, ascending
  // left_out  layers of what is left out of it, at heights of these
  LossFinder(const std::vector<Layer>& whole,
             const std::vector<Layer>& left_out, double depth)
      : depth_(depth), layers_(whole), left_out_(whole.size()) {
    for (const Layer& layer : left_out) {
      const double thickness = layer.top - layer.bottom;
      const auto same = std::ranges::lower_bound(
          whole, layer.section_z - thickness / 2, {}, &Layer::section_z);
      if (same == whole.end()) continue;
      left_out_[static_cast<std::size_t>(same - whole.begin())] =
          plane::to_region(layer.contours);
    }
  }

  BleedLosses find_walls() const {
    // What ends below the layer above, whatever that has lost.
    const std::vector<Region> tops = of_each(
        [&](std::size_t i) { return subtract(left_out_[i], solid(i + 1)); });
    // From the top down, `lost` is what is lost in the layer above.
    std::vector<Region> all_lost(layers_.size());
    Region lost;
    for (std::size_t i = layers_.size(); i-- > 0;) {
      lost = unite(tops[i], intersect(left_out_[i], lost));
      all_lost[i] = lost;
    }
    // Leave out the rims of slopes.
    return measured(of_each([&](std::size_t i) {
      if (all_lost[i].is_empty()) return Region();
      const Region kept = subtract(solid(i), all_lost[i]);
      return subtract(all_lost[i], grow(kept, kRimDepths * depth_));
    }));
  }

  // Not below `lowest` [mm]: what is kept there the bed keeps.
  BleedLosses find_gaps(double lowest) const {
    return measured(of_each([&](std::size_t i) {
      if (i == 0 || left_out_[i].is_empty()) return Region();
      if (layers_[i - 1].section_z < lowest) return Region();
      const Region kept = subtract(solid(i - 1), left_out_[i - 1]);
      // Leave out the rims of holes.
      return grow(intersect(left_out_[i], kept), -depth_);
    }));
  }

 private:
  Region solid(std::size_t layer) const {
    return layer < layers_.size() ? plane::to_region(layers_[layer].contours)
                                  : Region();
  }

  template <typename Make>
  std::vector<Region> of_each(const Make& make) const {
    std::vector<Region> regions(layers_.size());
    for_each_index(layers_.size(),
                   [&](std::size_t i) { regions[i] = make(i); });
    return regions;
  }

  BleedLosses measured(const std::vector<Region>& regions) const {
    BleedLosses losses;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const double area = plane::area(regions[i]);
      if (area <= 0) continue;
      ++losses.layers;
      if (area <= losses.area) continue;
      losses.area = area;
      losses.place =
          Vec3(pole_of(plane::to_contours(regions[i])), layers_[i].section_z);
    }
    return losses;
  }

  const double depth_;
  const std::vector<Layer>& layers_;
  std::vector<Region> left_out_;  // as layers_
};

void warn(const BleedLosses& losses, std::string_view what, double depth,
          Diagnostics& diagnostics) {
  if (losses.layers == 0) return;
  diagnostics.own_warning(
      {}, fmt::format("light bleed: {} ({}; {:.4g} mm² around {})",
                      fmt::format(fmt::runtime(what), depth),
                      counted(losses.layers, "layer"), losses.area,
                      place_text(losses.place)));
}

}  // namespace

BleedReport compensate_bleed(csg::Scene& scene, double depth,
                             const Settings& settings,
                             Diagnostics& diagnostics) {
  BleedReport report;
  report.depth = depth;
  if (depth == 0 || scene.box.is_empty()) return report;
  const std::optional<csg::Scene> supports = supports_of(scene);
  const csg::Scene part = supports ? without_supports(scene) : scene;
  if (part.box.is_empty()) return report;
  const double bed = lowest_point(scene);
  csg::Scene left_out =
      BledScene(BooleanOp::kIntersection, part, scene, depth, bed).take();
  // Its layers are those of the whole.
  left_out.box = scene.box;
  const std::vector<Layer> whole = layers_or_none(scene, settings);
  const LossFinder finder(whole, layers_or_none(left_out, settings), depth);
  report.walls = finder.find_walls();
  report.gaps = finder.find_gaps(bed + depth);
  warn(report.walls, "walls lower than {:g} mm vanish", depth, diagnostics);
  warn(report.gaps, "gaps lower than {:g} mm will close", depth, diagnostics);
  BledScene bled(BooleanOp::kDifference, part, scene, depth, bed);
  if (supports) bled.add_beside(*supports);
  scene = bled.take();
  return report;
}

}  // namespace lamina::slicer
