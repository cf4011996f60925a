#include "plane/region/convex_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace lamina::plane {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Corners this far [mm] from a face's plane still lie in it: above what
// rounding makes of coordinates up to 1e5 mm, below what a printer shows by
// far.
constexpr double kFlatDistance = 1e-9;

// Sine of the angle by which a corner may be reflex and count as straight.
constexpr double kStraightSine = 1e-9;

constexpr std::uint32_t kNoOpposite = ~std::uint32_t{0};

// Faces as rings of half-edges. Half-edge 3 t + k runs from corner k of
// triangle t to the next one.
class FaceMerger {
 public:
  FaceMerger(std::span<const Vec3> vertices,
             std::span<const Triangle> triangles)
      : vertices_(vertices), triangles_(triangles) {
    const auto count = static_cast<std::uint32_t>(3 * triangles.size());
    for (std::uint32_t h = 0; h < count; ++h) {
      const std::uint32_t first = h - h % 3;
      next_.push_back(first + (h + 1) % 3);
      previous_.push_back(first + (h + 2) % 3);
      if (h % 3 != 0) continue;
      parent_.push_back(h / 3);
      areas_.push_back(area(h / 3));
    }
    pair_half_edges();
  }

  std::vector<Face> merge() {
    is_gone_.assign(next_.size(), false);
    for (std::uint32_t h = 0; h < next_.size(); ++h) {
      // cppcheck-suppress arrayIndexThenCheck ; 'h < opposites_[h]' takes each
      // once
      if (opposites_[h] != kNoOpposite && h < opposites_[h] && !is_gone_[h])
        try_to_join(h);
    }
    std::vector<Face> faces;
    std::vector<bool> is_seen(next_.size(), false);
    for (std::uint32_t start = 0; start < next_.size(); ++start) {
      if (is_gone_[start] || is_seen[start]) continue;
      Face face;
      for (std::uint32_t h = start; !is_seen[h]; h = next_[h]) {
        is_seen[h] = true;
        face.corners.push_back(origin(h));
      }
      const Vec3 sum = areas_[face_of(start)];
      const double length = glm::length(sum);
      if (length > 0) face.normal = sum / length;
      faces.push_back(std::move(face));
    }
    return faces;
  }

 private:
  std::uint32_t origin(std::uint32_t h) const {
    return triangles_[h / 3][h % 3];
  }
  const Vec3& point(std::uint32_t h) const { return vertices_[origin(h)]; }
  Vec3 area(std::uint32_t triangle) const {
    const Vec3& a = point(3 * triangle);
    return glm::cross(point(3 * triangle + 1) - a, point(3 * triangle + 2) - a);
  }
  std::uint32_t face_of(std::uint32_t h) {
    std::uint32_t face = h / 3;
    while (parent_[face] != face) {
      face = parent_[face] = parent_[parent_[face]];
    }
    return face;
  }

