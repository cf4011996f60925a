#include "csg/solid/detail/polyhedron.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "csg/solid/detail/face.h"
#include "csg/solid/detail/mend.h"
#include "csg/solid/detail/points.h"

namespace lamina::csg {
namespace {

// More holes than this are counted, not listed.
constexpr std::size_t kMostListedHoles = 8;

std::string describe(const ClosedHole& hole) {
  const Vec3 center = (hole.box.low + hole.box.high) / 2.0;
  const Vec3 size = hole.box.high - hole.box.low;
  return fmt::format(
      "closed a hole of {} edges around [{:.6g}, {:.6g}, {:.6g}], "
      "{:.6g} x {:.6g} x {:.6g} mm",
      hole.edge_count, center.x, center.y, center.z, size.x, size.y, size.z);
}

void report(const Mending& mending, std::size_t triangle_count,
            SourceRange range, Diagnostics& diagnostics) {
  if (mending.turned_triangles > 0) {
    diagnostics.warning(
        range, fmt::format("The given mesh has faces of both orientations: "
                           "turned {} of {} triangles",
                           mending.turned_triangles, triangle_count));
  }
  if (mending.repeated_triangles > 0) {
    diagnostics.warning(
        range, fmt::format("The given mesh has faces more than once: dropped "
                           "{} of {} triangles",
                           mending.repeated_triangles, triangle_count));
  }
  const std::vector<ClosedHole>& holes = mending.closed_holes;
  if (holes.empty()) return;
  std::vector<Note> notes;
  for (std::size_t i = 0; i < std::min(holes.size(), kMostListedHoles); ++i) {
    notes.push_back({range, describe(holes[i])});
  }
  if (holes.size() > kMostListedHoles) {
    notes.push_back({range, fmt::format("and {} more holes",
                                        holes.size() - kMostListedHoles)});
  }
  diagnostics.warning(range, "The given mesh is not closed!", std::move(notes));
}

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

}  // namespace

Mesh make_polyhedron(const Polyhedron& polyhedron, SourceRange range,
                     Diagnostics& diagnostics) {
  if (!check_points(polyhedron.points, "vec3", range, diagnostics)) return {};
  Mesh mesh;
  mesh.vertices.assign(polyhedron.points.begin(), polyhedron.points.end());
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
  const std::size_t triangle_count = mesh.triangles.size();
  report(mend(mesh), triangle_count, range, diagnostics);
  return mesh;
}

}  // namespace lamina::csg
