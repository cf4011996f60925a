#pragma once
// The way of a support down, which keeps clear of the part.

#include <optional>

#include "slicer/supports/detail/contact_finder.h"
#include "slicer/supports/detail/layer_solids.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer::detail {

class SupportRouter {
 public:
  // bed  its height [mm]; both others outlive the router
  SupportRouter(const LayerSolids& solids, const SupportSizes& sizes,
                double bed);

  // No value where no way was found.
  std::optional<Support> route(const Contact& contact) const;

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
  std::optional<Support> with_head(const Contact& contact, Vec3 away,
                                   double length) const;
  bool add_way_to_bed(Support& support) const;
  bool add_way_to_part(Support& support) const;

  const LayerSolids& solids_;
  const SupportSizes& sizes_;
  const double bed_;
};

}  // namespace lamina::slicer::detail
