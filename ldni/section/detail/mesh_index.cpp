#include "ldni/section/detail/mesh_index.h"

namespace lamina::ldni::detail {
namespace {

std::vector<double> vertex_heights(const csg::Mesh& mesh,
                                   const Affine& world_from_leaf) {
  std::vector<double> heights;
  heights.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    heights.push_back(height_of(world_from_leaf, vertex));
  }
  return heights;
}

}  // namespace

MeshIndex::MeshIndex(const csg::Mesh& mesh, const Affine& world_from_leaf,
                     const LayerGrid& grid)
    : MeshIndex(mesh, vertex_heights(mesh, world_from_leaf), grid) {}

MeshIndex::MeshIndex(const csg::Mesh& mesh, const std::vector<double>& heights,
                     const LayerGrid& grid)
    : vertices(mesh.vertices.size(), grid,
               [&](std::size_t i) {
                 return HeightRange{heights[i], heights[i]};
               }),
      triangles(mesh.triangles.size(), grid, [&](std::size_t i) {
        const auto& corners = mesh.triangles[i];
        const double a = heights[corners[0]];
        const double b = heights[corners[1]];
        const double c = heights[corners[2]];
        return HeightRange{std::min(std::min(a, b), c),
                           std::max(std::max(a, b), c)};
      }) {}

}  // namespace lamina::ldni::detail
