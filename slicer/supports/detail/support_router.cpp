#include "slicer/supports/detail/support_router.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace lamina::slicer::detail {
namespace {

// A pillar that leans does so by 45°, and no farther than this [mm], in such
// steps.
constexpr double kFarthest = 12;
constexpr double kSidestep = 0.5;

// Shorter heads are blunt [mm].
constexpr double kShortestHead = 0.75;

Vec2 flat(Vec3 place) { return {place.x, place.y}; }

}  // namespace

SupportRouter::SupportRouter(const LayerSolids& solids,
                             const SupportSizes& sizes, double bed)
    : solids_(solids), sizes_(sizes), bed_(bed) {}

// Next to its tip a head may come as near to the part as it is far from the
// tip.
bool SupportRouter::is_free(const Rod& rod) const {
  const double rise = rod.top.z - rod.bottom.z;
  if (!(rise > 0)) return false;
  const bool is_head = rod.top_diameter < rod.bottom_diameter;
  const bool is_tail = rod.top_diameter > rod.bottom_diameter;
  // Leaning rods are wider in a layer than across.
  const double slope = glm::distance(rod.top, rod.bottom) / rise;
  // The balls at the ends reach beyond them, but for a tip.
  const double top = rod.top.z + (is_head ? 0 : rod.top_diameter / 2);
  const double bottom = rod.bottom.z - (is_tail ? 0 : rod.bottom_diameter / 2);
  for (std::size_t i = solids_.layer_above(bottom);
       i < solids_.count() && solids_.layer(i).bottom < top; ++i) {
    const double z = solids_.layer(i).section_z;
    const double share = std::clamp((rod.top.z - z) / rise, 0.0, 1.0);
    const Vec3 place = rod.top + share * (rod.bottom - rod.top);
    const double radius =
        (rod.top_diameter + share * (rod.bottom_diameter - rod.top_diameter)) /
        2 * slope;
    double clearance = sizes_.clearance;
    if (is_head || is_tail) {
      const double from_tip = is_head ? rod.top.z - z : z - rod.bottom.z;
      if (from_tip < sizes_.tip) continue;
      clearance = std::min(clearance, (from_tip - sizes_.tip) / 2);
    }
    if (!solids_.is_free(i, flat(place), radius + clearance)) return false;
  }
  return true;
}

bool SupportRouter::is_free_below(Vec3 place) const {
  return is_free(
      {place, Vec3(flat(place), bed_), sizes_.pillar, sizes_.pillar});
}

std::optional<Support> SupportRouter::route(const Contact& contact) const {
  for (double length = sizes_.head; length >= kShortestHead; length /= 1.5) {
    if (auto support = with_head(contact, contact.away, length)) return support;
    for (const double slope : {0.0, 0.5, 1.0}) {
      for (int k = 0; k < (slope == 0 ? 1 : kSides); ++k) {
        const Vec3 away = glm::normalize(Vec3(slope * side(k), -1));
        if (auto support = with_head(contact, away, length)) return support;
      }
    }
  }
  return std::nullopt;
}

std::optional<Support> SupportRouter::with_head(const Contact& contact,
                                                Vec3 away,
                                                double length) const {
  Support support;
  support.contact = contact.place;
  const Vec3 end = contact.place + away * length;
  if (!is_free({contact.place, end, sizes_.tip, sizes_.pillar})) {
    return std::nullopt;
  }
  support.path = {contact.place - away * sizes_.penetration, end};
  if (add_way_to_bed(support) || add_way_to_part(support)) return support;
  return std::nullopt;
}

bool SupportRouter::add_way_to_bed(Support& support) const {
  const Vec3 from = support.path.back();
  const double lowest = bed_ + sizes_.foot_height;
  if (from.z <= lowest) return false;
  if (is_free_below(from)) {
    support.path.emplace_back(flat(from), lowest);
    return true;
  }
  for (double distance = kSidestep; distance <= kFarthest;
       distance += kSidestep) {
    if (from.z - distance <= lowest) return false;
    for (int k = 0; k < kSides; ++k) {
      const Vec3 bend(flat(from) + distance * side(k), from.z - distance);
      if (!is_free_below(bend) ||
          !is_free({from, bend, sizes_.pillar, sizes_.pillar})) {
        continue;
      }
      support.path.push_back(bend);
      support.path.emplace_back(flat(bend), lowest);
      return true;
    }
  }
  return false;
}

// Straight down to the first layer that is in the way, where a tip can stand.
bool SupportRouter::add_way_to_part(Support& support) const {
  const Vec3 from = support.path.back();
  for (std::size_t i = solids_.layer_above(from.z); i-- > 0;) {
    if (solids_.depth(i, flat(from)) < sizes_.tip / 2) continue;
    const double top = solids_.layer(i).top;
    const double length = std::min(sizes_.head, (from.z - top) / 2);
    if (length < kShortestHead / 2) return false;
    const Vec3 neck(flat(from), top + length);
    const Vec3 tip(flat(from), top);
    if (!is_free({from, neck, sizes_.pillar, sizes_.pillar}) ||
        !is_free({neck, tip, sizes_.pillar, sizes_.tip})) {
      return false;
    }
    support.stands_on_part = true;
    support.path.push_back(neck);
    support.path.push_back(tip - Vec3(0, 0, sizes_.penetration));
    return true;
  }
  return false;
}

}  // namespace lamina::slicer::detail
