#pragma once
// Fewer triangles for a mesh, within a stated distance of it.
//
// A scanner gives a triangle for each point that it saw, many times what a
// printer can show. Decimation takes vertices out, one after the other, as long
// as the surface stays within a tolerance of the one that came.

#include <cstddef>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/module.h"
#include "csg/scene.h"

namespace lamina::csg {

// The module that holds OpenMesh.
inline constexpr Module kDecimationModule{
    "lamina_decimate.so", "lamina_decimate_manifold", "decimation", ""};

struct Decimation {
  std::size_t triangles_before = 0;
  std::size_t triangles_after = 0;
  // Where the mesh is not manifold, which keeps its vertices: edges of other
  // than two triangles that run against each other, and vertices at which
  // several fans of triangles meet.
  std::size_t tangled_edges = 0;
  std::size_t tangled_vertices = 0;
};

// Every point of the old surface comes to lie within `tolerance` of the new one
// and the other way round. Vertices that stay keep their places; a mesh that
// was closed is closed, and as many loops bound an open one. Takes about 20 µs
// and 200 bytes for a triangle.
//
// tolerance    [mm], positive
// folders      where to look for the module, in this order
// diagnostics  gets the error that the module is missing
// throws       GeometryError where it is
Decimation decimate(Mesh& mesh, double tolerance,
                    const std::vector<std::string>& folders,
                    Diagnostics& diagnostics);

}  // namespace lamina::csg
