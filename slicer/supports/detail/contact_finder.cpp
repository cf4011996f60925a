#include "slicer/supports/detail/contact_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <glm/geometric.hpp>

#include "slicer/check/print/layer_graph.h"
#include "slicer/check/print/layer_overlay.h"
#include "slicer/check/print/pole.h"

namespace lamina::slicer::detail {
namespace {

// Parts are asked in places only; between them all is held, too: within this
// share of the radius in which a contact holds.
constexpr double kShare = 0.85;

// Contours are asked every so many mm, and ledges that reach out farther than
// kWideLedge on a grid of kGrid.
constexpr double kStep = 0.5;
constexpr double kWideLedge = 1.5;
constexpr double kGrid = 0.5;

// A place that must be within reach of a contact.
struct Wish {
  Vec2 place = Vec2(0);
  double out = 0;  // how far it is from what is below [mm]
};

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
  Finder(const LayerSolids& solids, const SupportSizes& sizes)
      : solids_(solids), sizes_(sizes) {
    const Layer nothing;
    sweep_.start(nothing.contours);
  }

  std::vector<Contact> find() {
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
    return std::move(contacts_);
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
        take_ledges(i, contours.loop(loop), wishes[outer]);
      }
    }
    std::vector<bool> is_wide(contours.loop_count());
    for (const Overhang& overhang : overlay_.overhangs) {
      if (overhang.distance > kWideLedge) is_wide[overhang.region] = true;
    }
    for (std::uint32_t loop = 0; loop < contours.loop_count(); ++loop) {
      if (is_wide[loop]) take_wide_ledges(i, loop, wishes[loop]);
      if (wishes[loop].empty()) continue;
      hold(i, std::move(wishes[loop]), false, near_[loop]);
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
    Box2 box;
    box.add(region.loop(0));
    visit_grid(box, [&](Vec2 place) {
      const double depth = solids_.depth(i, place);
      if (depth > sizes_.tip / 2) wishes.push_back({place, depth});
    });
    const bool may_be_joined = i > 0 && overlay_.areas[loop] < kPeakArea;
    if (may_be_joined) {
      waiting_.push_back({i, loop, std::move(wishes)});
    } else {
      hold(i, std::move(wishes), true, near_[loop]);
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
      hold(island.layer, std::move(island.wishes), true, near_[island.region]);
    }
    waiting_.clear();
  }

  void take_ledges(std::size_t i, std::span<const Vec2> loop,
                   std::vector<Wish>& wishes) const {
    visit_outline(loop, [&](Vec2 place) {
      const double out = -solids_.depth(i - 1, place);
      if (out > reach(i)) wishes.push_back({inwards(i, place), out});
    });
  }

  void take_wide_ledges(std::size_t i, std::uint32_t outer,
                        std::vector<Wish>& wishes) const {
    Box2 box;
    box.add(solids_.layer(i).contours.loop(outer));
    visit_grid(box, [&](Vec2 place) {
      const double out = -solids_.depth(i - 1, place);
      if (out > kWideLedge && solids_.depth(i, place) > 0) {
        wishes.push_back({place, out});
      }
    });
  }

  // Places in the box, symmetric about its middle.
  template <typename Visit>
  static void visit_grid(const Box2& box, const Visit& visit) {
    const Vec2 middle = box.center();
    const Vec2 half = (box.high - box.low) / 2.0;
    const auto columns = static_cast<int>(half.x / kGrid);
    const auto rows = static_cast<int>(half.y / kGrid);
    for (int column = -columns; column <= columns; ++column) {
      for (int row = -rows; row <= rows; ++row) {
        visit(middle + Vec2(column, row) * kGrid);
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

  // Adds contacts until all places are held, those that reach out farthest
  // first.
  //
  // near   the contacts of the region
  void hold(std::size_t i, std::vector<Wish> wishes, bool is_island,
            std::vector<std::uint32_t>& near) {
    const double least = hold_radius(sizes_.tip, 0);
    const double height = solids_.layer(i).bottom;
    // Rounding must not decide: equal ones follow each other by their places.
    const auto rank = [](const Wish& wish) {
      const auto steps = [](double length) { return std::round(length * 1e3); };
      return std::tuple(-steps(wish.out), steps(wish.place.x),
                        steps(wish.place.y));
    };
    std::ranges::stable_sort(wishes, {}, rank);
    for (const Wish& wish : wishes) {
      if (is_held(wish, height, near)) continue;
      near.push_back(static_cast<std::uint32_t>(contacts_.size()));
      contacts_.push_back({Vec3(wish.place, height), away_from(i, wish),
                           is_island || wish.out > least});
    }
  }

  // What stands near the part below needs less, the higher that has grown.
  bool is_held(const Wish& wish, double height,
               const std::vector<std::uint32_t>& near) const {
    const double least = hold_radius(sizes_.tip, 0);
    return std::ranges::any_of(near, [&](std::uint32_t number) {
      const Vec3 contact = contacts_[number].place;
      const double radius = wish.out > kShare * least
                                ? least
                                : hold_radius(sizes_.tip, height - contact.z);
      return glm::distance(Vec2(contact), wish.place) <= kShare * radius;
    });
  }

  // Down from flat undersides, and aside from slopes: along the normal of a
  // surface that rises as the layer reaches out, at most by 45°.
  Vec3 away_from(std::size_t i, const Wish& wish) const {
    const Vec3 down(0, 0, -1);
    if (i == 0 || wish.out > kWideLedge || wish.out <= 0) return down;
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
  std::vector<Contact> contacts_;
  // Of each region of the layer in hand, by its loop: those that hold it.
  std::vector<std::vector<std::uint32_t>> near_;
};

}  // namespace

std::vector<Contact> find_contacts(const LayerSolids& solids,
                                   const SupportSizes& sizes) {
  return Finder(solids, sizes).find();
}

}  // namespace lamina::slicer::detail
