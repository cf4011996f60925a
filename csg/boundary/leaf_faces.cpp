#include "csg/boundary/leaf_faces.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "plane/region/convex_faces.h"
#include "plane/region/triangulate.h"

namespace lamina::csg {
namespace {

// One ring of a loft that a cap closes.
struct Rim {
  const std::vector<Vec2>* outline;
  std::uint32_t first_vertex;
  bool is_hole;
};

bool has_cap(const Loft& loft, std::size_t ring) {
  return !loft.is_closed_profile && loft.profile[ring].x > 0;
}

class FaceMaker {
 public:
  LeafFaces make(const Leaf& leaf, const Affine& world_from_leaf) {
    for (const Loft& loft : leaf.lofts) add_loft(loft);
    const bool has_holes =
        std::any_of(leaf.lofts.begin(), leaf.lofts.end(),
                    [](const Loft& loft) { return loft.is_cavity; });
    add_caps(bottoms_, true, has_holes);
    add_caps(tops_, false, has_holes);
    for (const Mesh& mesh : leaf.meshes) add_mesh(mesh);
    move(world_from_leaf);
    return std::move(result_);
  }

 private:
  std::uint32_t next_vertex() const {
    return static_cast<std::uint32_t>(result_.vertices.size());
  }

  void add_loft(const Loft& loft) {
    // An apex is one vertex.
    std::vector<std::uint32_t> rings;
    for (const Vec2 ring : loft.profile) {
      rings.push_back(next_vertex());
      for (const Vec2 point : *loft.outline) {
        result_.vertices.emplace_back(ring.x * point.x, ring.x * point.y,
                                      ring.y);
        if (ring.x == 0) break;
      }
    }
    const std::size_t count = rings.size();
    for (std::size_t i = loft.is_closed_profile ? 0 : 1; i < count; ++i) {
      const std::size_t low = (i + count - 1) % count;
      add_band(loft, rings[low], loft.profile[low].x == 0, rings[i],
               loft.profile[i].x == 0);
    }
    const auto rim = [&](std::uint32_t first_vertex) {
      return Rim{loft.outline.get(), first_vertex, loft.is_cavity};
    };
    if (has_cap(loft, 0)) bottoms_.push_back(rim(rings.front()));
    if (has_cap(loft, count - 1)) tops_.push_back(rim(rings.back()));
  }

  void add_band(const Loft& loft, std::uint32_t low, bool is_low_apex,
                std::uint32_t high, bool is_high_apex) {
    const auto n = static_cast<std::uint32_t>(loft.outline->size());
    std::vector<std::uint32_t> side;
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t next = (j + 1) % n;
      side.assign({is_low_apex ? low : low + j});
      if (!is_low_apex) side.push_back(low + next);
      side.push_back(is_high_apex ? high : high + next);
      if (!is_high_apex) side.push_back(high + j);
      if (side.size() < 3) continue;
      if (loft.is_cavity) std::reverse(side.begin(), side.end());
      add_loop(side);
      add_fan(side);
      end_face();
    }
  }

  // The caps of cavities lie in those of the lofts around them: one face.
  void add_caps(std::span<const Rim> rims, bool faces_down, bool are_one) {
    const std::size_t step = are_one ? rims.size() : 1;
    for (std::size_t i = 0; i < rims.size(); i += step) {
      add_cap(rims.subspan(i, step), faces_down);
    }
  }

  void add_cap(std::span<const Rim> rims, bool faces_down) {
    plane::Region region;
    std::vector<std::uint32_t> vertices;  // of the region's points in order
    for (const Rim& rim : rims) {
      const auto n = static_cast<std::uint32_t>(rim.outline->size());
      plane::Contour& contour = region.contours.emplace_back();
      std::vector<std::uint32_t> loop;
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t point = rim.is_hole ? n - 1 - i : i;
        contour.push_back((*rim.outline)[point]);
        loop.push_back(rim.first_vertex + point);
      }
      vertices.insert(vertices.end(), loop.begin(), loop.end());
      if (faces_down) std::reverse(loop.begin(), loop.end());
      add_loop(loop);
    }
    for (auto t : plane::triangulate(region)) {
      if (faces_down) std::swap(t[1], t[2]);
      result_.triangles.push_back(
          {vertices[t[0]], vertices[t[1]], vertices[t[2]]});
    }
    end_face();
  }

