#pragma once
// The section of a scene by brute force: every triangle of every leaf is cut
// by the plane, a point is judged by winding numbers and by the definition of
// the operators. Shares nothing with the product but the rule which vertices
// are above a section.

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "csg/scene.h"

namespace lamina::testing {

class SectionReference {
 public:
  struct Segment {
    Vec2 from;
    Vec2 to;
    std::uint32_t instance = 0;
  };

  explicit SectionReference(const csg::Scene& scene);

  // Cuts all leaves. Vertices above `threshold` are above the section.
  void cut(double height, double threshold);

  // Whether the program holds at a point that is not on a segment. O(segments).
  bool contains(const Vec2& point) const;

  // Least distance [mm] from the point to a segment.
  double distance(const Vec2& point) const;

  const std::vector<Segment>& segments() const { return segments_; }

 private:
  const csg::Scene& scene_;
  struct Surface {
    csg::Mesh mesh;  // in the world
    std::uint32_t instance = 0;
  };
  std::vector<Surface> surfaces_;
  std::vector<Segment> segments_;
};

}  // namespace lamina::testing
