#include "bench/section_rival/triangle_mesh.h"

#include <algorithm>
#include <cstddef>

#include "plane/region/triangulate.h"

namespace lamina::rival {
namespace {

using Index = std::uint32_t;

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_convex(const std::vector<Vec2>& outline) {
  const std::size_t size = outline.size();
  for (std::size_t i = 0; i < size; ++i) {
    if (turn(outline[i], outline[(i + 1) % size], outline[(i + 2) % size]) <
        0) {
      return false;
    }
  }
  return true;
}

// Appends one loft; an apex is one vertex, not a ring of equal ones.
class LoftMesher {
 public:
  LoftMesher(const csg::Loft& loft, TriangleMesh& mesh)
      : loft_(loft),
        size_(static_cast<Index>(loft.outline->size())),
        mesh_(mesh) {}

  void run() {
    add_vertices();
    const std::size_t rings = loft_.profile.size();
    mesh_.triangles.reserve(mesh_.triangles.size() + 2 * rings * size_);
    for (std::size_t i = 0; i + 1 < rings; ++i) add_band(i, i + 1);
    if (loft_.is_closed_profile) {
      add_band(rings - 1, 0);
    } else {
      add_cap(0, true);
      add_cap(rings - 1, false);
    }
  }

 private:
  bool is_apex(std::size_t ring) const { return loft_.profile[ring].x == 0; }

  void add_vertices() {
    mesh_.vertices.reserve(mesh_.vertices.size() +
                           loft_.profile.size() * size_);
    for (const Vec2 ring : loft_.profile) {
      ring_begins_.push_back(static_cast<Index>(mesh_.vertices.size()));
      if (ring.x == 0) {
        mesh_.vertices.push_back({0, 0, ring.y});
        continue;
      }
      for (const Vec2 point : *loft_.outline) {
        mesh_.vertices.push_back({ring.x * point.x, ring.x * point.y, ring.y});
      }
    }
  }

  void add(Index a, Index b, Index c) {
    mesh_.triangles.push_back(loft_.is_cavity ? Triangle{a, c, b}
                                              : Triangle{a, b, c});
  }

  // Along the ring, so that a section around the axis meets the triangles in
  // this order.
  void add_band(std::size_t low, std::size_t high) {
    const Index a = ring_begins_[low];
    const Index b = ring_begins_[high];
    const Index a_step = is_apex(low) ? 0 : 1;
    const Index b_step = is_apex(high) ? 0 : 1;
    for (Index j = 0; j < size_; ++j) {
      const Index k = j + 1 == size_ ? 0 : j + 1;
      if (b_step != 0) add(a + j * a_step, b + k, b + j);
      if (a_step != 0) add(a + j, a + k, b + k * b_step);
    }
  }

  void add_cap(std::size_t ring, bool faces_down) {
    if (is_apex(ring)) return;
    const Index begin = ring_begins_[ring];
    if (is_convex(*loft_.outline)) {
      add_convex_cap(begin, 0, size_ - 1, faces_down);
      return;
    }
    for (const Triangle& t :
         plane::triangulate(plane::Region{{*loft_.outline}})) {
      add_cap_triangle(begin, t[0], t[1], t[2], faces_down);
    }
  }

  // Halves the polygon first…last, so that a plane meets few triangles.
  void add_convex_cap(Index begin, Index first, Index last, bool faces_down) {
    if (last - first < 2) return;
    const Index middle = first + (last - first) / 2;
    add_cap_triangle(begin, first, middle, last, faces_down);
    add_convex_cap(begin, first, middle, faces_down);
    add_convex_cap(begin, middle, last, faces_down);
  }

  void add_cap_triangle(Index begin, Index a, Index b, Index c,
                        bool faces_down) {
    if (faces_down) std::swap(b, c);
    add(begin + a, begin + b, begin + c);
  }

  const csg::Loft& loft_;
  const Index size_;  // points a ring
  TriangleMesh& mesh_;
  std::vector<Index> ring_begins_;
};

}  // namespace

TriangleMesh make_triangles(const csg::Leaf& leaf) {
  TriangleMesh result;
  for (const csg::Loft& loft : leaf.lofts) LoftMesher(loft, result).run();
  for (const csg::Mesh& mesh : leaf.meshes) {
    const auto shift = static_cast<Index>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), mesh.vertices.begin(),
                           mesh.vertices.end());
    for (const Triangle& t : mesh.triangles) {
      result.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    }
  }
  return result;
}

}  // namespace lamina::rival
