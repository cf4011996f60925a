#include "slicer/supports/detail/contact_finder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/check/print/layer_overlay.h"
#include "slicer/check/print/pole.h"
#include "slicer/supports/detail/wish_cover.h"

namespace lamina::slicer::detail {
namespace {

// Contours are asked every so many mm, and ledges that reach out farther than
// kWideLedge on a grid of kGrid.
constexpr double kStep = 0.5;
constexpr double kWideLedge = 1.5;
constexpr double kGrid = 0.5;

// Beyond this many candidates only some are tried, because each takes a few
// hundred bytes with its images.
constexpr std::size_t kMostCandidates = 100'000;

// A place that a symmetry moves by less stays where it is [mm].
constexpr double kFixed = 1e-6;

// A region of a layer: an outer loop and its holes.
plane::Contours region_of(const plane::Contours& contours,
                          const LayerOverlay& overlay, std::uint32_t outer) {
  plane::Contours region;
  region.add_loop(contours.loop(outer));
  for (std::uint32_t i = 0; i < contours.loop_count(); ++i) {
    if (overlay.around[i] == outer) region.add_loop(contours.loop(i));
  }
  return region;
}

// The direction in which a region is longest, by its second moments: it turns
// with the region. Of a region as broad as it is long, that of x.
Vec2 long_axis(const plane::Contours& region) {
  constexpr double kRound = 0.02;  // share by which moments must differ
  double area = 0;
  Vec2 first(0);
  Vec3 second(0);  // xx, xy, yy
  const Vec2 origin = region.points.front();
  for (std::size_t l = 0; l < region.loop_count(); ++l) {
    const auto loop = region.loop(l);
    Vec2 a = loop.back() - origin;
    for (const Vec2& point : loop) {
      const Vec2 b = point - origin;
      const double cross = a.x * b.y - a.y * b.x;
      area += cross / 2;
      first += cross / 6 * (a + b);
      second += cross / 24 *
                Vec3(2 * (a.x * a.x + a.x * b.x + b.x * b.x),
                     2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y,
                     2 * (a.y * a.y + a.y * b.y + b.y * b.y));
      a = b;
    }
  }
  const Vec2 middle = first / area;
  const double xx = second.x - middle.x * first.x;
  const double xy = second.y - middle.x * first.y;
  const double yy = second.z - middle.y * first.y;
  if (!(std::hypot(xx - yy, 2 * xy) > kRound * (xx + yy))) return {1, 0};
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  // Rounding must not turn what lies along an axis.
  constexpr double kSteps = 1e6;
  const double rounded = std::round(angle * kSteps) / kSteps;
  return {std::cos(rounded), std::sin(rounded)};
}

// The box of a region in the frame of an axis.
Box2 box_along(const plane::Contours& region, Vec2 axis) {
  Box2 box;
  for (const Vec2& point : region.points) {
    box.add(Vec2(glm::dot(point, axis), point.y * axis.x - point.x * axis.y));
  }
  return box;
}

// From the frame of an axis.
Vec2 from_frame(Vec2 place, Vec2 axis) {
  return place.x * axis + place.y * Vec2(-axis.y, axis.x);
}

// Points along closed loops, no farther from each other than kStep.
template <typename Visit>
void visit_outline(std::span<const Vec2> loop, const Visit& visit) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 from = loop[i];
    const Vec2 along = loop[(i + 1) % loop.size()] - from;
    const auto steps =
        static_cast<std::size_t>(std::ceil(glm::length(along) / kStep));
    for (std::size_t k = 0; k < steps; ++k) {
      visit(from +
            along * (static_cast<double>(k) / static_cast<double>(steps)));
    }
  }
}

class Finder {
 public:
  Finder(const LayerSolids& solids, const SupportSizes& sizes,
         std::span<const MarkedPlaces> marked,
         std::span<const Isometry> symmetries)
      : solids_(solids),
        sizes_(sizes),
        marked_(marked),
        symmetries_(symmetries) {
    const Layer nothing;
    sweep_.start(nothing.contours);
  }

  FoundContacts find() {
    for (std::size_t i = 0; i < solids_.count(); ++i) {
      const plane::Contours& contours = solids_.layer(i).contours;
      if (i > 0 && contours == solids_.layer(i - 1).contours) {
        hold_waiting({});
        continue;
      }
      sweep_.lay_over(contours, reach(i), overlay_);
      hold_waiting(overlay_.solids);
      carry_contacts(i, contours.loop_count());
      take_layer(i);
    }
    hold_waiting({});
    return {std::move(contacts_), std::move(unwanted_)};
  }

