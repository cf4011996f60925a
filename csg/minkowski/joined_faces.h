#pragma once
// The faces of a Boolean, and flat faces joined where they share an edge.
//
// The boundary of a Boolean comes face by face (csg/boundary/boundary_faces.h),
// and seams where two leaves meet need not fit. So nothing is asked of a
// surface: an edge may have any number of faces, one of a seam has one.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "csg/boundary/boundary_faces.h"
#include "csg/minkowski/convex.h"
#include "csg/scene.h"

namespace lamina::csg {

class JoinedFaces {
 public:
  // A side of a face: an edge, run from its `from` to its `to` or back.
  struct Side {
    std::uint32_t edge = 0;
    bool is_forward = false;
  };
  struct EdgeFace {
    std::uint32_t face = 0;
    bool is_forward = false;  // the face has the edge on its side so
  };
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
  };

  // Vertices that only rounding keeps apart become one.
  //
  // loops    convex polygons, counter-clockwise around their normals; straight
  //          corners may be among theirs
  // normals  of unit length, one for each loop; loops of normal 0 are left out
  JoinedFaces(std::vector<Vec3> vertices,
              std::vector<std::vector<std::uint32_t>> loops,
              std::span<const Vec3> normals);

  // The surface of a solid, or the polygon or segment that a flat body is.
  explicit JoinedFaces(const Convex& body);

  std::span<const Vec3> vertices() const { return vertices_; }
  std::span<const Edge> edges() const { return edges_; }
  std::span<const Vec3> normals() const { return normals_; }
  std::size_t face_count() const { return normals_.size(); }

  // Corner i of a face is where its side i begins.
  std::span<const std::uint32_t> corners_of(std::size_t face) const {
    return part(corners_, face_ends_, face);
  }
  std::span<const Side> sides_of(std::size_t face) const {
    return part(sides_, face_ends_, face);
  }
  std::span<const EdgeFace> faces_at(std::size_t edge) const {
    return part(edge_faces_, edge_ends_, edge);
  }
  // Edges that begin or end at a vertex.
  std::span<const std::uint32_t> edges_at(std::size_t vertex) const {
    return part(vertex_edges_, vertex_ends_, vertex);
  }
  std::vector<Vec3> polygon(std::size_t face) const;

 private:
  template <typename T>
  static std::span<const T> part(const std::vector<T>& all,
                                 const std::vector<std::uint32_t>& ends,
                                 std::size_t i) {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(all).subspan(begin, ends[i] - begin);
  }

  void add_face(std::span<const std::uint32_t> loop, Vec3 normal);
  void join_faces();
  void list_edges_of_vertices();

  std::vector<Vec3> vertices_;
  std::vector<Vec3> normals_;
  std::vector<std::uint32_t> corners_;
  std::vector<Side> sides_;
  std::vector<std::uint32_t> face_ends_;  // in corners_ and sides_
  std::vector<Edge> edges_;
  std::vector<EdgeFace> edge_faces_;
  std::vector<std::uint32_t> edge_ends_;  // in edge_faces_
  std::vector<std::uint32_t> vertex_edges_;
  std::vector<std::uint32_t> vertex_ends_;  // in vertex_edges_
};

// Returns at least one point on each connected component of a surface: of its
// edges, the point nearest to `aim`. Faces are connected where they share an
// edge, or a corner of one lies on the other; where rounding hides that, there
// is a point too many, which does no harm in a sum.
std::vector<Vec3> points_of_components(const JoinedFaces& surface,
                                       const Vec3& aim);

// The corners of all contours, face by face.
std::vector<Vec3> corners_of(std::span<const BoundaryFace> faces);

// Whether the faces of a solid are the boundary of their hull, up to rounding:
// no corner lies above the plane of any face. Cost: about √n for each face of a
// convex solid; others are seldom asked to the end.
bool is_convex(std::span<const BoundaryFace> faces);

// The faces as triangles; equal vertices are one.
Mesh triangulate(std::span<const BoundaryFace> faces);

// For each point the first of a cluster of near ones, within 1e-7 mm.
std::vector<std::uint32_t> join_near(std::span<const Vec3> points);

}  // namespace lamina::csg
