#pragma once
// The way of a support down, which keeps clear of the part.

#include <optional>
#include <span>
#include <vector>

#include "slicer/supports/detail/contact_finder.h"
#include "slicer/supports/detail/marked_places.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer::detail {

// The support where a symmetry puts it.
Support image_of(Support support, const Isometry& symmetry);

// Whether two supports have the same way, but for rounding.
bool has_same_way(const Support& a, const Support& b);

class SupportRouter {
 public:
  // bed  its height [mm]; both others outlive the router
  SupportRouter(const LayerSolids& solids, const SupportSizes& sizes,
                double bed);

  // No value where no way was found.
  std::optional<Support> route(const Contact& contact) const;

  // Whether a support touches the part with its tips only.
  bool is_free(const Support& support) const;

  // Crosses of two rods, leaning by 45°, from tall pillars to their neighbours.
  std::vector<Brace> find_braces(std::span<const Support> supports) const;

 private:
  // A part of a way: a cone from a ball to another one below it.
  struct Rod {
    Vec3 top;
    Vec3 bottom;
    double top_diameter = 0;
    double bottom_diameter = 0;
  };
  bool is_free(const Rod& rod) const;
  bool is_free_below(Vec3 place) const;
  // sides  to which heads and pillars may lean
  std::optional<Support> route(const Contact& contact,
                               std::span<const Vec2> sides,
                               bool may_land) const;
  std::optional<Support> with_head(const Contact& contact, Vec3 away,
                                   double length, std::span<const Vec2> sides,
                                   bool may_land) const;
  double depth_of(const Contact& contact, Vec3 away) const;
  bool add_way_to_bed(Support& support, std::span<const Vec2> sides) const;
  bool add_way_to_part(Support& support) const;

  const LayerSolids& solids_;
  const SupportSizes& sizes_;
  const double bed_;
};

}  // namespace lamina::slicer::detail