 private:
  // An island that the next layer may join to its neighbours.
  struct Waiting {
    std::size_t layer = 0;
    std::uint32_t region = 0;
    std::vector<Wish> wishes;
  };

  double reach(std::size_t i) const {
    if (i == 0) return reach_of(0, 0);
    return reach_of(
        0, solids_.layer(i).section_z - solids_.layer(i - 1).section_z);
  }

  void take_layer(std::size_t i) {
    const plane::Contours& contours = solids_.layer(i).contours;
    std::vector<bool> is_held(contours.loop_count());
    for (const Overlap& overlap : overlay_.solids)
      is_held[overlap.above] = true;
    std::vector<std::vector<Wish>> wishes(contours.loop_count());
    for (std::uint32_t loop = 0; loop < contours.loop_count(); ++loop) {
      const bool is_outer = overlay_.areas[loop] > 0;
      const std::uint32_t outer = is_outer ? loop : overlay_.around[loop];
      if (outer >= contours.loop_count()) continue;
      if (!is_held[outer]) {
        if (is_outer) take_island(i, loop);
      } else {
        take_ledges(i, contours.loop(loop), outer, wishes[outer]);
      }
    }
    std::vector<bool> is_wide(contours.loop_count());
    for (const Overhang& overhang : overlay_.overhangs) {
      if (overhang.distance > kWideLedge) is_wide[overhang.region] = true;
    }
    for (std::uint32_t loop = 0; loop < contours.loop_count(); ++loop) {
      if (is_wide[loop]) take_wide_ledges(i, loop, wishes[loop]);
      if (wishes[loop].empty()) continue;
      hold(i, std::move(wishes[loop]), false, loop);
    }
  }

  // Contacts hold the regions above their own, as long as these are above them.
  void carry_contacts(std::size_t i, std::size_t regions) {
    std::vector<std::vector<std::uint32_t>> above(regions);
    for (const Overlap& overlap : overlay_.solids) {
      const auto& below = near_[overlap.below];
      auto& all = above[overlap.above];
      all.insert(all.end(), below.begin(), below.end());
    }
    for (auto& all : above) {
      std::ranges::sort(all);
      all.erase(std::unique(all.begin(), all.end()), all.end());
      std::erase_if(all, [&](std::uint32_t number) {
        const Vec2 place(contacts_[number].place);
        return solids_.depth(i, place) < -sizes_.tip;
      });
    }
    near_ = std::move(above);
  }

  void take_island(std::size_t i, std::uint32_t loop) {
    const plane::Contours region =
        region_of(solids_.layer(i).contours, overlay_, loop);
    std::vector<Wish> wishes;
    wishes.push_back({pole_of(region), 1e300});  // before all others
    for (std::size_t k = 0; k < region.loop_count(); ++k) {
      visit_outline(region.loop(k), [&](Vec2 place) {
        wishes.push_back({inwards(i, place), 0});
      });
    }
    visit_grid(region, [&](Vec2 place) {
      const double depth = solids_.depth(i, place);
      if (depth > sizes_.tip / 2) wishes.push_back({place, depth});
    });
    add_ends(i, region, wishes);
    const bool may_be_joined = i > 0 && overlay_.areas[loop] < kPeakArea;
    if (may_be_joined) {
      waiting_.push_back({i, loop, std::move(wishes)});
    } else {
      hold(i, std::move(wishes), true, loop);
    }
  }

  // A bar that one contact could hold would tilt on it: two stand below its
  // quarters. PrusaSlicer does so from a skeleton of 1.66 mm on, for a tip of
  // 0.4 mm; what is longer than 6.5 mm needs more of them anyhow.
  void add_ends(std::size_t i, const plane::Contours& region,
                std::vector<Wish>& wishes) const {
    constexpr double kShortest = 1.66 / 0.4;
    const Vec2 axis = long_axis(region);
    const Box2 box = box_along(region, axis);
    const Vec2 size = box.size();
    if (size.x - size.y < kShortest * sizes_.tip ||
        size.x > 2 * reach_of_tip(sizes_.tip)) {
      return;
    }
    for (const double quarter : {-0.25, 0.25}) {
      const Vec2 wanted =
          from_frame(box.center() + Vec2(quarter * size.x, 0), axis);
      Wish end = *std::ranges::min_element(wishes, {}, [&](const Wish& wish) {
        return std::round(1e3 * glm::distance(wish.place, wanted));
      });
      if (solids_.depth(i, wanted) > sizes_.tip / 4) end.place = wanted;
      end.is_contact = true;
      wishes.push_back(end);
    }
  }

