#include "csg/boundary/projection.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/plane_section.h"
#include "csg/boundary/program_region.h"
#include "csg/boundary/united.h"
#include "plane/predicates.h"
#include "plane/program/program_state.h"
#include "plane/region/boolean.h"
#include "plane/tie_distance.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using plane::Region;
using Side = WindowSection::Side;

// The sum of polygons: an edge that comes in both directions cancels. A mesh
// seen from above leaves little more than its outline, with the winding numbers
// of all its faces together.
class PolygonSum {
 public:
  void add(const Contour& contour) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      add_edge(contour[i], contour[(i + 1) % contour.size()]);
    }
  }

  // Returns the edges that are left, joined to contours in some order.
  std::vector<Contour> take() {
    std::vector<Contour> contours;
    while (!ends_.empty()) {
      Contour& contour = contours.emplace_back();
      for (auto edge = ends_.begin(); edge != ends_.end();
           edge = ends_.find(contour.back())) {
        const Vec2 from = edge->first;
        const Vec2 to = edge->second.back();
        edge->second.pop_back();
        if (edge->second.empty()) ends_.erase(edge);
        if (contour.empty()) contour.push_back(from);
        contour.push_back(to);
      }
      contour.pop_back();
    }
    return contours;
  }

 private:
  void add_edge(Vec2 from, Vec2 to) {
    if (from == to) return;
    const auto edges = ends_.find(to);
    if (edges != ends_.end()) {
      std::vector<Vec2>& ends = edges->second;
      const auto opposite = std::find(ends.begin(), ends.end(), from);
      if (opposite != ends.end()) {
        ends.erase(opposite);
        if (ends.empty()) ends_.erase(edges);
        return;
      }
    }
    ends_[from].push_back(to);
  }

  // Ends of edges, by their begins.
  std::map<Vec2, std::vector<Vec2>,
           decltype([](Vec2 a, Vec2 b) { return precedes(a, b); })>
      ends_;
};

Region flatten(const std::vector<std::vector<Vec3>>& contours) {
  Region region;
  for (const auto& contour : contours) {
    Contour& flat = region.contours.emplace_back();
    for (const Vec3 point : contour) flat.emplace_back(point.x, point.y);
  }
  return region;
}

void add_if_upwards(const Region& face, PolygonSum& sum) {
  if (!(plane::area(face) > 0)) return;
  for (const Contour& contour : face.contours) sum.add(contour);
}

void add_shadow(const Leaf& leaf, const Affine& world_from_leaf,
                PolygonSum& sum) {
  const LeafFaces faces = faces_of(leaf, world_from_leaf);
  for (std::size_t i = 0; i < faces.faces.size(); ++i) {
    add_if_upwards(flatten(faces.contours_of(i)), sum);
  }
}

Region section_of(const PlacedLeaf& leaf, const Plane& plane, Touch touch,
                  const Region& window) {
  const auto section = [&](Side side) {
    return plane::clip(whole_section(leaf, plane, side).contours, window);
  };
  Region above = section(Side::kAbove);
  if (touch == Touch::kAbove) return above;
  const Region below = section(Side::kBelow);
  if (above == below) return above;
  const std::array both = {above, below};
  return plane::unite(both);
}

// Returns where the program holds in the plane.
Region evaluate_at(const Scene& scene, const Plane& plane,
                   const std::vector<std::uint32_t>& near,
                   const std::vector<PlacedLeaf>& leaves, Touch touch) {
  std::vector<LiveInstance> live;
  const Vec2 low = Vec2(scene.box.low) - 1.0;
  const Vec2 high = Vec2(scene.box.high) + 1.0;
  const Region window{{{low, {high.x, low.y}, high, {low.x, high.y}}}};
  for (std::size_t i = 0; i < near.size(); ++i) {
    live.push_back({near[i], section_of(leaves[i], plane, touch, window)});
  }
  const auto value = evaluate_in_window(
      scene, plane::ProgramState(program_of(scene)), live, window);
  return value.value_or(window);
}

// Returns the flat instances that lie in the plane.
Region flat_at_zero(const Scene& scene) {
  std::vector<Contour> shadows;
  for (const Instance& instance : scene.instances) {
    const double low = instance.box.low.z;
    const double high = instance.box.high.z;
    if (!instance.is_flat || std::max(-low, high) > kTieDistance) continue;
    PolygonSum sum;
    add_shadow(scene.leaves[instance.leaf], instance.world_from_leaf, sum);
    for (Contour& contour : sum.take()) shadows.push_back(std::move(contour));
  }
  return plane::from_contours(shadows, plane::FillRule::kNonZero);
}

}  // namespace

Region project(Scene scene) {
  std::vector<Contour> shadows;
  const auto add = [&](PolygonSum& sum) {
    for (Contour& contour : sum.take()) shadows.push_back(std::move(contour));
  };
  for (const Instance& instance : take_united(scene)) {
    PolygonSum sum;
    add_shadow(scene.leaves[instance.leaf], instance.world_from_leaf, sum);
    add(sum);
  }
  PolygonSum sum;
  for (const BoundaryFace& face : boundary_faces(scene)) {
    add_if_upwards(flatten(face.contours), sum);
  }
  add(sum);
  return plane::from_contours(shadows, plane::FillRule::kNonZero);
}

Region cut_at_zero(const Scene& scene, Touch touch) {
  const Plane plane(Vec3(0), Vec3(0, 0, 1));
  std::vector<std::uint32_t> near;
  std::vector<PlacedLeaf> leaves;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (instance.is_flat || !plane.meets(instance.box)) continue;
    near.push_back(i);
    leaves.emplace_back(scene.leaves[instance.leaf], instance.world_from_leaf);
  }
  Region section = evaluate_at(scene, plane, near, leaves, touch);
  const Region flat = flat_at_zero(scene);
  if (flat.is_empty()) return section;
  const std::array all = {section, flat};
  return plane::unite(all);
}

bool misses_zero(Scene scene) {
  bool is_there = false;
  const auto meets_zero = [&](double low, double high) {
    is_there = true;
    return low <= 0 && high >= 0;
  };
  for (const Instance& instance : take_united(scene)) {
    if (meets_zero(instance.box.low.z, instance.box.high.z)) return false;
  }
  for (const BoundaryFace& face : boundary_faces(scene)) {
    for (const std::vector<Vec3>& contour : face.contours) {
      const auto [low, high] = std::minmax_element(
          contour.begin(), contour.end(),
          [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
      if (meets_zero(low->z, high->z)) return false;
    }
  }
  return is_there;
}

}  // namespace lamina::csg
