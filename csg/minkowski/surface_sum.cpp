#include "csg/minkowski/surface_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/limits.h"
#include "csg/mesh/vertex_table.h"

namespace lamina::csg {
namespace {

// A turn is 2⁶⁴, so that angles wrap as integers do and all comparisons of them
// agree.
using Angle = std::uint64_t;
constexpr Angle kHalfTurn = Angle{1} << 63;

// What is up for summits. It must not lie in the planes that designs are made
// of: a curve in a level plane has no summit. (Its coordinates are π, e and
// √2, scaled to about unit length.)
const Vec3 kUp = glm::normalize(
    Vec3(0.31415926535897931, 0.27182818284590451, 0.14142135623730950));

Angle angle_of(double x, double y) {
  const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
  // In two steps: half a turn is too much for a signed number.
  return 2 * static_cast<Angle>(static_cast<std::int64_t>(turn * 0x1p63));
}

// The angles of faces' normals, as seen from above.
std::vector<Angle> seen_angles(const JoinedFaces& surface) {
  const Vec3 x_axis = glm::normalize(glm::cross(kUp, Vec3(0, 0, 1)));
  const Vec3 y_axis = glm::cross(kUp, x_axis);
  std::vector<Angle> angles;
  for (const Vec3& normal : surface.normals()) {
    angles.push_back(
        angle_of(glm::dot(normal, x_axis), glm::dot(normal, y_axis)));
  }
  return angles;
}

// The edges of one surface that make summits with faces of the other.
//
// With the line in which face f (at the edge) and face g meet, the segment in f
// leads down from the edge where
//
//     s · r · sin(angle_g − angle_f) < 0,
//
// s being the sign of edge · normal_g, and r = 1 if f has the edge forwards,
// −1 if backwards.
class Summits {
 public:
  Summits(const JoinedFaces& edges, std::span<const Angle> angles,
          const JoinedFaces& faces, std::span<const Angle> other_angles)
      : edges_(edges), faces_(faces), angles_(angles) {
    order_.resize(other_angles.size());
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::sort(order_.begin(), order_.end(), [&](auto i, auto k) {
      return other_angles[i] < other_angles[k];
    });
    for (const std::uint32_t i : order_) sorted_.push_back(other_angles[i]);
  }

  // About how many there are: half of the faces in range point to the other
  // side of the edge.
  double count() const {
    double sum = 0;
    for (std::size_t e = 0; e < edges_.edges().size(); ++e) {
      const auto faces = edges_.faces_at(e);
      if (faces.empty()) {
        sum += static_cast<double>(sorted_.size());
        continue;
      }
      const Arc arc = arc_of(faces);
      sum += static_cast<double>(places_of(arc).count +
                                 places_of(opposite(arc)).count) /
             2;
    }
    return sum;
  }

  // visit(g, s)
  template <typename Visit>
  void for_each(std::uint32_t edge, Visit visit) const {
    const JoinedFaces::Edge ends = edges_.edges()[edge];
    const Vec3 along =
        edges_.vertices()[ends.to] - edges_.vertices()[ends.from];
    const auto faces = edges_.faces_at(edge);
    if (faces.empty()) {
      for (std::uint32_t g = 0; g < sorted_.size(); ++g) {
        visit(g, sign_of(along, g));
      }
      return;
    }
    const Arc arc = arc_of(faces);
    visit_arc(arc, along, 1, visit);
    visit_arc(opposite(arc), along, -1, visit);
  }

 private:
  struct Arc {
    Angle begin = 0;
    Angle size = 0;
  };

  static Arc opposite(const Arc& arc) {
    return {arc.begin + kHalfTurn, arc.size};
  }

