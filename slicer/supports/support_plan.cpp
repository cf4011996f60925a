#include "slicer/supports/support_plan.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "slicer/supports/detail/contact_finder.h"
#include "slicer/supports/detail/layer_solids.h"
#include "slicer/supports/detail/support_router.h"

namespace lamina::slicer {

double hold_radius(double tip, double height) {
  // Of a tip of 0.4 mm: heights and radii, as PrusaSlicer 2.9 has them.
  constexpr double kTip = 0.4;
  constexpr std::array<std::pair<double, double>, 4> kCurve = {
      {{0, 3.2}, {3.9, 4}, {15, 5}, {40, 6}}};
  const double scale = tip / kTip;
  const auto above = std::ranges::upper_bound(
      kCurve, height, {}, [](const auto& point) { return point.first; });
  if (above == kCurve.begin()) return scale * kCurve.front().second;
  if (above == kCurve.end()) return scale * kCurve.back().second;
  const auto& [low, radius] = *std::prev(above);
  const double share = (height - low) / (above->first - low);
  return scale * (radius + share * (above->second - radius));
}

std::size_t SupportPlan::count_on_part() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(supports, &Support::stands_on_part));
}

std::string size_text(const SupportPlan& plan) {
  const std::size_t on_part = plan.count_on_part();
  return counted(plan.supports.size(), "support") +
         (on_part > 0 ? fmt::format(", {} of them on the part", on_part) : "");
}

SupportPlan plan_supports(std::span<const Layer> layers,
                          const SupportSizes& sizes) {
  SupportPlan plan;
  plan.sizes = sizes;
  // An outline has no height.
  if (layers.empty() || !(layers.front().bottom < layers.front().top)) {
    return plan;
  }
  plan.bed = layers.front().bottom - sizes.lift;
  const detail::LayerSolids solids(layers);
  const detail::SupportRouter router(solids, plan.sizes, plan.bed);
  for (const detail::Contact& contact :
       detail::find_contacts(solids, plan.sizes)) {
    if (auto support = router.route(contact)) {
      plan.supports.push_back(std::move(*support));
    } else if (contact.is_needed) {
      plan.unheld.push_back(contact.place);
    }
  }
  return plan;
}

}  // namespace lamina::slicer
