#pragma once
// Minkowski sums of two surfaces.
//
// p lies in S ⊕ T where S meets p − T. They meet in curves of straight
// segments, and a curve that is not empty has a highest point, a summit, along
// any direction. Where no segment is level, a summit lies where an edge of one
// surface pierces a face of the other, and all segments at that edge lead down
// from there. So the number of summits is the sum, over all pairs of an edge
// and a face that make a summit when they meet,
//
//     n(p) = Σ [p ∈ edge ⊕ face],
//
// and S ⊕ T is where n > 0. Of the prisms edge ⊕ face neighbours in space have
// most of their facets in common. These cancel: facets are named by their
// operands, (vertex, face), (face, vertex) and (edge, edge), and only what is
// left of a name is made. Left are the places where summits come and go: where
// the surfaces touch, which is all boundary that the sum can have (its
// convolution), and where summit and saddle of a curve meet. The surface that
// is left is closed whatever rounding decides, because it is a sum of closed
// prisms, and n is its winding number.
//
// Whether a pair makes a summit depends on directions alone: the line in which
// two planes meet rises or falls by the angle between their normals, as seen
// along the direction. So the faces that an edge makes summits with are those
// whose normals are seen in one range of angles, narrow where the faces of the
// edge are nearly parallel. For smooth bodies of n and m faces there are about
// n √m + m √n pairs instead of n m, and about n + m facets are left.
//
// Source: the summits are the maxima of Morse theory on S ∩ (p − T); that a sum
// of indicator functions gives the boundary of a sum, and its cancellation, is
// the convolution of Guibas, Ramshaw and Stolfi 1983. Departure: their winding
// number counts maxima less saddles plus minima, an Euler characteristic, which
// is 0 for a curve. Maxima alone are positive wherever there is any.

#include "csg/minkowski/joined_faces.h"
#include "csg/scene.h"

namespace lamina::csg {

// A closed surface whose winding number is above 0 in the sum of the two, moved
// by `shift`, and 0 outside. Throws LimitExceeded where it has too many facets.
Mesh add_surfaces(const JoinedFaces& a, const JoinedFaces& b,
                  const Vec3& shift);

// About how many pairs of an edge and a face make summits: the cost of the sum.
double count_summits(const JoinedFaces& a, const JoinedFaces& b);

}  // namespace lamina::csg
