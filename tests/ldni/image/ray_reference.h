#pragma once
// What a ray must see, by a way that shares nothing with the moving ray: the
// scanline sampler cuts faces, not loops, and each ray is evaluated alone.

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/contours.h"

namespace lamina::ldni {

// A stretch of a ray inside the solid.
struct Range {
  double enter;
  double exit;
  bool operator==(const Range&) const = default;
};
inline std::ostream& operator<<(std::ostream& out, const Range& range) {
  return out << "[" << range.enter << ", " << range.exit << ")";
}
using Ranges = std::vector<Range>;

// Ranges of the scene's result along +y at one x (within 1e-12 mm of `x`,
// which is set to the ray's), for every layer.
std::vector<Ranges> evaluate_layers(const csg::Scene& scene,
                                    const LayerGrid& layers, double& x);

// Ranges between the loops, and between the chains of one instance (where
// their winding number is not 0).
Ranges cut_contours(const plane::Contours& contours, double x);
Ranges cut_chains(const plane::ChainBlock& block, std::uint32_t layer,
                  std::uint32_t instance, double x);

// Greatest distance [mm] by which results may differ: ties in y, ties in x
// and what rounding adds where planes almost coincide.
inline constexpr double kAllowedDistance = 3e-6;

// Whether two results agree on the ray at x in one layer. Where they differ
// over more than kAllowedDistance in y, a place nearer than that in x must
// have the one result's value in the other: then something thinner than that
// is all that differs.
//
// near_result  ranges of the first result at other x of the same layer
// returns      what is wrong; empty if they agree
using RangesAt = std::function<Ranges(double x)>;
std::string compare_ranges(const Ranges& result, const Ranges& expected,
                           double x, const RangesAt& near_result,
                           const RangesAt& near_expected);

}  // namespace lamina::ldni