  // Half-edges are twins where an edge has just these two, of opposite
  // directions.
  void pair_half_edges() {
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> keys;
    keys.reserve(next_.size());
    for (std::uint32_t h = 0; h < next_.size(); ++h) {
      keys.emplace_back(std::min(origin(h), origin(next_[h])),
                        std::max(origin(h), origin(next_[h])), h);
    }
    std::sort(keys.begin(), keys.end());
    opposites_.assign(next_.size(), kNoOpposite);
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
      const auto is_same = [&](std::size_t i) {
        return std::get<0>(keys[i]) == std::get<0>(keys[begin]) &&
               std::get<1>(keys[i]) == std::get<1>(keys[begin]);
      };
      while (end < keys.size() && is_same(end)) ++end;
      const std::uint32_t a = std::get<2>(keys[begin]);
      const std::uint32_t b = std::get<2>(keys[end - 1]);
      if (end - begin != 2 || origin(a) == origin(b)) continue;
      opposites_[a] = b;
      opposites_[b] = a;
    }
  }

  bool lies_in_plane(std::uint32_t ring, const Vec3& through,
                     const Vec3& normal) const {
    std::uint32_t h = ring;
    do {
      if (std::abs(glm::dot(point(h) - through, normal)) > kFlatDistance) {
        return false;
      }
      h = next_[h];
    } while (h != ring);
    return true;
  }

  // Whether the faces at h and its opposite lie in the plane of the larger one.
  bool are_coplanar(std::uint32_t h) {
    const Vec3& a = areas_[face_of(h)];
    const Vec3& b = areas_[face_of(opposites_[h])];
    const bool is_a_larger = glm::dot(a, a) >= glm::dot(b, b);
    const Vec3& larger = is_a_larger ? a : b;
    const Vec3& smaller = is_a_larger ? b : a;
    const double length = glm::length(larger);
    if (length == 0) return false;
    const Vec3 normal = larger / length;
    // A sliver's own direction is noise.
    const double side = glm::distance(point(h), point(next_[h]));
    const bool is_needle = glm::length(smaller) <= kFlatDistance * side;
    if (!is_needle && glm::dot(larger, smaller) < 0) return false;
    return lies_in_plane(h, point(h), normal) &&
           lies_in_plane(opposites_[h], point(h), normal);
  }

  // Whether the way a → b → c does not turn right, seen against the normal,
  // nor back.
  static bool is_convex(const Vec3& a, const Vec3& b, const Vec3& c,
                        const Vec3& normal) {
    const Vec3 in = b - a;
    const Vec3 out = c - b;
    const double turn = glm::dot(glm::cross(in, out), normal);
    const double limit = kStraightSine * glm::length(in) * glm::length(out);
    return turn > limit || (turn >= -limit && glm::dot(in, out) > 0);
  }

  void try_to_join(std::uint32_t h) {
    if (face_of(h) == face_of(opposites_[h]) || !are_coplanar(h)) return;
    // The faces may share more than this edge: find the whole line.
    std::uint32_t first = h;
    while (opposites_[previous_[first]] == next_[opposites_[first]]) {
      first = previous_[first];
      if (first == h) return;  // a triangle and its reverse share all of it
    }
    std::uint32_t last = h;
    while (opposites_[next_[last]] == previous_[opposites_[last]])
      last = next_[last];
    const std::uint32_t before = previous_[first];
    const std::uint32_t after = next_[last];
    const std::uint32_t twin_before = previous_[opposites_[last]];
    const std::uint32_t twin_after = next_[opposites_[first]];
    const Vec3 sum = areas_[face_of(h)] + areas_[face_of(opposites_[h])];
    const Vec3 normal = sum / glm::length(sum);
    if (!is_convex(point(before), point(first), point(next_[twin_after]),
                   normal) ||
        !is_convex(point(twin_before), point(after), point(next_[after]),
                   normal)) {
      return;
    }
    for (std::uint32_t gone = first;; gone = next_[gone]) {
      is_gone_[gone] = is_gone_[opposites_[gone]] = true;
      if (gone == last) break;
    }
    link(before, twin_after);
    link(twin_before, after);
    const std::uint32_t kept = face_of(before);
    const std::uint32_t joined = face_of(twin_before);
    areas_[kept] = sum;
    parent_[joined] = kept;
  }

  void link(std::uint32_t from, std::uint32_t to) {
    next_[from] = to;
    previous_[to] = from;
  }

  std::span<const Vec3> vertices_;
  std::span<const Triangle> triangles_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> opposites_;
  std::vector<std::uint32_t> parent_;
  std::vector<Vec3> areas_;  // twice the area, along the normal
  std::vector<bool> is_gone_;
};

}  // namespace

std::vector<Face> merge_to_convex(std::span<const Vec3> vertices,
                                  std::span<const Triangle> triangles) {
  return FaceMerger(vertices, triangles).merge();
}

}  // namespace lamina::plane
