#pragma once
// Makes nodes of the CSG tree from what FreeCAD's features say.
//
// Curves get their fragments here, as $fn, so that the printed tree means the
// same in OpenSCAD. Each solid knows how many leaves it has: objects share
// what they are made of, so that a few lines of a file could ask for more
// leaves than memory holds.

#include <cstddef>
#include <span>
#include <vector>

#include "base/arena.h"
#include "base/source.h"
#include "csg/import/freecad/detail/outline.h"
#include "csg/tree.h"

namespace lamina::csg::freecad {

struct Solid {
  const Node* node = nullptr;
  std::size_t leaves = 0;
};

// What all nodes of one import share.
struct NodeOrigin {
  SourceRange range;
  const CallSite* caller = nullptr;
};

class SolidMaker {
 public:
  // chordal_error  greatest distance of facets from the surface [mm]
  // most_leaves    of a solid; more throw plane::LimitExceeded
  SolidMaker(Arena& arena, NodeOrigin origin, double chordal_error,
             std::size_t most_leaves)
      : arena_(arena),
        origin_(origin),
        error_(chordal_error),
        most_leaves_(most_leaves) {}

  double chordal_error() const { return error_; }
  // For an outline that revolve() turns: the chords of the turn get the rest.
  double chordal_error_of_turned() const { return error_ / 2; }

  Solid leaf(decltype(Node::op) op);
  Solid unite(std::span<const Solid> solids);
  Solid intersect(std::span<const Solid> solids);
  // All but the first are taken from it.
  Solid subtract(std::span<const Solid> solids);

  // world_from_solid  may mirror
  Solid place(const Mat4& world_from_solid, const Solid& solid);

  // Right prisms over the outline's plane, from one height to another along
  // `way`, which makes an angle with that plane [mm]. The order of the heights
  // does not matter.
  Solid extrude(const Outline& outline, Vec3 way, double from, double to);

  // A body of revolution: the contours are in (distance from the axis, height
  // along it); it begins in the half plane of +x and turns counter-clockwise
  // about +z.
  Solid revolve(const std::vector<Polyline>& contours, double angle_deg);

  Solid cylinder(double height, double bottom_radius, double top_radius);
  Solid sphere(double radius);

  template <typename T>
  const T* keep(const T& value) {
    return arena_.make(value);
  }
  std::string_view keep_text(std::string_view text) {
    return arena_.copy(text);
  }

 private:
  Solid make(decltype(Node::op) op, std::span<const Solid> children);
  // All polygons together may have plane::kMostCorners corners.
  Solid polygon(const std::vector<Polyline>& contours);

  Arena& arena_;
  NodeOrigin origin_;
  double error_;
  std::size_t most_leaves_;
  std::size_t corners_ = 0;  // of all polygons
};

// --- Matrices ---------------------------------------------------------------

Mat4 turn_about_z(double angle_deg);
// Mirrors at the plane through `base` with this normal.
Mat4 mirror(Vec3 base, Vec3 normal);
Vec3 apply_to_point(const Mat4& matrix, Vec3 point);
Vec3 apply_to_way(const Mat4& matrix, Vec3 way);

}  // namespace lamina::csg::freecad
