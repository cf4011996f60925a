#include "csg/boundary/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/detail/quickhull.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/boundary/united.h"
#include "csg/limits.h"
#include "plane/region/region.h"
#include "plane/tie_distance.h"

namespace lamina::csg {
namespace {

// Points no further from a plane (or a line) than this share of their extent
// lie in it: the rounding of coordinates alone can put them there.
constexpr double kFlatness = 1e-12;

// Coordinates below count as 0 [mm]. Those above are multiples of 2^-300, and
// no product of three of these underflows.
constexpr double kLeastCoordinate = 0x1p-247;

bool is_less(Vec3 a, Vec3 b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y < b.y || (a.y == b.y && a.z < b.z);
}

// Sorts the points and leaves each of them once; those beyond all numbers have
// no place.
void make_unique(std::vector<Vec3>& points) {
  // 0 · x is NaN where x is not finite.
  std::erase_if(points, [](Vec3 p) { return glm::dot(p, Vec3(0)) != 0; });
  for (Vec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (plane::is_too_far(point[axis])) plane::fail_too_far();
      if (std::abs(point[axis]) < kLeastCoordinate) point[axis] = 0;
    }
  }
  std::sort(points.begin(), points.end(), is_less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

// Returns the number of the point for which `measure` is greatest.
template <typename Measure>
std::uint32_t find_greatest(const std::vector<Vec3>& points, Measure measure) {
  std::uint32_t best = 0;
  double greatest = measure(points[0]);
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    const double size = measure(points[i]);
    if (size > greatest) {
      greatest = size;
      best = i;
    }
  }
  return best;
}

// What points span: a point or line (1), a plane (2) with its normal, space.
struct Span {
  int dimension = 1;
  // Numbers of points that span it; the first two are the ends of a line.
  std::array<std::uint32_t, 4> simplex{};
  Vec3 normal = Vec3(0);
};

Span find_span(const std::vector<Vec3>& points) {
  // Each corner of a simplex lies farthest from those before, and so does the
  // first from any point.
  const auto farthest_from = [&](Vec3 a) {
    return find_greatest(points, [&](Vec3 p) { return glm::distance(p, a); });
  };
  Span span;
  auto& [a, b, c, d] = span.simplex;
  b = farthest_from(points[0]);
  a = farthest_from(points[b]);
  const Vec3 start = points[a];
  const double length = glm::distance(start, points[b]);
  if (length == 0) return span;
  const Vec3 along = (points[b] - start) / length;
  const auto off_line = [&](Vec3 p) { return glm::cross(along, p - start); };
  c = find_greatest(points, [&](Vec3 p) { return glm::length(off_line(p)); });
  const double width = glm::length(off_line(points[c]));
  if (width <= kFlatness * length) return span;
  span.normal = off_line(points[c]) / width;
  const auto height = [&](Vec3 p) {
    return std::abs(glm::dot(span.normal, p - start));
  };
  d = find_greatest(points, height);
  span.dimension = height(points[d]) <= kFlatness * length ? 2 : 3;
  return span;
}

// Returns triangles of the hull's faces, on those points only that are corners.
// Empty where the simplex turns out to be flat, as it may along a sliver of
// points.
Mesh hull_of_solid(const std::vector<Vec3>& points,
                   const std::array<std::uint32_t, 4>& simplex) {
  Mesh mesh;
  std::unordered_map<std::uint32_t, std::uint32_t> ids;
  const auto vertex = [&](std::uint32_t point) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [place, is_new] = ids.try_emplace(point, next);
    if (is_new) mesh.vertices.push_back(points[point]);
    return place->second;
  };
  for (const std::vector<std::uint32_t>& face : hull_faces(points, simplex)) {
    for (std::size_t i = 2; i < face.size(); ++i) {
      mesh.triangles.push_back(
          {vertex(face[0]), vertex(face[i - 1]), vertex(face[i])});
    }
  }
  // Closed and of one piece.
  if (!mesh.triangles.empty()) {
    LAMINA_CHECK_EQ(mesh.triangles.size() + 4, 2 * mesh.vertices.size());
  }
  return mesh;
}

// Returns the corners of unique points in a plane.
FlatHull hull_in_plane(const std::vector<Vec3>& points, Vec3 normal) {
  // Seen along the axis nearest to the normal.
  const Vec3 size = glm::abs(normal);
  int drop = size.y > size.x ? 1 : 0;
  if (size.z > size[drop]) drop = 2;
  std::map<std::pair<double, double>, Vec3> from_shadow;
  std::vector<Vec2> shadow;
  for (const Vec3 point : points) {
    shadow.emplace_back(point[(drop + 1) % 3], point[(drop + 2) % 3]);
    from_shadow[{shadow.back().x, shadow.back().y}] = point;
  }
  const plane::Region hull = plane::convex_hull(std::move(shadow));
  if (hull.is_empty()) return {points, normal};
  FlatHull result{{}, normal[drop] > 0 ? normal : -normal};
  for (const Vec2 corner : hull.contours[0]) {
    result.corners.push_back(from_shadow.at({corner.x, corner.y}));
  }
  return result;
}

// The hull of the points so far. Most faces of a Boolean soon lie inside of it,
// and add nothing.
class GrowingHull {
 public:
  explicit GrowingHull(std::vector<Vec3> points) : points_(std::move(points)) {
    grow();
  }

