#pragma once
// The places where a part must be held: below islands, and below ledges that
// reach out farther than a surface of 45° does.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "slicer/supports/detail/marked_places.h"
#include "slicer/supports/detail/symmetry.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer::detail {

struct Contact {
  Vec3 place = Vec3(0);  // on the lower side of its layer
  // The head's direction from the part, of length 1.
  Vec3 away = Vec3(0, 0, -1);
  double tip = 0;  // its diameter [mm]
  // Whether nothing else would hold the place: an island, or a ledge that
  // reaches farther out than a contact holds.
  bool is_needed = false;
  // The contact of which this one is the image, and by which of the symmetries;
  // by the identity, its own number.
  std::size_t original = 0;
  std::size_t symmetry = 0;
  // The directions in which a support can lean and still be its own image where
  // the contact is; empty where any will do.
  std::vector<Vec2> sides;
};

struct FoundContacts {
  std::vector<Contact> contacts;  // from the bottom to the top
  // Where a contact is needed and the design wants none.
  std::vector<Vec3> unwanted;
};

// The part hangs in the air: its first layer is an island, too.
//
// symmetries  of the part; the first is the identity
FoundContacts find_contacts(const LayerSolids& solids,
                            const SupportSizes& sizes,
                            std::span<const MarkedPlaces> marked,
                            std::span<const Isometry> symmetries);

}  // namespace lamina::slicer::detail
