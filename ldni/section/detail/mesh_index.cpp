#include "ldni/section/detail/mesh_index.h"

namespace lamina::ldni::detail {

MeshIndex index_mesh(const csg::Mesh& mesh, const Affine& world_from_leaf,
                     const LayerGrid& grid) {
  std::vector<double> heights;
  heights.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    heights.push_back(height_of(world_from_leaf, vertex));
  }
  MeshIndex index;
  index.vertices.group(heights.size(), grid, [&](std::size_t i) {
    return HeightRange{heights[i], heights[i]};
  });
  index.triangles.group(mesh.triangles.size(), grid, [&](std::size_t i) {
    const auto& corners = mesh.triangles[i];
    const auto [low, high] = std::minmax(
        {heights[corners[0]], heights[corners[1]], heights[corners[2]]});
    return HeightRange{low, high};
  });
  return index;
}

}  // namespace lamina::ldni::detail
