#include "csg/lower/detail/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// All faces are seen from inside, and together they cover the sphere of
// directions once. That sphere is covered as often in every direction, since
// the mesh is closed. Solid angles by Van Oosterom and Strackee 1983, eq. (8).
bool is_star_shaped(const Mesh& mesh) {
  // Faces that pass nearer to the mean may be seen either way [of the size].
  constexpr double kLeastDistance = 1e-6;
  if (mesh.triangles.empty()) return false;
  Vec3 mean(0);
  for (const Vec3& vertex : mesh.vertices) mean += vertex;
  mean /= static_cast<double>(mesh.vertices.size());
  double size = 0;
  for (const Vec3& vertex : mesh.vertices) {
    size = std::max(size, glm::distance(vertex, mean));
  }
  double solid_angle = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = mesh.vertices[triangle[0]] - mean;
    const Vec3 b = mesh.vertices[triangle[1]] - mean;
    const Vec3 c = mesh.vertices[triangle[2]] - mean;
    const double volume = glm::dot(a, glm::cross(b, c));
    const double area = glm::length(glm::cross(b - a, c - a));
    if (volume < kLeastDistance * size * area) return false;
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    solid_angle +=
        2 * std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc +
                                   glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return std::abs(solid_angle - 4 * std::numbers::pi) < std::numbers::pi;
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
