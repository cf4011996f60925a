#include "slicer/supports/detail/support_router.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include <glm/geometric.hpp>

namespace lamina::slicer::detail {
namespace {

// A pillar that leans does so by 45°, and no farther than this [mm], in such
// steps.
constexpr double kFarthestLean = 12;
constexpr double kSidestep = 0.5;

// Shorter heads are blunt [mm].
constexpr double kShortestHead = 0.75;

}  // namespace

Support image_of(Support support, const Isometry& symmetry) {
  support.contact = moved(symmetry, support.contact);
  for (Vec3& place : support.path) place = moved(symmetry, place);
  return support;
}

bool has_same_way(const Support& a, const Support& b) {
  constexpr double kSame = 1e-3;  // [mm]
  return std::ranges::equal(a.path, b.path, [](Vec3 one, Vec3 other) {
    return glm::distance(one, other) < kSame;
  });
}

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
      const double tip = std::min(rod.top_diameter, rod.bottom_diameter);
      const double from_tip = is_head ? rod.top.z - z : z - rod.bottom.z;
      if (from_tip < tip) continue;
      clearance = std::min(clearance, (from_tip - tip) / 2);
    }
    if (!solids_.is_free(i, Vec2(place), radius + clearance)) return false;
  }
  return true;
}

bool SupportRouter::is_free_below(Vec3 place) const {
  return is_free(
      {place, Vec3(Vec2(place), bed_), sizes_.pillar, sizes_.pillar});
}

bool SupportRouter::is_free(const Support& support) const {
  const std::vector<Vec3>& path = support.path;
  if (!is_free({support.contact, path[1], support.tip, sizes_.pillar})) {
    return false;
  }
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const bool is_last = i + 2 == path.size();
    Rod rod = {path[i], path[i + 1], sizes_.pillar, sizes_.pillar};
    if (is_last && support.end == SupportEnd::kPart) {
      rod.bottom.z += support.depth;
      rod.bottom_diameter = support.tip;
    } else if (is_last && support.end == SupportEnd::kFoot) {
      rod.bottom.z = bed_;
    }
    if (!is_free(rod)) return false;
  }
  return true;
}

std::optional<Support> SupportRouter::route(const Contact& contact) const {
  if (!contact.sides.empty()) {
    if (auto support = route(contact, contact.sides, false)) return support;
  }
  std::array<Vec2, kSides> all;
  for (int k = 0; k < kSides; ++k) all[static_cast<std::size_t>(k)] = side(k);
  // Those first to which the part's surface faces.
  std::ranges::stable_sort(all, std::greater<>(), [&](Vec2 side) {
    return std::round(1e6 * glm::dot(side, Vec2(contact.away)));
  });
  if (auto support = route(contact, all, false)) return support;
  return route(contact, all, true);
}

std::optional<Support> SupportRouter::route(const Contact& contact,
                                            std::span<const Vec2> sides,
                                            bool may_land) const {
  for (double length = sizes_.head; length >= kShortestHead; length /= 1.5) {
    if (auto support =
            with_head(contact, contact.away, length, sides, may_land)) {
      return support;
    }
    for (const double slope : {0.0, 0.5, 1.0}) {
      for (const Vec2 side : slope == 0 ? sides.first(1) : sides) {
        const Vec3 away = glm::normalize(Vec3(slope * side, -1));
        if (auto support = with_head(contact, away, length, sides, may_land)) {
          return support;
        }
      }
    }
  }
  return std::nullopt;
}

std::optional<Support> SupportRouter::with_head(const Contact& contact,
                                                Vec3 away, double length,
                                                std::span<const Vec2> sides,
                                                bool may_land) const {
  Support support;
  support.contact = contact.place;
  support.tip = contact.tip;
  const Vec3 end = contact.place + away * length;
  if (!is_free({contact.place, end, contact.tip, sizes_.pillar})) {
    return std::nullopt;
  }
  support.depth = depth_of(contact, away);
  support.path = {contact.place - away * support.depth, end};
  if (add_way_to_bed(support, sides) ||
      (may_land && add_way_to_part(support))) {
    return support;
  }
  return std::nullopt;
}

// How deep a tip goes: half of its diameter, and no deeper than half of the
// part above it.
double SupportRouter::depth_of(const Contact& contact, Vec3 away) const {
  const double rise = -away.z;
  const double wanted = contact.tip / 2;
  for (std::size_t i = solids_.layer_above(contact.place.z);; ++i) {
    const bool is_above = i == solids_.count();
    const double top =
        is_above ? solids_.layer(i - 1).top : solids_.layer(i).bottom;
    const double length = (top - contact.place.z) / rise;
    if (length >= 2 * wanted) return wanted;
    if (is_above ||
        (length > 0 &&
         solids_.depth(i, Vec2(contact.place - away * length)) <= 0)) {
      return length / 2;
    }
  }
}