  // To be called before the contacts of the layer that waits are carried on.
  //
  // solids  what of the next layer lies over what of this one
  void hold_waiting(const std::vector<Overlap>& solids) {
    for (Waiting& island : waiting_) {
      const bool is_joined =
          std::ranges::any_of(solids, [&](const Overlap& own) {
            return own.below == island.region &&
                   std::ranges::any_of(solids, [&](const Overlap& other) {
                     return other.above == own.above &&
                            other.below != island.region;
                   });
          });
      if (is_joined) continue;
      hold(island.layer, std::move(island.wishes), true, island.region);
    }
    waiting_.clear();
  }

  void take_ledges(std::size_t i, std::span<const Vec2> loop,
                   std::uint32_t region, std::vector<Wish>& wishes) const {
    const double height = solids_.layer(i).bottom;
    visit_outline(loop, [&](Vec2 place) {
      if (!solids_.is_free(i - 1, place, reach(i))) return;
      Wish wish = {place, -solids_.depth(i - 1, place)};
      // Most are; the way inwards costs more than to ask.
      if (is_held(wish, height, near_[region])) return;
      wish.place = inwards(i, place);
      wishes.push_back(wish);
    });
  }

  void take_wide_ledges(std::size_t i, std::uint32_t outer,
                        std::vector<Wish>& wishes) const {
    const plane::Contours region =
        region_of(solids_.layer(i).contours, overlay_, outer);
    visit_grid(region, [&](Vec2 place) {
      if (solids_.is_free(i - 1, place, kWideLedge) &&
          solids_.depth(i, place) > sizes_.tip / 2) {
        wishes.push_back({place, -solids_.depth(i - 1, place)});
      }
    });
  }

  // Places of a region on a grid along its own axes, symmetric about its
  // middle.
  template <typename Visit>
  static void visit_grid(const plane::Contours& region, const Visit& visit) {
    const plane::EdgeTree edges(region);
    const Vec2 axis = long_axis(region);
    const Box2 box = box_along(region, axis);
    const Vec2 half = box.size() / 2.0;
    const auto columns = static_cast<int>(half.x / kGrid);
    const auto rows = static_cast<int>(half.y / kGrid);
    for (int column = -columns; column <= columns; ++column) {
      for (int row = -rows; row <= rows; ++row) {
        const Vec2 place =
            from_frame(box.center() + Vec2(column, row) * kGrid, axis);
        if (edges.winding_number(place) > 0) visit(place);
      }
    }
  }

  // From the outline into the solid, so that the tip lies below it.
  Vec2 inwards(std::size_t i, Vec2 place) const {
    Vec2 best = place;
    double deepest = 0;
    for (int k = 0; k < kSides; ++k) {
      const Vec2 inner = place + sizes_.tip / 2 * side(k);
      const double depth = solids_.depth(i, inner);
      if (depth <= deepest + 1e-6) continue;
      deepest = depth;
      best = inner;
    }
    return best;
  }

  // Adds contacts until all places of a region are held, as far as the design
  // wants any there.
  void hold(std::size_t i, std::vector<Wish> wishes, bool is_island,
            std::uint32_t region) {
    const double height = solids_.layer(i).bottom;
    const double least = hold_radius(sizes_.tip, 0);
    const auto leave_out_held = [&] {
      std::erase_if(wishes, [&](const Wish& wish) {
        return is_held(wish, height, near_[region]);
      });
    };
    // Rounding must not decide: equal ones follow each other by their places.
    const auto rank = [](const Wish& wish) {
      const auto steps = [](double length) { return std::round(length * 1e3); };
      return std::tuple(-steps(wish.out), steps(wish.place.x),
                        steps(wish.place.y));
    };
    for (const Wish& wish : wishes) {
      if (!wish.is_contact || tip_at(i, wish.place) == 0) continue;
      add_contacts(i, wish, true, region, symmetries_);
    }
    leave_out_held();
    std::ranges::stable_sort(wishes, {}, rank);
    // What images hold too little of is held by contacts that have none.
    for (const auto symmetries : {symmetries_, symmetries_.first(1)}) {
      WishCover cover(wishes, reach_of_tip(greatest_tip()));
      const std::size_t step =
          1 + wishes.size() * symmetries.size() / kMostCandidates;
      for (std::size_t k = 0; k < wishes.size(); k += step) {
        const double tip = tip_at(i, wishes[k].place);
        if (tip == 0) continue;
        cover.add(k, orbit_of(centered(i, wishes[k], symmetries), symmetries),
                  reach_of_tip(tip));
      }
      for (const std::size_t k : cover.choose()) {
        add_contacts(i, wishes[k], is_island || wishes[k].out > least, region,
                     symmetries);
      }
      leave_out_held();
    }
    if (!wishes.empty() && (is_island || wishes.front().out > least)) {
      unwanted_.emplace_back(wishes.front().place, height);
    }
  }

