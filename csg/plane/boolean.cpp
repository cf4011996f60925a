#include "csg/plane/boolean.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "csg/limits.h"
#include "csg/scene.h"
#include "ldni/section/chain_builder.h"
#include "ldni/section/chains.h"
#include "ldni/section/contours.h"
#include "ldni/sweep/kinetic_ray.h"
#include "ldni/sweep/loop_resolver.h"
#include "ldni/sweep/sweep_options.h"

namespace lamina::planar {
namespace {

// Edges nearer than this are one [mm], or nearer than what rounding does to the
// crossings of edges so far from the origin.
constexpr double kEdgeDistance = 3e-8;
constexpr double kRoundingErrors = 16;  // of a crossing, in units of epsilon

// Hardly a loop is too small: what one Boolean drops the next one misses, and a
// needle that should have lost its tip is too long.
ldni::SweepOptions options(double reach) {
  const double rounding =
      kRoundingErrors * reach * std::numeric_limits<double>::epsilon();
  const double distance = std::max(kEdgeDistance, rounding);
  return {.tie_distance = distance, .least_area = distance * distance};
}

Region region_of(const ldni::Contours& contours) {
  csg::require_corners(contours.points.size());
  return to_region(contours);
}

// The greatest coordinate of contours.
double reach_of(std::span<const Contour> contours) {
  double reach = 0;
  for (const Contour& contour : contours) {
    for (const Vec2 point : contour) {
      if (csg::is_too_far(point.x) || csg::is_too_far(point.y)) {
        csg::fail_too_far();
      }
      reach = std::max({reach, std::abs(point.x), std::abs(point.y)});
    }
  }
  return reach;
}

// The operands of an operator as instances of a scene: the ray wants to know no
// more of them than their boxes and whether they may overlap themselves.
class Operands {
 public:
  explicit Operands(csg::BooleanOp op) {
    scene_.leaves.resize(2);
    scene_.leaves[1].may_overlap_itself = true;
    scene_.program.push_back({op, 0, false, 0});
    block_.layer_count = 1;
    builder_.begin(block_);
  }

  void add(std::span<const Contour> contours, bool may_overlap_itself = false) {
    csg::Instance& operand = scene_.instances.emplace_back();
    operand.leaf = may_overlap_itself ? 1 : 0;
    operand.is_minuend = scene_.program[0].child_count == 0;
    for (const Contour& contour : contours) {
      for (const Vec2 point : contour) operand.box.add(Vec3(point, 0));
      builder_.loop() = contour;
      builder_.close_loop(0, scene_.program[0].child_count, 1);
    }
    ++scene_.program[0].child_count;
    reach_ = std::max(reach_, reach_of(contours));
  }

  Region evaluate() {
    builder_.finish(block_);
    ldni::Contours contours;
    ldni::KineticRay(scene_, options(reach_)).sweep(block_, 0, contours);
    return region_of(contours);
  }

 private:
  csg::Scene scene_;
  ldni::ChainBuilder builder_;
  ldni::ChainBlock block_;
  double reach_ = 0;
};

Region evaluate(csg::BooleanOp op, std::span<const Region> regions) {
  Operands operands(op);
  for (const Region& region : regions) operands.add(region.contours);
  return operands.evaluate();
}

}  // namespace

void require_near(std::span<const Region> regions) {
  for (const Region& region : regions) reach_of(region.contours);
}

Region unite(std::span<const Region> regions) {
  if (regions.empty()) return {};
  if (regions.size() == 1) return regions[0];
  return evaluate(csg::BooleanOp::kUnion, regions);
}

Region subtract(std::span<const Region> regions) {
  if (regions.size() <= 1) return unite(regions);
  return evaluate(csg::BooleanOp::kDifference, regions);
}

Region intersect(std::span<const Region> regions) {
  if (regions.size() <= 1) return unite(regions);
  return evaluate(csg::BooleanOp::kIntersection, regions);
}

Region clip(std::span<const Contour> contours, const Region& window) {
  Operands operands(csg::BooleanOp::kIntersection);
  operands.add(contours, true);
  operands.add(window.contours);
  return operands.evaluate();
}

Region from_contours(std::span<const Contour> contours, FillRule rule) {
  ldni::Contours loops;
  for (const Contour& contour : contours) loops.add_loop(contour);
  ldni::LoopResolver(options(reach_of(contours)), rule).resolve(loops);
  return region_of(loops);
}

std::optional<Region> from_few_crossings(std::span<const Contour> contours,
                                         FillRule rule) {
  ldni::Contours loops;
  for (const Contour& contour : contours) loops.add_loop(contour);
  ldni::LoopResolver resolver(options(reach_of(contours)), rule);
  if (!resolver.resolve_few_crossings(loops)) return {};
  return region_of(loops);
}

}  // namespace lamina::planar
