#pragma once
// Convex bodies and their Minkowski sums.
//
// The surface of A ⊕ B is found by merging the normals of the two: each facet
// of B moves by the vertex of A that lies farthest along its normal; where two
// neighbouring facets go with different vertices of A, the edge between them
// sweeps along the edges of A that lead from one to the other; and the vertex
// of B around which these ways close a full turn carries A itself.
//
// With a flat A this is robust by construction, so only sums with flat bodies
// are made this way: the pieces above fit together whatever rounding decides,
// because a way around a vertex that closes is a whole number of turns. So the
// surface is always closed. A wrong decision between two vertices of A that are
// equally far, up to rounding, gives facets that lie in one plane, up to
// rounding.
//
// A prism is its base ⊕ its axis, two flat sums. The sum of any other two
// solids, and of what is a hull itself, is the hull of the vertices that it can
// have (extreme_sums()).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// A convex body by its surface. A flat one (polygon, segment, point) is a prism
// of no height: its polygon, seen from both sides, and two-cornered facets
// between them.
struct Convex {
  // Runs so that facet `left` has it in its own direction.
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t left = 0;
    std::uint32_t right = 0;
  };

  std::vector<Vec3> vertices;
  // Facets by their corners, counter-clockwise from outside. Neighbours may
  // lie in one plane.
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> facet_ends;  // facet i: [ends[i-1], ends[i])
  std::vector<Vec3> normals;              // of the facets; unit length
  std::vector<Edge> edges;                // none in a sum: see find_edges()
  bool is_flat = false;                   // then facet 0 is the polygon
  bool is_closed = false;  // every side of a facet has its partner
  bool is_hull = false;    // of sums or a mesh: rounding may bend its facets

  std::size_t facet_count() const { return facet_ends.size(); }
  std::span<const std::uint32_t> facet(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : facet_ends[i - 1];
    return std::span(corners).subspan(begin, facet_ends[i] - begin);
  }
  void add_facet(std::span<const std::uint32_t> loop, Vec3 normal);
};

// polygon  convex, counter-clockwise around the normal. Two points are a
// segment,
//          and the normal may be any at a right angle to it; one point takes
//          any normal
Convex make_flat(std::vector<Vec3> polygon, Vec3 normal);

// Of polygons, counter-clockwise around them; of unit length, or 0 where the
// polygon is a line but for rounding: its own would be noise.
std::vector<Vec3> normals_of(std::span<const Vec3> vertices,
                             std::span<const std::vector<std::uint32_t>> loops);

// The solid with these facets. The caller knows that they are closed and
// convex, or asks is_convex().
//
// loops  counter-clockwise from outside
Convex make_solid(std::vector<Vec3> vertices,
                  std::span<const std::vector<std::uint32_t>> loops);

// Whether the facets are the boundary of a convex solid.
bool is_convex(const Convex& body);

Convex move(Convex body, const Vec3& shift);

// Middle of the vertices: a point of the body.
Vec3 middle(const Convex& body);

// The sum of a flat body and any other. Flat if both are and lie in parallel
// planes.
//
// body  has its edges
Convex add_flat(const Convex& flat, const Convex& body);

// Pairs the sides of the facets to edges. A sum needs this before it is added
// to something itself.
void find_edges(Convex& body);

// The base and the axis of a prism: prism = base ⊕ axis.
struct Prism {
  Convex base;
  Convex axis;
};
std::optional<Prism> as_prism(const Convex& solid);

// Appends the surface as triangles.
void append_triangles(const Convex& body, Mesh& mesh);

// The vertices that the sum of two convex solids can have: p + q for all
// vertices p of a and q of b that lie farthest along a common direction, up to
// rounding: all vertices of the sum and few others. Two vertices have such a
// direction unless the normals around one all rise along an edge of the other.
// Cost: about the number of vertices found, not of all pairs.
std::vector<Vec3> extreme_sums(const Convex& a, const Convex& b);

}  // namespace lamina::csg
