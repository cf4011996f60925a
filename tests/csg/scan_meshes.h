#pragma once
// Finely divided meshes of known shapes, as scanners give them. Equal vertices
// are one.

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/vec.h"
#include "csg/mesh/vertex_table.h"
#include "csg/scene.h"

namespace lamina::csg::test {

inline Mesh joined(const std::vector<Mesh>& meshes) {
  Mesh all;
  VertexTable table;
  for (const Mesh& mesh : meshes) {
    for (auto triangle : mesh.triangles) {
      for (std::uint32_t& corner : triangle) {
        corner = table.name(mesh.vertices[corner]);
      }
      all.triangles.push_back(triangle);
    }
  }
  all.vertices = table.take_points();
  return all;
}

// A square of n × n cells, two triangles each; point(u, v) for whole u and v of
// 0 to n.
inline Mesh sheet(int n, const std::function<Vec3(int, int)>& point) {
  Mesh mesh;
  const auto at = [n](int u, int v) {
    return static_cast<std::uint32_t>(u * (n + 1) + v);
  };
  for (int u = 0; u <= n; ++u) {
    for (int v = 0; v <= n; ++v) mesh.vertices.push_back(point(u, v));
  }
  for (int u = 0; u < n; ++u) {
    for (int v = 0; v < n; ++v) {
      mesh.triangles.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1)});
      mesh.triangles.push_back({at(u, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  }
  return mesh;
}

// A flat square of side n in the plane z = height.
inline Mesh patch(int n, double height) {
  return sheet(n, [&](int u, int v) { return Vec3(u, v, height); });
}

// Six sides of n × n cells each.
inline Mesh box(Vec3 low, Vec3 high, int n) {
  std::vector<Mesh> sides;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_high : {false, true}) {
      sides.push_back(sheet(n, [&](int u, int v) {
        if (!is_high) std::swap(u, v);
        Vec3 part(is_high ? 1 : 0);
        part[(axis + 1) % 3] = static_cast<double>(u) / n;
        part[(axis + 2) % 3] = static_cast<double>(v) / n;
        return low + (high - low) * part;
      }));
    }
  }
  return joined(sides);
}

// A ball around the origin, as a cube of n × n cells a side that was blown up.
inline Mesh ball(double radius, int n) {
  Mesh mesh = box(Vec3(-1), Vec3(1), n);
  for (Vec3& vertex : mesh.vertices) {
    vertex = radius * glm::normalize(vertex);
  }
  return mesh;
}

// A torus around the z axis.
inline Mesh doughnut(double ring, double tube, int around, int across) {
  Mesh mesh;
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i) {
    const double a = 2 * std::numbers::pi * i / around;
    for (int j = 0; j < across; ++j) {
      const double b = 2 * std::numbers::pi * j / across;
      const double r = ring + tube * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a),
                                 tube * std::sin(b));
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// Moves every vertex by up to `amplitude` along each axis, always in the same
// way: the noise of a scanner.
inline void shake(Mesh& mesh, double amplitude) {
  std::uint64_t state = 1;
  const auto draw = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) / 4503599627370496.0 - 1;
  };
  for (Vec3& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) vertex[axis] += amplitude * draw();
  }
}

}  // namespace lamina::csg::test