bool SupportRouter::add_way_to_bed(Support& support,
                                   std::span<const Vec2> sides) const {
  const Vec3 from = support.path.back();
  const double lowest = bed_ + sizes_.foot_height;
  if (from.z <= lowest) return false;
  if (is_free_below(from)) {
    support.path.emplace_back(Vec2(from), lowest);
    return true;
  }
  for (double distance = kSidestep; distance <= kFarthestLean;
       distance += kSidestep) {
    if (from.z - distance <= lowest) return false;
    for (const Vec2 side : sides) {
      const Vec3 bend(Vec2(from) + distance * side, from.z - distance);
      if (!is_free_below(bend) ||
          !is_free({from, bend, sizes_.pillar, sizes_.pillar})) {
        continue;
      }
      support.path.push_back(bend);
      support.path.emplace_back(Vec2(bend), lowest);
      return true;
    }
  }
  return false;
}

// Straight down to the first layer that is in the way, where a tip can stand.
bool SupportRouter::add_way_to_part(Support& support) const {
  const Vec3 from = support.path.back();
  for (std::size_t i = solids_.layer_above(from.z); i-- > 0;) {
    if (solids_.depth(i, Vec2(from)) < support.tip / 2) continue;
    const double top = solids_.layer(i).top;
    const double length = std::min(sizes_.head, (from.z - top) / 2);
    if (length < kShortestHead / 2) return false;
    const Vec3 neck(Vec2(from), top + length);
    const Vec3 tip(Vec2(from), top);
    if (!is_free({from, neck, sizes_.pillar, sizes_.pillar}) ||
        !is_free({neck, tip, sizes_.pillar, support.tip})) {
      return false;
    }
    support.end = SupportEnd::kPart;
    support.path.push_back(neck);
    support.path.push_back(tip - Vec3(0, 0, support.depth));
    return true;
  }
  return false;
}

std::vector<Brace> SupportRouter::find_braces(
    std::span<const Support> supports) const {
  // Of pillars that stand on the bed [mm].
  constexpr double kTall = 15;
  constexpr double kVeryTall = 35;
  constexpr double kLongest = 10;
  // Neighbours whose distances differ by less are equally near.
  constexpr double kSameDistance = 1e-3;

  struct Pillar {
    Vec2 place;
    double height;  // above the bed
  };
  std::vector<Pillar> pillars;
  for (const Support& support : supports) {
    if (support.end != SupportEnd::kFoot) continue;
    const Vec3 top = support.pillar_top();
    pillars.push_back({Vec2(top), top.z - bed_});
  }
  std::set<std::pair<std::size_t, std::size_t>> neighbours;
  for (std::size_t i = 0; i < pillars.size(); ++i) {
    if (pillars[i].height <= kTall) continue;
    double nearest = kLongest;
    const auto distance_to = [&](std::size_t k) {
      const double distance = glm::distance(pillars[i].place, pillars[k].place);
      const double common = std::min(pillars[i].height, pillars[k].height);
      const bool fits = k != i && distance > 2 * sizes_.pillar &&
                        common > 2 * distance + sizes_.foot_height;
      return fits ? distance : kLongest + 1;
    };
    for (std::size_t k = 0; k < pillars.size(); ++k) {
      nearest = std::min(nearest, distance_to(k));
    }
    for (std::size_t k = 0; k < pillars.size(); ++k) {
      if (distance_to(k) > std::min(nearest + kSameDistance, kLongest))
        continue;
      neighbours.insert(std::minmax(i, k));
    }
  }
  std::vector<Brace> braces;
  for (const auto& [i, k] : neighbours) {
    const Pillar& a = pillars[i];
    const Pillar& b = pillars[k];
    const double half = glm::distance(a.place, b.place) / 2;
    const double height = std::min(a.height, b.height);
    const int count = height > kVeryTall ? 2 : 1;
    for (int n = 1; n <= count; ++n) {
      const double middle = bed_ + height * n / (count + 1);
      for (const auto& [high, low] : {std::pair(a, b), std::pair(b, a)}) {
        const Vec3 top(high.place, middle + half);
        const Vec3 bottom(low.place, middle - half);
        if (!is_free({top, bottom, sizes_.brace, sizes_.brace})) continue;
        braces.push_back({top, bottom});
      }
    }
  }
  return braces;
}

}  // namespace lamina::slicer::detail
