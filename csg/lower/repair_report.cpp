#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "csg/lower/detail/repair.h"

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

void report(const Repairs& repairs, std::size_t triangle_count,
            SourceRange range, Diagnostics& diagnostics) {
  if (repairs.turned_triangles > 0) {
    diagnostics.warning(
        range, fmt::format("The given mesh has faces of both orientations: "
                           "turned {} of {} triangles",
                           repairs.turned_triangles, triangle_count));
  }
  if (repairs.repeated_triangles > 0) {
    diagnostics.warning(
        range, fmt::format("The given mesh has faces more than once: dropped "
                           "{} of {} triangles",
                           repairs.repeated_triangles, triangle_count));
  }
  const std::vector<ClosedHole>& holes = repairs.closed_holes;
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

}  // namespace

void repair_and_report(Mesh& mesh, SourceRange range, Diagnostics& diagnostics,
                     Vertices vertices) {
  const std::size_t triangle_count = mesh.triangles.size();
  report(repair(mesh, vertices), triangle_count, range, diagnostics);
}

}  // namespace lamina::csg
