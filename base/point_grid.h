#pragma once
// Points by place, for the question which of them lie near a segment.

#include <cstdint>
#include <span>

#include "base/cell_grid.h"
#include "base/vec.h"

namespace lamina {

// A grid of about two cells a point.
class PointGrid {
 public:
  // Forgets what it held. `members` are indices into `points`.
  void fill(std::span<const Vec2> points,
            std::span<const std::uint32_t> members);

  // Calls is_hit(member) for all members within `reach` [mm] of the segment,
  // in x and in y, and for some beyond; returns true at the first that is one.
  template <typename IsHit>
  bool has_near(Vec2 a, Vec2 b, double reach, const IsHit& is_hit) const {
    return grid_.visit_rows(
        a, b, Vec2(reach), [&](std::size_t first, std::size_t last) {
          for (const std::uint32_t member : members_.between(first, last)) {
            if (is_hit(member)) return true;
          }
          return false;
        });
  }

 private:
  CellGrid grid_;
  CellLists<std::uint32_t> members_;
};

}  // namespace lamina
