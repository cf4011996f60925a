#pragma once
// The places where a part must be held: below islands, and below ledges that
// reach out farther than a surface of 45° does.

#include <vector>

#include "base/vec.h"
#include "slicer/supports/detail/layer_solids.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer::detail {

struct Contact {
  Vec3 place = Vec3(0);  // on the lower side of its layer
  // The head's direction from the part, of length 1.
  Vec3 away = Vec3(0, 0, -1);
  // Whether nothing else would hold the place: an island, or a ledge that
  // reaches farther out than a contact holds.
  bool is_needed = false;
};

// From the bottom to the top. The part hangs in the air: its first layer is an
// island, too.
std::vector<Contact> find_contacts(const LayerSolids& solids,
                                   const SupportSizes& sizes);

}  // namespace lamina::slicer::detail