  double greatest_tip() const {
    double tip = sizes_.tip;
    for (const MarkedPlaces& one : marked_) tip = std::max(tip, one.tip);
    return tip;
  }

  // How far places may be from a contact so that between them all is held, too.
  static double reach_of_tip(double tip, double height = 0) {
    return hold_radius(tip, height) - kGrid * std::numbers::sqrt2 / 2;
  }

  // The places that look the same, each once.
  std::vector<Vec2> orbit_of(Vec2 place,
                             std::span<const Isometry> symmetries) const {
    std::vector<Vec2> orbit;
    for (const Isometry& symmetry : symmetries) {
      const Vec2 image = moved(symmetry, place);
      if (std::ranges::none_of(orbit, [&](Vec2 other) {
            return glm::distance(other, image) < sizes_.tip / 4;
          })) {
        orbit.push_back(image);
      }
    }
    return orbit;
  }

  // The diameter of a tip at a place of a layer, 0 where none is wanted.
  double tip_at(std::size_t i, Vec2 place) const {
    for (const auto& [tip, solids] : marked_) {
      if (solids.touches(i, place)) return tip;
    }
    return sizes_.tip;
  }

  // Adds a contact, and its images under the symmetries.
  void add_contacts(std::size_t i, Wish wish, bool is_needed,
                    std::uint32_t region,
                    std::span<const Isometry> symmetries) {
    const std::size_t original = contacts_.size();
    bool has_first = false;
    wish.place = centered(i, wish, symmetries);
    const auto fixing = symmetries_that_fix(wish.place, symmetries);
    Vec3 away(0);
    for (const Isometry& symmetry : fixing) {
      away += turned(symmetry, away_from(i, wish));
    }
    away = glm::normalize(away);
    const double height = solids_.layer(i).bottom;
    const double tip = tip_at(i, wish.place);
    for (std::size_t k = 0; k < symmetries.size(); ++k) {
      const Isometry& symmetry = symmetries[k];
      const Vec2 place = k == 0 ? wish.place : moved(symmetry, wish.place);
      const std::uint32_t around = k == 0 ? region : region_at(i, place);
      if (around >= near_.size()) continue;
      // Where parts touch, a tip holds both.
      if (const auto known = find_contact(Vec3(place, height))) {
        near_[around].push_back(*known);
        continue;
      }
      near_[around].push_back(static_cast<std::uint32_t>(contacts_.size()));
      // Where the first one is there already, each has a way of its own.
      has_first = has_first || k == 0;
      const bool is_image = has_first && k > 0;
      contacts_.push_back({Vec3(place, height),
                           k == 0 ? away : turned(symmetry, away), tip,
                           is_needed, is_image ? original : contacts_.size(),
                           is_image ? k : 0, sides_of(fixing, symmetry)});
    }
  }

  // The one at this place, or next to it, if any.
  std::optional<std::uint32_t> find_contact(Vec3 place) const {
    const auto found =
        std::ranges::find_if(contacts_, [&](const Contact& contact) {
          return glm::distance(contact.place, place) < sizes_.tip / 4;
        });
    if (found == contacts_.end()) return std::nullopt;
    return static_cast<std::uint32_t>(found - contacts_.begin());
  }

  static std::vector<Isometry> symmetries_that_fix(
      Vec2 place, std::span<const Isometry> symmetries) {
    std::vector<Isometry> fixing;
    std::ranges::copy_if(
        symmetries, std::back_inserter(fixing), [&](const Isometry& symmetry) {
          return glm::distance(moved(symmetry, place), place) < kFixed;
        });
    return fixing;
  }

  // The directions of the mirror that fixes a contact, as the symmetry turns
  // them; straight down where more than a mirror does.
  static std::vector<Vec2> sides_of(const std::vector<Isometry>& fixing,
                                    const Isometry& symmetry) {
    if (fixing.size() == 1) return {};
    const Isometry& mirror = fixing[1];
    if (fixing.size() > 2 || mirror[0].x * mirror[1].y > 0) return {Vec2(0)};
    // It leaves the sum of a direction and its image as it is.
    const Vec2 along = Vec2(1, 0) + mirror[0];
    const Vec2 other = Vec2(0, 1) + mirror[1];
    const Vec2 line =
        glm::normalize(glm::length(along) > glm::length(other) ? along : other);
    const Vec2 side = Vec2(turned(symmetry, Vec3(line, 0)));
    return {side, -side};
  }

