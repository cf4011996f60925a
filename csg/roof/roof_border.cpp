#include "csg/roof/detail/roof_border.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "plane/predicates.h"

namespace lamina::csg {
namespace {

Box3 box_of(const Edge& front, double margin) {
  Box3 box;
  for (const Vec2 point : {front.begin, front.end}) {
    box.add(Vec3(point - Vec2(margin), 0));
    box.add(Vec3(point + Vec2(margin), 0));
  }
  return box;
}

std::vector<Box3> boxes_of(const std::vector<Edge>& edges) {
  std::vector<Box3> boxes;
  boxes.reserve(edges.size());
  for (const Edge& edge : edges) boxes.push_back(box_of(edge, 0));
  return boxes;
}

// Returns all of a front without length.
Part part_near_edge(const Edge& front, const Edge& edge, double reach) {
  const double length = std::max(glm::distance(front.begin, front.end),
                                 std::numeric_limits<double>::min());
  const Vec2 along = (front.end - front.begin) / length;
  Vec2 from = edge.begin - front.begin;
  Vec2 to = edge.end - front.begin;
  from = {dot(along, from), cross(along, from)};
  to = {dot(along, to), cross(along, to)};
  if (from.y > to.y) std::swap(from, to);
  if (from.y > reach || to.y < -reach) return {};
  const auto at_level = [&](double y) {
    return glm::mix(from.x, to.x, (y - from.y) / (to.y - from.y));
  };
  const double first = from.y < -reach ? at_level(-reach) : from.x;
  const double last = to.y > reach ? at_level(reach) : to.x;
  return {std::max((std::min(first, last) - reach) / length, 0.0),
          std::min((std::max(first, last) + reach) / length, 1.0)};
}

}  // namespace

RoofBorder::RoofBorder(const plane::Region& region)
    : edges_(edges_of(region)), tree_(boxes_of(edges_)) {}

Part RoofBorder::near_part(const Edge& front, double reach) const {
  Part part;
  const Box3 box = box_of(front, reach);
  tree_.visit([&](const Box3& other) { return do_meet(box, other); },
              [&](std::uint32_t i) {
                const Part one = part_near_edge(front, edges_[i], reach);
                if (one.is_empty()) return;
                part.from = std::min(part.from, one.from);
                part.to = std::max(part.to, one.to);
              });
  return part;
}

}  // namespace lamina::csg
