#pragma once
// The faces of leaves as triangles of a picture that looks along the rays: a
// column for each ray, a row for each layer, their crossing in the middle of a
// pixel.
//
// Corners are moved to whole steps of 1/256 pixel here, in double precision and
// once for all faces around a corner, so that nothing is left for OpenGL to
// round: the triangles of a closed leaf are closed in the picture, and any
// rasteriser that is exact on its own grid, as OpenGL's are in practice, draws
// every pixel as often from the front as from the back. A corner is moved by at
// most a step, and never across a ray or a section nor onto one: as in the
// exact sampler, RayGrid::rays_below and LayerGrid::layers_below alone decide
// on which side it is. So a pixel can have other faces than an exact ray only
// where an edge passes within a step of its middle.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"
#include "ldni/gl/face_raster.h"
#include "ldni/image/ray_grid.h"

namespace lamina::ldni {

class FaceProjector {
 public:
  // Both must outlive the projector; layers of equal thickness.
  FaceProjector(const RayGrid& rays, const LayerGrid& layers)
      : rays_(rays), layers_(layers) {}

  // A face of a leaf: which of the placed leaves, and which of its triangles.
  struct Face {
    std::uint32_t leaf;
    std::uint32_t triangle;
  };

  // Forgets all leaves.
  void clear();
  // Places one more leaf, to be seen in `box`; `mesh` must stay as it is until
  // `clear`.
  void place(const csg::Mesh& mesh, const Affine& world_from_leaf,
             const GridBox& box);

  // Replaces the triangles by those that can cover the middle of a pixel of
  // `picture`, at most kPictureSize either way, in the box of their leaf. Far
  // from the picture they are cut off.
  void project(const GridBox& picture);

  // The corners of the triangles, three for each.
  std::span<const RasterCorner> corners() const { return corners_; }
  // The face that a triangle is, or is a part of.
  const Face& face_of(std::uint32_t triangle) const { return faces_[triangle]; }
  // The corners of a face in the world, counter-clockwise from outside.
  std::array<Vec3, 3> corners_of(const Face& face) const;

 private:
  // A vertex in the world, and the rays and sections before it.
  struct Vertex {
    Vec3 position;
    std::uint32_t rays_below;
    std::uint32_t layers_below;
  };

  struct Leaf {
    const csg::Mesh* mesh;
    GridBox box;
    bool is_mirrored;
    std::size_t first_vertex;  // into vertices_
    double nearest;            // y of the vertices
    double farthest;
  };

  bool can_meet(const Face& face) const;
  void set_reach();
  bool is_in_reach(const Vec3& position) const;
  void add_face(const Face& face);
  void cut_face(const Face& face);
  void add_triangle(const Face& face, const std::array<Vec3, 3>& corners);
  RasterCorner raster_corner(const Leaf& leaf, const Vec3& position) const;

  const RayGrid& rays_;
  const LayerGrid& layers_;

  std::vector<Leaf> leaves_;
  std::vector<Vertex> vertices_;  // of all leaves

  GridBox picture_;
  GridBox visible_;    // of the picture, the box of the leaf at hand
  Vec3 reach_low_{0};  // x and z that can be drawn; y means nothing
  Vec3 reach_high_{0};
  std::vector<RasterCorner> corners_;
  std::vector<Face> faces_;    // of the triangles
  std::vector<Vec3> polygon_;  // of the face that is being cut
};

}  // namespace lamina::ldni
