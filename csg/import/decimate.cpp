#include "csg/import/decimate.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <new>

#include <fmt/format.h>

#include "csg/import/detail/decimation_module.h"
#include "csg/mesh/manifold_cut.h"
#include "csg/mesh/vertex_table.h"

namespace lamina::csg {
namespace {

void run_module(ManifoldCut& cut, double tolerance,
                const std::vector<std::string>& folders,
                Diagnostics& diagnostics) {
  auto* const decimate_manifold = reinterpret_cast<DecimateManifold*>(
      open_module(kDecimationModule, folders, diagnostics));
  const DecimationOutcome outcome =
      decimate_manifold(kDecimationVersion, cut.mesh, cut.is_rim, tolerance);
  if (outcome == DecimationOutcome::kDone) return;
  fail_without_engine(kDecimationModule,
                      outcome == DecimationOutcome::kNoMemory ? ENOMEM : 0,
                      diagnostics);
}

// OpenMesh walks around a vertex for each triangle that it adds there. Of fans
// wider than this, such as a disk's of thousands of sides, it gets none.
constexpr std::uint32_t kWidestFan = 200;  // triangles

// Takes the triangles of wide fans out of the mesh.
std::vector<std::array<std::uint32_t, 3>> take_wide_fans(Mesh& mesh) {
  std::vector<std::uint32_t> widths(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) ++widths[corner];
  }
  std::vector<std::array<std::uint32_t, 3>> wide;
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const bool is_wide = std::any_of(
        t.begin(), t.end(), [&](auto i) { return widths[i] > kWidestFan; });
    if (is_wide) wide.push_back(t);
    return is_wide;
  });
  return wide;
}

// Copies of a vertex are one again.
void sew(const ManifoldCut& cut,
         const std::vector<std::array<std::uint32_t, 3>>& wide, Mesh& mesh) {
  mesh.triangles = cut.mesh.triangles;
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = cut.origins[corner];
  }
  // With two copies as corners a triangle is a line, which encloses nothing.
  std::erase_if(mesh.triangles, [](const auto& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  mesh.triangles.insert(mesh.triangles.end(), wide.begin(), wide.end());
  keep_named_points(mesh.vertices, mesh.triangles);
}

}  // namespace

Decimation decimate(Mesh& mesh, double tolerance,
                    const std::vector<std::string>& folders,
                    Diagnostics& diagnostics) {
  Decimation decimation;
  decimation.triangles_before = mesh.triangles.size();
  const auto wide = take_wide_fans(mesh);
  std::vector<bool> is_fixed(mesh.vertices.size());
  for (const auto& triangle : wide) {
    for (const std::uint32_t corner : triangle) is_fixed[corner] = true;
  }
  ManifoldCut cut = cut_to_manifold(mesh);
  for (std::size_t i = 0; i < cut.origins.size(); ++i) {
    if (is_fixed[cut.origins[i]]) cut.is_rim[i] = true;
  }
  decimation.tangled_edges = cut.tangled_edges;
  decimation.tangled_vertices = cut.tangled_vertices;
  run_module(cut, tolerance, folders, diagnostics);
  sew(cut, wide, mesh);
  decimation.triangles_after = mesh.triangles.size();
  return decimation;
}

}  // namespace lamina::csg
