#pragma once
// CGAL's Nef polyhedra make the Boolean of a small scene as a solid: the whole
// way that lamina saves. It takes minutes where lamina takes milliseconds, so
// tests use it for few and small scenes.

#include "csg/scene.h"
#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

// The boundary, triangulated and rounded to doubles. Throws std::runtime_error
// if a leaf is no closed orientable surface.
csg::Mesh nef_boundary(const WorldScene& scene);

}  // namespace lamina::oracle