  // A place near a mirror or an axis goes onto it, so that one contact stands
  // there and not one on each side, if that holds as much.
  Vec2 centered(std::size_t i, const Wish& wish,
                std::span<const Isometry> symmetries) const {
    const double nearest =
        wish.is_contact ? sizes_.tip / 2 : reach_of_tip(sizes_.tip);
    Vec2 sum(0);
    double count = 0;
    for (const Isometry& symmetry : symmetries) {
      const Vec2 image = moved(symmetry, wish.place);
      if (glm::distance(image, wish.place) > nearest) continue;
      sum += image;
      ++count;
    }
    const Vec2 middle = sum / count;
    const double least_depth =
        std::min(sizes_.tip / 2, solids_.depth(i, wish.place));
    const bool is_fixed =
        std::ranges::all_of(symmetries, [&](const Isometry& symmetry) {
          const double away = glm::distance(moved(symmetry, middle), middle);
          return away < kFixed || away > nearest;
        });
    const bool is_fine =
        is_fixed && solids_.depth(i, middle) >= least_depth / 2 &&
        (i == 0 || solids_.depth(i - 1, middle) <
                       solids_.depth(i - 1, wish.place) + sizes_.tip / 4) &&
        tip_at(i, middle) > 0;
    return is_fine ? middle : wish.place;
  }

  // The region of a layer that a place is in; kOutside where it is in none.
  std::uint32_t region_at(std::size_t i, Vec2 place) const {
    const plane::Contours& contours = solids_.layer(i).contours;
    std::uint32_t region = kOutside;
    double least = 0;
    for (std::uint32_t loop = 0; loop < contours.loop_count(); ++loop) {
      const double area = signed_area(contours.loop(loop));
      if (area <= 0 || (region != kOutside && area >= least)) continue;
      if (winding_number(contours.loop(loop), place) == 0) continue;
      region = loop;
      least = area;
    }
    return region;
  }

  // What stands near the part below needs less, the higher that has grown.
  bool is_held(const Wish& wish, double height,
               const std::vector<std::uint32_t>& near) const {
    return std::ranges::any_of(near, [&](std::uint32_t number) {
      const Contact& contact = contacts_[number];
      const double least = reach_of_tip(contact.tip);
      const double radius =
          wish.out > least
              ? least
              : reach_of_tip(contact.tip, height - contact.place.z);
      return glm::distance(Vec2(contact.place), wish.place) <= radius;
    });
  }

  // Down from flat undersides, and aside from slopes: along the normal of a
  // surface that rises as the layer reaches out, at most by 45°.
  Vec3 away_from(std::size_t i, const Wish& wish) const {
    const Vec3 down(0, 0, -1);
    if (i == 0 || wish.out > kWideLedge || wish.out <= 0 ||
        solids_.layer(i - 1).contours.is_empty()) {
      return down;
    }
    const double rise =
        solids_.layer(i).section_z - solids_.layer(i - 1).section_z;
    const Vec2 aside = wish.place - solids_.nearest(i - 1, wish.place);
    const double length = glm::length(aside);
    if (length < 1e-9 || rise <= 0) return down;
    const double angle =
        std::min(std::atan2(rise, wish.out), std::numbers::pi / 4);
    return {aside / length * std::sin(angle), -std::cos(angle)};
  }

  const LayerSolids& solids_;
  const SupportSizes& sizes_;
  OverlaySweep sweep_;
  LayerOverlay overlay_;
  std::vector<Waiting> waiting_;
  std::span<const MarkedPlaces> marked_;
  std::span<const Isometry> symmetries_;
  std::vector<Contact> contacts_;
  std::vector<Vec3> unwanted_;
  // Of each region of the layer in hand, by its loop: those that hold it.
  std::vector<std::vector<std::uint32_t>> near_;
};

}  // namespace

FoundContacts find_contacts(const LayerSolids& solids,
                            const SupportSizes& sizes,
                            std::span<const MarkedPlaces> marked,
                            std::span<const Isometry> symmetries) {
  return Finder(solids, sizes, marked, symmetries).find();
}

}  // namespace lamina::slicer::detail
