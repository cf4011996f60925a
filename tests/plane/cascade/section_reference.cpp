#include "tests/plane/cascade/section_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/ldni/support/scene_builder.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::testing {

SectionReference::SectionReference(const csg::Scene& scene) : scene_(scene) {
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const csg::Instance& instance = scene.instances[i];
    for (csg::Mesh mesh : as_mesh(scene.leaves[instance.leaf]).meshes) {
      for (Vec3& vertex : mesh.vertices) {
        vertex = instance.world_from_leaf * Vec4(vertex, 1);
      }
      surfaces_.push_back({std::move(mesh), i});
    }
  }
}

void SectionReference::cut(double height, double threshold) {
  segments_.clear();
  for (const Surface& surface : surfaces_) {
    for (const auto& triangle : surface.mesh.triangles) {
      Segment segment;
      segment.instance = surface.instance;
      int crossings = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& from = surface.mesh.vertices[triangle[k]];
        const Vec3& to = surface.mesh.vertices[triangle[(k + 1) % 3]];
        if ((from.z > threshold) == (to.z > threshold)) continue;
        const bool is_rising = to.z > threshold;
        const Vec3& low = is_rising ? from : to;
        const Vec3& high = is_rising ? to : from;
        const double t =
            std::clamp((height - low.z) / (high.z - low.z), 0.0, 1.0);
        const Vec2 point(low.x + t * (high.x - low.x),
                         low.y + t * (high.y - low.y));
        (is_rising ? segment.to : segment.from) = point;
        ++crossings;
      }
      if (crossings == 2) segments_.push_back(segment);
    }
  }
}

bool SectionReference::contains(const Vec2& point) const {
  std::vector<int> winding(scene_.instances.size(), 0);
  for (const Segment& segment : segments_) {
    const bool from_above = segment.from.y > point.y;
    const bool to_above = segment.to.y > point.y;
    if (from_above == to_above) continue;
    // From the lower end, so that both directions give the same number.
    const Vec2& low = to_above ? segment.from : segment.to;
    const Vec2& high = to_above ? segment.to : segment.from;
    const double x =
        low.x + (point.y - low.y) * ((high.x - low.x) / (high.y - low.y));
    if (x > point.x) winding[segment.instance] += to_above ? 1 : -1;
  }
  std::vector<bool> inside;
  for (const int number : winding) inside.push_back(number != 0);
  return support::evaluate_program(scene_, inside);
}

double SectionReference::distance(const Vec2& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments_) {
    const Vec2 along = segment.to - segment.from;
    const Vec2 offset = point - segment.from;
    const double squared = along.x * along.x + along.y * along.y;
    const double t =
        squared == 0
            ? 0
            : std::clamp((offset.x * along.x + offset.y * along.y) / squared,
                         0.0, 1.0);
    least = std::min(
        least, std::hypot(offset.x - t * along.x, offset.y - t * along.y));
  }
  return least;
}

}  // namespace lamina::testing
