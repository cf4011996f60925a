#pragma once
// Small scenes made by hand: leaves as triangle meshes, placed by any affine
// map, under any Boolean program. No stage of the program before `ldni` is
// needed for them.

#include <cstdint>
#include <random>
#include <vector>

#include "base/vec.h"
#include "csg/scene.h"

namespace lamina::support {

// Closed, counter-clockwise from outside.
csg::Mesh box_mesh(const Vec3& low, const Vec3& high);
// A prism over the regular polygon with `sides` corners on the circle of
// radius r about the z axis, the first one on +x, from z = low to z = high.
csg::Mesh prism_mesh(int sides, double r, double low, double high);
// Rings of `sides` corners at equal angles of latitude, no pole vertices (as
// OpenSCAD's sphere), inscribed in the sphere of radius r.
csg::Mesh sphere_mesh(int sides, double r);
// A torus about the z axis, inscribed.
csg::Mesh torus_mesh(int sides, double ring_radius, double tube_radius);

csg::Leaf mesh_leaf(csg::Mesh mesh, bool may_overlap_itself = false);

Affine shift_by(const Vec3& by);
// Turn by `angle` [rad] about `axis` through the origin.
Affine turn_about(const Vec3& axis, double angle);
Affine scale_by(const Vec3& factors);
// `outer` after `inner`.
Affine compose(const Affine& outer, const Affine& inner);

// Adds an instance under program node `parent`; sets its box and counts it as
// a child. The first child of a difference is its minuend.
std::uint32_t place_leaf(csg::Scene& scene, std::uint32_t leaf,
                         const Affine& world_from_leaf,
                         std::uint32_t parent = 0);
// Adds an operator under `parent` and returns its index.
std::uint32_t add_operator(csg::Scene& scene, plane::BooleanOp op,
                           std::uint32_t parent);
// A scene whose root is `op`, with no leaves yet.
csg::Scene scene_of(plane::BooleanOp op);
// Sets the scene's box to that of all instances.
void cover_instances(csg::Scene& scene);

// The value of the program at a point whose leaves are `inside`, by the
// definition of the operators.
bool evaluate_program(const csg::Scene& scene, const std::vector<bool>& inside);

// A turn about a random axis by a random angle.
Affine random_turn(std::mt19937& random);

}  // namespace lamina::support
