#pragma once
// Nef polyhedra, for the heavy sources that compute with them. Nobody else
// includes this: it takes half a minute and a gigabyte to compile.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>

#include "csg/scene.h"
#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

using NefKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<NefKernel>;

// The Boolean of a scene. Throws std::runtime_error if a leaf is no closed
// orientable surface.
Nef nef_of(const WorldScene& scene);

// Its boundary, triangulated and rounded to doubles.
csg::Mesh mesh_of(const Nef& nef);

}  // namespace lamina::oracle