  // What lies in one plane is few faces, not many triangles: the plane problem
  // of each costs as much.
  void add_mesh(const Mesh& mesh) {
    const std::uint32_t shift = next_vertex();
    result_.vertices.insert(result_.vertices.end(), mesh.vertices.begin(),
                            mesh.vertices.end());
    for (plane::Face& face :
         plane::merge_to_convex(mesh.vertices, mesh.triangles)) {
      std::vector<std::uint32_t>& loop = face.corners;
      for (std::uint32_t& corner : loop) corner += shift;
      add_loop(loop);
      add_fan(loop);
      end_face();
    }
  }

  void add_loop(std::span<const std::uint32_t> loop) {
    result_.corners.insert(result_.corners.end(), loop.begin(), loop.end());
    result_.loop_ends.push_back(
        static_cast<std::uint32_t>(result_.corners.size()));
  }

  void add_fan(std::span<const std::uint32_t> loop) {
    for (std::size_t k = 2; k < loop.size(); ++k) {
      result_.triangles.push_back({loop[0], loop[k - 1], loop[k]});
    }
  }

  void end_face() {
    result_.faces.push_back(
        {static_cast<std::uint32_t>(result_.triangles.size()),
         static_cast<std::uint32_t>(result_.loop_ends.size())});
  }

  void move(const Affine& m) {
    for (Vec3& vertex : result_.vertices) vertex = m * Vec4(vertex, 1);
    if (glm::dot(m[0], glm::cross(m[1], m[2])) > 0) return;
    // A mirror turns faces over.
    for (auto& t : result_.triangles) std::swap(t[1], t[2]);
    std::uint32_t begin = 0;
    for (const std::uint32_t end : result_.loop_ends) {
      std::reverse(result_.corners.begin() + begin,
                   result_.corners.begin() + end);
      begin = end;
    }
  }

  LeafFaces result_;
  std::vector<Rim> bottoms_;
  std::vector<Rim> tops_;
};

}  // namespace

std::span<const LeafFaces::Triangle> LeafFaces::triangles_of(
    std::size_t face) const {
  const std::uint32_t begin = begin_of(face).triangles;
  return std::span(triangles).subspan(begin, faces[face].triangles - begin);
}

std::vector<std::vector<Vec3>> LeafFaces::contours_of(std::size_t face) const {
  std::vector<std::vector<Vec3>> contours;
  for (std::uint32_t i = begin_of(face).loops; i < faces[face].loops; ++i) {
    auto& contour = contours.emplace_back();
    const std::uint32_t begin = i == 0 ? 0 : loop_ends[i - 1];
    contour.reserve(loop_ends[i] - begin);
    for (std::uint32_t k = begin; k < loop_ends[i]; ++k) {
      contour.push_back(vertices[corners[k]]);
    }
  }
  return contours;
}

Box3 LeafFaces::box_of(std::size_t face) const {
  Box3 box;
  for (const Triangle& t : triangles_of(face)) {
    for (const std::uint32_t corner : t) box.add(vertices[corner]);
  }
  return box;
}

Vec3 LeafFaces::area_vector_of(std::size_t face) const {
  Vec3 twice(0);
  for (const Triangle& t : triangles_of(face)) {
    twice += glm::cross(vertices[t[1]] - vertices[t[0]],
                        vertices[t[2]] - vertices[t[0]]);
  }
  return 0.5 * twice;
}

Vec3 LeafFaces::normal_of(std::size_t face) const {
  const Vec3 vector = area_vector_of(face);
  const double length = glm::length(vector);
  return length > 0 ? vector / length : Vec3(0);
}

LeafFaces faces_of(const Leaf& leaf, const Affine& world_from_leaf) {
  return FaceMaker().make(leaf, world_from_leaf);
}

}  // namespace lamina::csg
