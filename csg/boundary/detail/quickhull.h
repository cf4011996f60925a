#pragma once
// The convex hull of points in space, exactly.
//
// Facets are triangles. A point outside of the hull so far is in the outside
// set of one facet that it sees. The farthest point of a set becomes a corner:
// what facets it sees are of one piece, and a cone of triangles from the rim of
// the piece, the horizon, to the point takes their place.
//
// Source: Barber, Dobkin, Huhdanpaa, "The Quickhull algorithm for convex
// hulls", ACM Transactions on Mathematical Software, 1996. Departures: all
// signs are exact, so that nothing has to be merged; a point sees only facets
// that it is strictly above, so that no triangle is degenerate, however many
// points share a plane or a line; and each point of the outside sets is
// assigned anew in a time that grows with the logarithm of the horizon, since a
// disc's has thousands of corners.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

// The faces of the hull of different points, each a convex polygon by its
// corners, counter-clockwise from outside. No two faces lie in one plane, and
// no corner lies within a face or a side.
//
// points   multiples of 2^-300 below 2^300: see orientation()
// simplex  numbers of points to begin with, far from each other; there are no
//          faces where these lie in one plane
std::vector<std::vector<std::uint32_t>> hull_faces(
    std::span<const Vec3> points, std::array<std::uint32_t, 4> simplex);

}  // namespace lamina::csg
