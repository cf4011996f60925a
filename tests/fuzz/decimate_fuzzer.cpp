// Any triangles at all, decimated. Corners lie on a small grid, where surfaces
// meet themselves: the boundary must stay what it was.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "csg/import/decimate.h"
#include "csg/mesh/vertex_table.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

// From point to point, how often more one way than the other; not what is 0.
using Numbers = std::array<double, 3>;
using Boundary = std::map<std::pair<Numbers, Numbers>, int>;

Boundary boundary_of(const csg::Mesh& mesh) {
  Boundary boundary;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.vertices[t[k]];
      const Vec3 b = mesh.vertices[t[(k + 1) % 3]];
      const Numbers from = {a.x, a.y, a.z};
      const Numbers to = {b.x, b.y, b.z};
      boundary[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  std::erase_if(boundary, [](const auto& edge) { return edge.second == 0; });
  return boundary;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  csg::Mesh mesh;
  csg::VertexTable table;
  for (std::size_t i = 0; i + 3 <= size; i += 3) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      // The grid has few places, so that triangles share edges, and is uneven,
      // so that little lies in a plane.
      const unsigned place = data[i + k];
      triangle[k] = table.name(
          Vec3(place % 8, place / 8 % 8, place / 64 + 0.01 * (place % 7)));
    }
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] &&
        triangle[2] != triangle[0]) {
      mesh.triangles.push_back(triangle);
    }
  }
  mesh.vertices = table.take_points();
  csg::keep_named_points(mesh.vertices, mesh.triangles);
  const std::size_t count = mesh.triangles.size();
  const Boundary before = boundary_of(mesh);
  Diagnostics diagnostics;
  csg::decimate(mesh, 0.5, {LAMINA_MODULES}, diagnostics);
  fuzz::require(mesh.triangles.size() <= count, "triangles are not more");
  fuzz::require(boundary_of(mesh) == before, "the boundary stays");
  return 0;
}
