#include "plane/region/boolean.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "plane/cascade/kinetic_ray.h"
#include "plane/chain_builder.h"
#include "plane/chains.h"
#include "plane/contours.h"
#include "plane/limits.h"
#include "plane/sweep/loop_resolver.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {
namespace {

// Edges nearer than this are one [mm], or nearer than what rounding does to the
// crossings of edges so far from the origin.
constexpr double kEdgeDistance = 3e-8;
constexpr double kRoundingErrors = 16;  // of a crossing, in units of epsilon

// Hardly a loop is too small: what one Boolean drops the next one misses, and a
// sliver that should have lost its tip is too long.
SweepOptions options(double reach) {
  const double rounding =
      kRoundingErrors * reach * std::numeric_limits<double>::epsilon();
  const double distance = std::max(kEdgeDistance, rounding);
  return {.tie_distance = distance, .least_area = distance * distance};
}

Region region_of(const Contours& contours) {
  require_corners(contours.points.size());
  return to_region(contours);
}

// The greatest coordinate of contours.
double reach_of(std::span<const Contour> contours) {
  double reach = 0;
  for (const Contour& contour : contours) {
    for (const Vec2 point : contour) {
      if (is_too_far(point.x) || is_too_far(point.y)) {
        fail_too_far();
      }
      reach = std::max({reach, std::abs(point.x), std::abs(point.y)});
    }
  }
  return reach;
}

// An operator, and the chains of its operands.
class Operands {
 public:
  explicit Operands(BooleanOp op) : program_(program_of(op, 0)) {
    block_.layer_count = 1;
    builder_.begin(block_);
  }

  void add(std::span<const Contour> contours, bool may_overlap_itself = false) {
    std::uint32_t& count = program_.nodes[0].child_count;
    Operand& operand = program_.operands.emplace_back();
    operand.is_minuend = count == 0;
    operand.may_overlap_itself = may_overlap_itself;
    for (const Contour& contour : contours) {
      for (const Vec2 point : contour) operand.box.add(point);
      builder_.loop() = contour;
      builder_.close_loop(0, count, 1);
    }
    ++count;
    reach_ = std::max(reach_, reach_of(contours));
  }

  Region evaluate() {
    builder_.finish(block_);
    Contours contours;
    KineticRay(program_, options(reach_)).sweep(block_, 0, contours);
    return region_of(contours);
  }

 private:
  BooleanProgram program_;
  ChainBuilder builder_;
  ChainBlock block_;
  double reach_ = 0;
};

Region evaluate(BooleanOp op, std::span<const Region> regions) {
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
  return evaluate(BooleanOp::kUnion, regions);
}

Region subtract(std::span<const Region> regions) {
  if (regions.size() <= 1) return unite(regions);
  return evaluate(BooleanOp::kDifference, regions);
}

Region intersect(std::span<const Region> regions) {
  if (regions.size() <= 1) return unite(regions);
  return evaluate(BooleanOp::kIntersection, regions);
}

Region clip(std::span<const Contour> contours, const Region& window) {
  Operands operands(BooleanOp::kIntersection);
  operands.add(contours, true);
  operands.add(window.contours);
  return operands.evaluate();
}

Region from_contours(std::span<const Contour> contours, FillRule rule) {
  Contours loops;
  for (const Contour& contour : contours) loops.add_loop(contour);
  LoopResolver(options(reach_of(contours)), rule).resolve(loops);
  return region_of(loops);
}

std::optional<Region> from_few_crossings(std::span<const Contour> contours,
                                         FillRule rule) {
  Contours loops;
  for (const Contour& contour : contours) loops.add_loop(contour);
  LoopResolver resolver(options(reach_of(contours)), rule);
  if (!resolver.resolve_few_crossings(loops)) return {};
  return region_of(loops);
}

}  // namespace lamina::plane
