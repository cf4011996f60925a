#pragma once
// The Boolean of small scenes as a solid, by CGAL's Nef polyhedra: the whole
// way that lamina saves. Minutes for what takes lamina milliseconds, so only
// for few and small scenes.

#include "csg/scene.h"
#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

// The boundary, triangulated and rounded to doubles. Throws std::runtime_error
// if a leaf is no closed orientable surface.
csg::Mesh nef_boundary(const WorldScene& scene);

}  // namespace lamina::oracle
