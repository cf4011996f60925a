#pragma once
// Certificates of the ray's order (kinetic data structures, Basch, Guibas and
// Hershberger 1997): how two neighbours lie to each other, and how long.
//
// Between successive vertices of either chain both are straight. On such a
// part their relation is one of three, by their distances at its two ends:
//   both within the tie distance: tied, as good as one curve;
//   beyond it with opposite signs: they cross where the distance is 0, and on
//     each side of the crossing are apart;
//   else apart, in the order given by the sign of the sum of the distances.
// So the relation is a function of x alone that changes at vertices and
// crossings only. Wherever a certificate begins, it says the same of the same
// x: that is why contours do not depend on the pitch.

#include <limits>

#include "plane/order/chain_cursor.h"

namespace lamina::plane {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

struct Certificate {
  int relation = 1;         // right of x: +1 in order, 0 tied, -1 out of order
  double failure = kNever;  // next x where the relation changes, or where the
                            // chains touch in a point
  // Without a failure: the relation holds up to this x, which is not included;
  // kNever: up to the end of one of the chains.
  double valid_until = kNever;
};

// Certifies a pair from x, which both cursors hold, beyond `limit` unless a
// failure or the end of a chain comes before. A pair out of order (relation
// -1) has to be swapped first and gets neither failure nor validity.
Certificate certify(const ChainCursor& lower, const ChainCursor& upper,
                    double x, double limit, double tie_distance);

}  // namespace lamina::plane
