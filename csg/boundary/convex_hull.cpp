#include "csg/boundary/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <libqhull_r/qhull_ra.h>

#include "base/check.h"
#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/boundary/united.h"
#include "csg/limits.h"
#include "csg/plane/region.h"
#include "csg/tie_distance.h"

namespace lamina::csg {
namespace {

// Points no further from a plane (or a line) than this share of their extent
// lie in it: the rounding of coordinates alone can put them there.
constexpr double kFlatness = 1e-12;

bool is_less(Vec3 a, Vec3 b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y < b.y || (a.y == b.y && a.z < b.z);
}

// Sorts the points and leaves each of them once; those beyond all numbers have
// no place.
void make_unique(std::vector<Vec3>& points) {
  // 0 · x is NaN where x is not finite.
  std::erase_if(points, [](Vec3 p) { return glm::dot(p, Vec3(0)) != 0; });
  for (const Vec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (is_too_far(point[axis])) fail_too_far();
    }
  }
  std::sort(points.begin(), points.end(), is_less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

// The point for which `measure` is greatest.
template <typename Measure>
Vec3 find_greatest(const std::vector<Vec3>& points, Measure measure) {
  Vec3 best = points[0];
  double greatest = measure(best);
  for (const Vec3 point : points) {
    const double size = measure(point);
    if (size > greatest) {
      greatest = size;
      best = point;
    }
  }
  return best;
}

// What points span: a point or line (1), a plane (2) with its normal, space.
struct Span {
  int dimension = 1;
  std::array<Vec3, 2> ends{};  // of the line
  Vec3 normal = Vec3(0);
};

Span find_span(const std::vector<Vec3>& points) {
  // Each corner of a simplex lies farthest from those before, and so does the
  // first from any point.
  const auto farthest_from = [&](Vec3 a) {
    return find_greatest(points, [&](Vec3 p) { return glm::distance(p, a); });
  };
  const Vec3 b = farthest_from(points[0]);
  const Vec3 a = farthest_from(b);
  const double length = glm::distance(a, b);
  if (length == 0) return {1, {a, b}};
  const Vec3 along = (b - a) / length;
  const auto off_line = [&](Vec3 p) { return glm::cross(along, p - a); };
  const Vec3 c =
      find_greatest(points, [&](Vec3 p) { return glm::length(off_line(p)); });
  const double width = glm::length(off_line(c));
  if (width <= kFlatness * length) return {1, {a, b}};
  const Vec3 normal = off_line(c) / width;
  const auto height = [&](Vec3 p) { return std::abs(glm::dot(normal, p - a)); };
  const bool is_flat =
      height(find_greatest(points, height)) <= kFlatness * length;
  return {is_flat ? 2 : 3, {a, b}, normal};
}

using Facet = std::vector<std::uint32_t>;

// One run of Qhull. Its memory is freed whatever happens.
class QhullRun {
 public:
  // points  span space; they stay where they are
  explicit QhullRun(std::vector<Vec3>& points)
      : points_(points), messages_(open_memstream(&text_, &text_size_)) {
    if (messages_ == nullptr) throw std::bad_alloc();
    qh_zero(&qh_, messages_);
    char options[] = "qhull";
    exit_code_ = qh_new_qhull(&qh_, 3, static_cast<int>(points.size()),
                              &points[0].x, False, options, nullptr, messages_);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  ~QhullRun() {
    qh_freeqhull(&qh_, qh_ALL);
    int memory_left = 0;
    int piece_count = 0;
    qh_memfreeshort(&qh_, &memory_left, &piece_count);
    std::fclose(messages_);
    std::free(text_);
  }

  // Corners of the facets in order, all counter-clockwise from outside or all
  // clockwise; none where Qhull finds no volume beyond rounding.
  std::vector<Facet> facets() {
    std::vector<Facet> result;
    if (exit_code_ == qh_ERRsingular) return result;
    if (exit_code_ == 0) read_facets(result);
    if (exit_code_ == qh_ERRmem) throw std::bad_alloc();
    if (exit_code_ != 0) {
      fail_check(__FILE__, __LINE__, "Qhull's messages", messages(), "none");
    }
    return result;
  }

 private:
  // The library leaves by longjmp where it fails, past no destructor here.
  void read_facets(std::vector<Facet>& result) {
    exit_code_ = setjmp(qh_.errexit);
    if (exit_code_ != 0) return;
    qh_.NOerrexit = False;
    qhT* qh = &qh_;
    facetT* facet = nullptr;
    FORALLfacets add_facet(facet, result);
    qh_.NOerrexit = True;
  }

  void add_facet(facetT* facet, std::vector<Facet>& result) {
    setT* vertices = qh_facet3vertex(&qh_, facet);
    result.emplace_back();
    vertexT* vertex = nullptr;
    vertexT** vertexp = nullptr;
    FOREACHvertex_(vertices) {
      // cppcheck-suppress nullPointer ; Qhull's macro sets it
      const auto index = (vertex->point - &points_[0].x) / 3;
      result.back().push_back(static_cast<std::uint32_t>(index));
    }
    qh_settempfree(&qh_, &vertices);
  }

  std::string messages() {
    std::fflush(messages_);
    return text_;
  }

  std::vector<Vec3>& points_;
  char* text_ = nullptr;
  std::size_t text_size_ = 0;
  FILE* messages_;
  int exit_code_ = 0;
  qhT qh_{};
};

// The facets' triangles, on those points only that are corners.
Mesh mesh_of(const std::vector<Vec3>& points,
             const std::vector<Facet>& facets) {
  Mesh mesh;
  std::unordered_map<std::uint32_t, std::uint32_t> ids;
  const auto vertex = [&](std::uint32_t point) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [place, is_new] = ids.try_emplace(point, next);
    if (is_new) mesh.vertices.push_back(points[point]);
    return place->second;
  };
  for (const Facet& facet : facets) {
    for (std::size_t i = 2; i < facet.size(); ++i) {
      mesh.triangles.push_back(
          {vertex(facet[0]), vertex(facet[i - 1]), vertex(facet[i])});
    }
  }
  return mesh;
}

// The corners of unique points in a plane.
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
  const planar::Region hull = planar::convex_hull(std::move(shadow));
  if (hull.is_empty()) return {points, normal};
  FlatHull result{{}, normal[drop] > 0 ? normal : -normal};
  for (const Vec2 corner : hull.contours[0]) {
    result.corners.push_back(from_shadow.at({corner.x, corner.y}));
  }
  return result;
}

// Empty as the facets may be.
Mesh hull_of_solid(std::vector<Vec3>& points) {
  // Qhull judges by the size of coordinates: let it be that of the solid.
  std::vector<Vec3> centred = points;
  const Vec3 centre = 0.5 * (points.front() + points.back());
  for (Vec3& point : centred) point -= centre;
  Mesh mesh = mesh_of(points, QhullRun(centred).facets());
  if (mesh.triangles.empty()) return mesh;
  // Closed and of one piece.
  LAMINA_CHECK_EQ(mesh.triangles.size() + 4, 2 * mesh.vertices.size());
  if (signed_volume(mesh) < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

// Instances of one leaf that differ by their shifts only.
using Linear = std::array<double, 9>;
using Shifts = std::map<std::pair<std::uint32_t, Linear>, std::vector<Vec3>>;

Linear linear_of(const Affine& m) {
  return {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y,
          m[1].z, m[2].x, m[2].y, m[2].z};
}

Affine affine_of(const Linear& m, Vec3 shift) {
  return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}, shift};
}

Shifts shifts_of(const std::vector<Instance>& instances) {
  Shifts shifts;
  for (const Instance& instance : instances) {
    const Affine& m = instance.world_from_leaf;
    shifts[{instance.leaf, linear_of(m)}].push_back(m[3]);
  }
  return shifts;
}

// The hull of the points so far. Most faces of a Boolean soon lie inside of it,
// and add nothing.
class GrowingHull {
 public:
  explicit GrowingHull(std::vector<Vec3> points) : points_(std::move(points)) {
    grow();
  }

