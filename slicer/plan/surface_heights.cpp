#include "slicer/plan/surface_heights.h"

#include <algorithm>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/move_scene.h"

namespace lamina::slicer {

SurfaceHeights surface_heights(const csg::Scene& scene) {
  SurfaceHeights heights;
  csg::visit_boundary_faces(
      scene,
      [&](const Box3& box) {
        return box.low.z < heights.low || box.high.z > heights.high;
      },
      [&](const csg::BoundaryFace& face) {
        const Box3 box = csg::box_of(face);
        heights.low = std::min(heights.low, box.low.z);
        heights.high = std::max(heights.high, box.high.z);
      });
  return heights;
}

void place_on_bed(csg::Scene& scene) {
  const SurfaceHeights heights = surface_heights(scene);
  if (heights.is_empty()) return;
  csg::move_scene(scene, Affine(1.0), Vec3(0, 0, -heights.low));
  // Layers are counted from the bed, though leaves may reach below it.
  scene.box.low.z = 0;
}

}  // namespace lamina::slicer