  // Returns where angle_g may be for s = 1: half a turn for each face.
  Arc arc_of(std::span<const JoinedFaces::EdgeFace> faces) const {
    const auto half_turn = [&](const JoinedFaces::EdgeFace& f) {
      return angles_[f.face] + (f.is_forward ? kHalfTurn : 0);
    };
    Arc arc{half_turn(faces[0]), kHalfTurn};
    for (const JoinedFaces::EdgeFace& f : faces.subspan(1)) {
      const Angle begin = half_turn(f);
      const Angle skipped = begin - arc.begin;
      const Angle passed = arc.begin - begin;
      if (skipped < arc.size) {
        arc = {begin, arc.size - skipped};
      } else {
        arc.size =
            passed < kHalfTurn ? std::min(arc.size, kHalfTurn - passed) : 0;
      }
    }
    return arc;
  }

  int sign_of(const Vec3& along, std::uint32_t g) const {
    return glm::dot(along, faces_.normals()[g]) >= 0 ? 1 : -1;
  }

  // A range of sorted_, which may run past its end.
  struct Places {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  Places places_of(const Arc& arc) const {
    if (arc.size == 0) return {};
    const auto place = [&](Angle angle) {
      return static_cast<std::size_t>(
          std::lower_bound(sorted_.begin(), sorted_.end(), angle) -
          sorted_.begin());
    };
    const Angle end = arc.begin + arc.size;
    const std::size_t first = place(arc.begin);
    const std::size_t lapped = end < arc.begin ? sorted_.size() : 0;
    return {first, place(end) + lapped - first};
  }

  template <typename Visit>
  void visit_arc(const Arc& arc, const Vec3& along, int sign,
                 Visit& visit) const {
    const Places places = places_of(arc);
    for (std::size_t i = 0; i < places.count; ++i) {
      const std::size_t place = places.first + i;
      const std::size_t lapped = place < sorted_.size() ? 0 : sorted_.size();
      const std::uint32_t g = order_[place - lapped];
      if (sign_of(along, g) == sign) visit(g, sign);
    }
  }

  const JoinedFaces& edges_;
  const JoinedFaces& faces_;
  std::span<const Angle> angles_;
  std::vector<std::uint32_t> order_;  // faces of the other, by angle
  std::vector<Angle> sorted_;         // their angles
};

// Integers under small names, most of them 0.
class Counts {
 public:
  explicit Counts(std::size_t size) : counts_(size, 0), is_met_(size, 0) {}

  void add(std::uint32_t name, int count) {
    if (is_met_[name] == 0) {
      is_met_[name] = 1;
      met_.push_back(name);
    }
    counts_[name] += count;
  }

  // visit(name, count) for those that are not 0; all are 0 afterwards.
  template <typename Visit>
  void take(Visit visit) {
    for (const std::uint32_t name : met_) {
      const int count = std::exchange(counts_[name], 0);
      is_met_[name] = 0;
      if (count != 0) visit(name, count);
    }
    met_.clear();
  }

 private:
  std::vector<int> counts_;
  std::vector<char> is_met_;
  std::vector<std::uint32_t> met_;
};

// Returns the angles of p − b, which is b turned over: there, low is high.
std::vector<Angle> negated(std::vector<Angle> angles) {
  for (Angle& angle : angles) angle = -angle;
  return angles;
}

class SurfaceSum {
 public:
  SurfaceSum(const JoinedFaces& a, const JoinedFaces& b, const Vec3& shift)
      : a_(a),
        b_(b),
        shift_(shift),
        a_angles_(seen_angles(a)),
        b_angles_(seen_angles(b)),
        a_mirrored_(negated(a_angles_)),
        b_mirrored_(negated(b_angles_)),
        a_edges_(a, a_angles_, b, b_angles_),
        b_edges_(b, b_mirrored_, a, a_mirrored_) {}

  // The facets that are left of all prisms.
  //
  // edge ⊕ g, with s = 1, has the facet (to, g), the facet (from, g) turned
  // over, and for each side of g a facet (edge, side).
  Mesh make() {
    add_moved_faces(a_, a_edges_, b_, [this](std::uint32_t a, std::uint32_t b) {
      return name(a, b);
    });
    add_moved_faces(b_, b_edges_, a_, [this](std::uint32_t b, std::uint32_t a) {
      return name(a, b);
    });
    add_parallelograms();
    return {vertices_.take_points(), std::move(triangles_)};
  }

