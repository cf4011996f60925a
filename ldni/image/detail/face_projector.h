#pragma once
// The faces of a leaf as triangles of a picture that looks along the rays: a
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

  // Replaces the leaf; `mesh` must stay as it is until the next one is placed.
  void place(const csg::Mesh& mesh, const Affine& world_from_leaf);

  // Replaces the triangles by those that can cover the middle of a pixel of
  // `picture`, at most kPictureSize either way. Far from the picture they are
  // cut off.
  void project(const GridBox& picture);

  // The corners of the triangles, three for each.
  std::span<const RasterCorner> corners() const { return corners_; }
  // The face of the mesh that a triangle is, or is a part of.
  std::uint32_t face_of(std::uint32_t triangle) const {
    return faces_[triangle];
  }
  // The corners of a face in the world, counter-clockwise from outside.
  std::array<Vec3, 3> corners_of(std::uint32_t face) const;

 private:
  // A vertex in the world, and the rays and sections before it.
  struct Vertex {
    Vec3 position;
    std::uint32_t rays_below;
    std::uint32_t layers_below;
  };

  bool can_meet(std::uint32_t face) const;
  void set_reach();
  bool is_in_reach(const Vec3& position) const;
  void add_face(std::uint32_t face);
  void cut_face(std::uint32_t face);
  void add_triangle(std::uint32_t face, const std::array<Vec3, 3>& corners);
  RasterCorner raster_corner(const Vec3& position) const;

  const RayGrid& rays_;
  const LayerGrid& layers_;

  // The leaf.
  const csg::Mesh* mesh_ = nullptr;
  bool is_mirrored_ = false;
  std::vector<Vertex> vertices_;
  double nearest_ = 0;  // y of the vertices
  double farthest_ = 0;

  GridBox picture_;
  Vec3 reach_low_{0};  // x and z that can be drawn; y means nothing
  Vec3 reach_high_{0};
  std::vector<RasterCorner> corners_;
  std::vector<std::uint32_t> faces_;  // of the triangles
  std::vector<Vec3> polygon_;         // of the face that is being cut
};

}  // namespace lamina::ldni
