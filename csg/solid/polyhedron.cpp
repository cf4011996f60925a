#include "csg/solid/detail/polyhedron.h"

#include <algorithm>

#include <fmt/format.h>

#include "csg/solid/detail/face.h"
#include "csg/solid/detail/mend.h"
#include "csg/solid/detail/points.h"

namespace lamina::csg {
namespace {

// The face's vertices counter-clockwise, without those that do not exist and
// without repeats.
std::vector<std::uint32_t> read_face(const Polyhedron& polyhedron,
                                     std::size_t face, SourceRange range,
                                     Diagnostics& diagnostics) {
  std::vector<std::uint32_t> loop;
  const auto& indices = polyhedron.faces[face];
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= polyhedron.points.size()) {
      diagnostics.warning(range,
                          fmt::format("Point index {} is out of bounds (from "
                                      "faces[{}][{}])",
                                      indices[i], face, i));
    } else if (loop.empty() || loop.back() != indices[i]) {
      loop.push_back(indices[i]);
    }
  }
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  std::reverse(loop.begin(), loop.end());
  return loop;
}

void add_points(const std::vector<std::uint32_t>& loop, const Mesh& mesh,
                Mesh& points) {
  for (const std::uint32_t corner : loop) {
    const auto name = static_cast<std::uint32_t>(points.vertices.size());
    points.vertices.push_back(mesh.vertices[corner]);
    points.triangles.push_back({name, name, name});
  }
}

}  // namespace

PolyhedronSurface make_polyhedron(const Polyhedron& polyhedron,
                                  SourceRange range, Diagnostics& diagnostics) {
  if (!check_points(polyhedron.points, "vec3", range, diagnostics)) return {};
  PolyhedronSurface surface;
  Mesh& mesh = surface.mesh;
  mesh.vertices.assign(polyhedron.points.begin(), polyhedron.points.end());
  bool has_degenerate = false;
  for (std::size_t face = 0; face < polyhedron.faces.size(); ++face) {
    const auto loop = read_face(polyhedron, face, range, diagnostics);
    if (loop.size() < 3) {
      has_degenerate = true;
      add_points(loop, mesh, surface.points);
      continue;
    }
    for (const auto& t : triangulate_face(mesh.vertices, loop)) {
      mesh.triangles.push_back(t);
    }
  }
  if (has_degenerate) {
    diagnostics.warning(range, "PolySet has degenerate polygons");
  }
  mend_and_report(mesh, range, diagnostics);
  return surface;
}

}  // namespace lamina::csg
