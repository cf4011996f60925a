#include "slicer/supports/support_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/diagnostic.h"
#include "base/text.h"
#include "slicer/supports/detail/contact_finder.h"
#include "slicer/supports/detail/marked_places.h"
#include "slicer/supports/detail/support_router.h"
#include "slicer/supports/detail/support_trees.h"
#include "slicer/supports/detail/symmetry.h"

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
      std::ranges::count(supports, SupportEnd::kPart, &Support::end));
}

double SupportPlan::volume() const {
  double volume = 0;
  const auto add_rod = [&](Vec3 from, Vec3 to, double d1, double d2) {
    volume += std::numbers::pi / 12 * glm::length(to - from) *
              (d1 * d1 + d1 * d2 + d2 * d2);
  };
  for (const Support& support : supports) {
    for (std::size_t i = 0; i + 1 < support.path.size(); ++i) {
      add_rod(support.path[i], support.path[i + 1],
              i == 0 ? support.tip : sizes.pillar, sizes.pillar);
    }
    if (support.end != SupportEnd::kFoot) continue;
    const Vec3 foot = support.path.back();
    add_rod(foot, foot - Vec3(0, 0, sizes.foot_height), sizes.pillar,
            sizes.foot);
  }
  for (const Brace& brace : braces) {
    add_rod(brace[0], brace[1], sizes.brace, sizes.brace);
  }
  return volume;
}

double SupportPlan::contact_area() const {
  double area = 0;
  for (const Support& support : supports) {
    const double disk = std::numbers::pi / 4 * support.tip * support.tip;
    area += support.end == SupportEnd::kPart ? 2 * disk : disk;
  }
  return area;
}

std::string size_text(const SupportPlan& plan) {
  const std::size_t on_part = plan.count_on_part();
  return counted(plan.supports.size(), "support") +
         (on_part > 0 ? fmt::format(", {} of them on the part", on_part) : "");
}

namespace {

// Of those that touch the part with their tips only.
std::vector<Support> images_of(const std::vector<Support>& supports,
                               const detail::Isometry& symmetry,
                               const detail::SupportRouter& router) {
  std::vector<Support> images;
  for (const Support& support : supports) {
    Support image = detail::image_of(support, symmetry);
    if (router.is_free(image)) images.push_back(std::move(image));
  }
  return images;
}

// The support of a contact; and its images, where symmetries leave the contact
// as it is but not the way down.
std::vector<Support> route(const detail::SupportRouter& router,
                           const detail::Contact& contact,
                           std::span<const detail::Isometry> symmetries) {
  auto support = router.route(contact);
  if (!support) return {};
  std::vector<Support> all = {std::move(*support)};
  for (const detail::Isometry& symmetry : symmetries) {
    Support image = detail::image_of(all.front(), symmetry);
    const bool is_new =
        glm::distance(image.contact, all.front().contact) < contact.tip / 4 &&
        std::ranges::none_of(all, [&](const Support& other) {
          return detail::has_same_way(image, other);
        });
    if (is_new && router.is_free(image)) all.push_back(std::move(image));
  }
  return all;
}

// Throws where the part is wider than any resin printer builds: its places
// would take minutes.
void require_size(std::span<const Layer> layers) {
  constexpr double kWidest = 500;  // [mm]
  Box2 box;
  for (const Layer& layer : layers) {
    box.add(std::span<const Vec2>(layer.contours.points));
  }
  if (box.is_empty()) return;
  const Vec2 size = box.size();
  if (size.x <= kWidest && size.y <= kWidest) return;
  throw GeometryError(fmt::format(
      "The design is {:.4g} x {:.4g} mm, too wide for supports: at most {:g}",
      size.x, size.y, kWidest));
}

// Where the bed is, so that the part keeps its layers.
double bed_below(const Layer& first, double lift) {
  constexpr double kRounding = 1e-6;  // of layers
  const double thickness = first.top - first.bottom;
  return first.bottom - thickness * std::ceil(lift / thickness - kRounding);
}

}  // namespace

SupportPlan plan_supports(std::span<const Layer> layers,
                          const SupportSizes& sizes,
                          std::span<const MarkedSolid> marked) {
  SupportPlan plan;
  plan.sizes = sizes;
  // An outline has no height.
  if (layers.empty() || !(layers.front().bottom < layers.front().top)) {
    return plan;
  }
  require_size(layers);
  plan.bed = bed_below(layers.front(), sizes.lift);
  const LayerSolids solids(layers);
  std::vector<detail::MarkedPlaces> places;
  for (const MarkedSolid& one : marked) {
    places.push_back({one.tip, LayerSolids(one.layers)});
  }
  const auto symmetries = detail::find_symmetries(solids, places);
  detail::FoundContacts found =
      detail::find_contacts(solids, plan.sizes, places, symmetries);
  plan.unwanted = std::move(found.unwanted);
  const detail::SupportRouter router(solids, plan.sizes, plan.bed);
  std::vector<std::vector<Support>> supports;  // of each contact
  for (const detail::Contact& contact : found.contacts) {
    std::vector<Support> own;
    if (contact.symmetry == 0) {
      own = route(router, contact, symmetries);
    } else {
      own = images_of(supports[contact.original], symmetries[contact.symmetry],
                      router);
      if (own.empty()) own = route(router, contact, {});
    }
    if (own.empty() && contact.is_needed) {
      plan.unheld.push_back(contact.place);
    }
    supports.push_back(std::move(own));
  }
  for (std::vector<Support>& own : supports) {
    std::ranges::move(own, std::back_inserter(plan.supports));
  }
  detail::merge_pillars(symmetries, router, plan.sizes, plan.bed,
                        plan.supports);
  plan.braces = router.find_braces(plan.supports);
  return plan;
}

}  // namespace lamina::slicer
