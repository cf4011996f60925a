#include "csg/lower/detail/polyhedron.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "csg/lower/detail/face.h"
#include "csg/lower/detail/points.h"
#include "csg/lower/detail/repair.h"

namespace lamina::csg {
namespace {

// The face's vertices counter-clockwise, without those that do not exist and
// without repeats.
std::vector<std::uint32_t> read_face(const PolyhedronParams& polyhedron,
                                     std::size_t face, SourceRange range,
                                     Diagnostics& diagnostics) {
  std::vector<std::uint32_t> loop;
  const auto& indices = polyhedron.faces[face];
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= polyhedron.points.size()) {
      // OpenSCAD's indices are of 64 bits here, of 32 in a polygon.
      const auto index =
          static_cast<std::int64_t>(static_cast<std::int32_t>(indices[i]));
      warn_of_index(static_cast<std::uint64_t>(index), "faces", face, i, range,
                    diagnostics);
    } else if (loop.empty() || loop.back() != indices[i]) {
      loop.push_back(indices[i]);
    }
  }
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  std::reverse(loop.begin(), loop.end());
  return loop;
}

}  // namespace

Mesh make_polyhedron(const PolyhedronParams& polyhedron, SourceRange range,
                     Diagnostics& diagnostics) {
  Mesh mesh;
  for (const Vec3& point : polyhedron.points) {
    // What is not finite stands in no face. 0 · x is NaN there.
    const bool is_finite = glm::dot(point, Vec3(0)) == 0;
    mesh.vertices.push_back(is_finite ? point : Vec3(0));
  }
  bool has_degenerate = false;
  for (std::size_t face = 0; face < polyhedron.faces.size(); ++face) {
    const auto loop = read_face(polyhedron, face, range, diagnostics);
    if (loop.size() < 3) {
      has_degenerate = true;
      continue;
    }
    for (const auto& t : triangulate_face(mesh.vertices, loop)) {
      mesh.triangles.push_back(t);
    }
  }
  if (has_degenerate) {
    diagnostics.warning(range, "PolySet has degenerate polygons");
  }
  repair_and_report(mesh, range, diagnostics);
  return mesh;
}

Mesh make_corners(const PolyhedronParams& polyhedron, SourceRange range,
                  Diagnostics& diagnostics) {
  Mesh mesh;
  for (std::size_t face = 0; face < polyhedron.faces.size(); ++face) {
    for (const std::uint32_t corner :
         read_face(polyhedron, face, range, diagnostics)) {
      const auto name = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(polyhedron.points[corner]);
      mesh.triangles.push_back({name, name, name});
    }
  }
  return mesh;
}

}  // namespace lamina::csg