  // Whether the box lies inside, not on the surface either.
  bool is_within(const Box3& box) const {
    if (planes_.empty()) return false;
    const auto is_below = [&](const HalfSpace& plane) {
      const Vec3 farthest(plane.normal.x > 0 ? box.high.x : box.low.x,
                          plane.normal.y > 0 ? box.high.y : box.low.y,
                          plane.normal.z > 0 ? box.high.z : box.low.z);
      return glm::dot(plane.normal, farthest) < plane.distance - kTieDistance;
    };
    return std::all_of(planes_.begin(), planes_.end(), is_below);
  }

  void add(const BoundaryFace& face) {
    for (const auto& contour : face.contours) {
      points_.insert(points_.end(), contour.begin(), contour.end());
    }
    if (points_.size() > 2 * kept_ + kFewPoints) grow();
  }

  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  struct HalfSpace {
    Vec3 normal;
    double distance = 0;  // from the origin
  };

  // So few that a hull costs nothing.
  static constexpr std::size_t kFewPoints = 200;

  void grow() {
    const Mesh hull = convex_hull(points_);
    if (!hull.triangles.empty()) points_ = hull.vertices;
    kept_ = points_.size();
    planes_.clear();
    for (const auto& [a, b, c] : hull.triangles) {
      const Vec3 corner = hull.vertices[a];
      const Vec3 across =
          glm::cross(hull.vertices[b] - corner, hull.vertices[c] - corner);
      const double length = glm::length(across);
      if (length == 0) continue;
      const Vec3 normal = across / length;
      planes_.push_back({normal, glm::dot(normal, corner)});
    }
  }

  std::vector<Vec3> points_;
  std::size_t kept_ = 0;  // how many they were after the last hull
  std::vector<HalfSpace> planes_;
};

}  // namespace

Mesh convex_hull(std::vector<Vec3> points) {
  make_unique(points);
  if (points.size() < 4) return {};
  const Span span = find_span(points);
  if (span.dimension < 3) return {};
  return hull_of_solid(points, span.simplex);
}

FlatHull flat_hull(std::vector<Vec3> points) {
  make_unique(points);
  if (points.size() < 2) return {points, Vec3(0, 0, 1)};
  const Span span = find_span(points);
  if (span.dimension > 1) return hull_in_plane(points, span.normal);
  const Vec3 begin = points[span.simplex[0]];
  const Vec3 end = points[span.simplex[1]];
  const Vec3 along = end - begin;
  const Vec3 size = glm::abs(along);
  Vec3 other(0);
  other[size.x > size.y ? 1 : 0] = 1;
  return {{begin, end}, glm::normalize(glm::cross(along, other))};
}

Mesh convex_hull(Scene scene) {
  std::vector<Vec3> points;
  for (const Instance& instance : take_united(scene)) {
    const Leaf& leaf = scene.leaves[instance.leaf];
    for (const Vec3& vertex : explicit_mesh(leaf).vertices) {
      points.push_back(instance.world_from_leaf * Vec4(vertex, 1));
    }
    require_triangles(static_cast<double>(points.size()));
  }
  if (scene.instances.empty()) return convex_hull(std::move(points));
  GrowingHull hull(std::move(points));
  visit_boundary_faces(
      scene, [&](const Box3& box) { return !hull.is_within(box); },
      [&](const BoundaryFace& face) { hull.add(face); });
  return convex_hull(hull.take_points());
}

}  // namespace lamina::csg