  // Not on its surface either.
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
  if (points.size() < 4 || find_span(points).dimension < 3) return {};
  return hull_of_solid(points);
}

std::vector<Vec3> extreme_points(std::vector<Vec3> points) {
  make_unique(points);
  if (points.size() <= 4) return points;
  const Span span = find_span(points);
  if (span.dimension == 1) return {span.ends[0], span.ends[1]};
  if (span.dimension == 2) return hull_in_plane(points, span.normal).corners;
  const Mesh hull = hull_of_solid(points);
  return hull.triangles.empty() ? points : hull.vertices;
}

FlatHull flat_hull(std::vector<Vec3> points) {
  make_unique(points);
  if (points.size() < 2) return {points, Vec3(0, 0, 1)};
  const Span span = find_span(points);
  if (span.dimension > 1) return hull_in_plane(points, span.normal);
  const auto [begin, end] = span.ends;
  const Vec3 along = end - begin;
  const Vec3 size = glm::abs(along);
  Vec3 other(0);
  other[size.x > size.y ? 1 : 0] = 1;
  return {{begin, end}, glm::normalize(glm::cross(along, other))};
}

Mesh convex_hull(Scene scene) {
  std::vector<Vec3> points;
  for (auto& [shape, shifts] : shifts_of(take_united(scene))) {
    const auto& [leaf, linear] = shape;
    const std::vector<Vec3> vertices =
        explicit_mesh(scene.leaves[leaf]).vertices;
    for (const Vec3 shift : extreme_points(shifts)) {
      const Affine m = affine_of(linear, shift);
      for (const Vec3 vertex : vertices) points.push_back(m * Vec4(vertex, 1));
    }
  }
  if (scene.instances.empty()) return convex_hull(std::move(points));
  GrowingHull hull(std::move(points));
  visit_boundary_faces(
      scene, [&](const Box3& box) { return !hull.is_within(box); },
      [&](const BoundaryFace& face) { hull.add(face); });
  return convex_hull(hull.take_points());
}

}  // namespace lamina::csg
