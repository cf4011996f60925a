#pragma once
// How two neighbours on the ray stand to each other, and how long.
//
// Between successive vertices of either chain both are straight. On such a
// piece their relation is one of three, by their distances at its two ends:
//   both within the tie distance: tied, as good as one curve;
//   beyond it with opposite signs: they cross where the distance is 0, and on
//     each side of the crossing are apart;
//   else apart, in the order that the sum of the distances tells.
// So the relation is a function of x alone that changes at vertices and
// crossings only. Whoever asks, wherever a look begins, the answer is the
// same: that is why contours do not depend on the pitch.

#include <cstdint>
#include <limits>

#include "ldni/sweep/detail/status.h"

namespace lamina::ldni::detail {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

struct Outlook {
  int relation = 1;        // right of x: +1 in order, 0 tied, -1 out of order
  double change = kNever;  // next x where the relation changes, or where the
                           // chains touch in a point
  // Up to where that is known, this x not included; infinite: up to the end
  // of one of the chains.
  double horizon = kNever;
};

// Looks from x, which both cursors hold, beyond `limit` unless a change or the
// end of a chain comes before. relation < 0 ends the look: then
// the pair has to be swapped first.
Outlook look_ahead(const ChainCursor& lower, const ChainCursor& upper, double x,
                   double limit, double tie_distance);

}  // namespace lamina::ldni::detail