  double count() const { return a_edges_.count() + b_edges_.count(); }

 private:
  // The vertex of the sum at a vertex of each; equal points are one vertex.
  std::uint32_t name(std::uint32_t a, std::uint32_t b) {
    return vertices_.name(a_.vertices()[a] + b_.vertices()[b] + shift_);
  }

  // Takes loop_ as often as it counts.
  void emit(int count) {
    if (count < 0) std::reverse(loop_.begin(), loop_.end());
    for (int i = 0; i < std::abs(count); ++i) {
      for (std::size_t k = 2; k < loop_.size(); ++k) {
        const std::array t{loop_[0], loop_[k - 1], loop_[k]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        triangles_.push_back(t);
      }
    }
    require_triangles(static_cast<double>(triangles_.size()));
  }

  // Faces of one surface moved by vertices of the other.
  //
  // name_of  names the sum of a vertex and a corner of a face
  template <typename Name>
  void add_moved_faces(const JoinedFaces& movers, const Summits& summits,
                       const JoinedFaces& faces, Name name_of) {
    Counts counts(faces.face_count());
    for (std::uint32_t v = 0; v < movers.vertices().size(); ++v) {
      for (const std::uint32_t e : movers.edges_at(v)) {
        const int end = movers.edges()[e].to == v ? 1 : -1;
        summits.for_each(
            e, [&](std::uint32_t g, int sign) { counts.add(g, end * sign); });
      }
      counts.take([&](std::uint32_t g, int count) {
        loop_.clear();
        for (const std::uint32_t corner : faces.corners_of(g)) {
          loop_.push_back(name_of(v, corner));
        }
        emit(count);
      });
    }
  }

  void add_parallelograms() {
    const auto lists = list_by_face();
    Counts counts(b_.edges().size());
    for (std::uint32_t e = 0; e < a_.edges().size(); ++e) {
      a_edges_.for_each(e, [&](std::uint32_t g, int sign) {
        for (const JoinedFaces::Side& side : b_.sides_of(g)) {
          counts.add(side.edge, side.is_forward ? sign : -sign);
        }
      });
      for (const JoinedFaces::EdgeFace& f : a_.faces_at(e)) {
        for (const auto& [edge, sign] : lists[f.face]) {
          counts.add(edge, f.is_forward ? -sign : sign);
        }
      }
      const auto [from, to] = a_.edges()[e];
      counts.take([&, from = from, to = to](std::uint32_t other, int count) {
        const JoinedFaces::Edge ends = b_.edges()[other];
        loop_ = {name(from, ends.from), name(from, ends.to), name(to, ends.to),
                 name(to, ends.from)};
        emit(count);
      });
    }
  }

  // The edges of b that make summits with each face of a.
  std::vector<std::vector<std::pair<std::uint32_t, int>>> list_by_face() const {
    std::vector<std::vector<std::pair<std::uint32_t, int>>> lists(
        a_.face_count());
    for (std::uint32_t e = 0; e < b_.edges().size(); ++e) {
      b_edges_.for_each(e, [&](std::uint32_t f, int sign) {
        lists[f].emplace_back(e, sign);
      });
    }
    return lists;
  }

  const JoinedFaces& a_;
  const JoinedFaces& b_;
  Vec3 shift_;
  std::vector<Angle> a_angles_;
  std::vector<Angle> b_angles_;
  std::vector<Angle> a_mirrored_;
  std::vector<Angle> b_mirrored_;
  Summits a_edges_;
  Summits b_edges_;
  VertexTable vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> loop_;  // a facet's vertices
};

}  // namespace

Mesh add_surfaces(const JoinedFaces& a, const JoinedFaces& b,
                  const Vec3& shift) {
  SurfaceSum sum(a, b, shift);
  // Most prisms leave a triangle at least.
  require_triangles(sum.count());
  return sum.make();
}

double count_summits(const JoinedFaces& a, const JoinedFaces& b) {
  return SurfaceSum(a, b, Vec3(0)).count();
}

}  // namespace lamina::csg
