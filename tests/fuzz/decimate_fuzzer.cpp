// Any triangles at all, decimated. Corners lie on a small grid, where surfaces
// meet themselves: the boundary must stay what it was.

#include <array>
#include <cstddef>
#include <cstdint>

#include "csg/import/decimate.h"
#include "csg/mesh_facts.h"
#include "csg/vertex_table.h"
#include "tests/fuzz/input.h"

using namespace lamina;

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
  const csg::MeshFacts before = csg::measure(mesh);
  csg::decimate(mesh, 0.5, {LAMINA_MODULES});
  const csg::MeshFacts after = csg::measure(mesh);
  fuzz::require(after.triangles <= before.triangles, "triangles are not more");
  fuzz::require(before.is_closed == after.is_closed, "closed stays closed");
  fuzz::require(before.open_edges == after.open_edges, "open edges stay");
  return 0;
}
