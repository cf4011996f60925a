#pragma once
// Judges all layers of a solid whose boundary is known.

#include <string>

#include "csg/scene.h"

namespace lamina::oracle {

// Compares layers of the scene with the closed mesh `expected`, inside where it
// winds a positive number of times:
//
// - Sections at seven generic heights: sound contours, regions and holes equal,
//   the symmetric difference within kExactAllowance.
// - The volume by layers. Between two heights of vertices the area of a section
//   is a polynomial of degree two in z, so that two layers at the places of
//   Gauss give the slab's volume without an error; within 1e-7 of the mesh's.
//
// Empty: passed. Otherwise what is wrong, one line for each fault.
std::string compare_with_solid(const csg::Scene& scene,
                               const csg::Mesh& expected);

}  // namespace lamina::oracle
