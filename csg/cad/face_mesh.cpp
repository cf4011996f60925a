#include "csg/cad/detail/face_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "csg/cad/detail/deviation.h"

namespace lamina::cad {
namespace {

using Index = std::uint32_t;

class Refiner {
 public:
  Refiner(const TopoDS_Face& face, double chordal_error, FaceMesh& mesh)
      : surface_(face),
        chordal_error_(chordal_error),
        mesh_(mesh),
        first_new_(mesh.points.size()),
        progress_(mesh.triangles.size()) {}

  double refine() {
    if (surface_.is_plane() || mesh_.uv.empty()) return 0;
    for (Index i = 0; i < mesh_.triangles.size(); ++i) doubtful_.push_back(i);
    double greatest = 0;
    while (!doubtful_.empty()) {
      const Index triangle = doubtful_.back();
      doubtful_.pop_back();
      const Deviation deviation = deviation_of(triangle);
      if (deviation.greatest <= chordal_error_) continue;
      if (!gains(triangle, deviation.greatest) || !split(deviation.side)) {
        greatest = std::max(greatest, deviation.greatest);
      }
    }
    return greatest;
  }

 private:
  static constexpr Index kNone = ~Index{0};

  // A side of a triangle: from corner k to the next.
  struct Side {
    Index triangle;
    std::size_t k;
  };
  // The triangles at a side, in any order.
  using Pair = std::array<Index, 2>;

  struct Deviation {
    double greatest = 0;
    Side side;  // the one to split
  };

  // How far what a triangle is a part of was off, and how many splits ago.
  struct Progress {
    double before = std::numeric_limits<double>::infinity();
    int splits = 0;
  };

  // The side to split is that whose middle is farthest off, so that a narrow
  // triangle is not cut across first; or else the longest.
  Deviation deviation_of(Index triangle) const {
    // The middles of the sides, that of all, and between each and that.
    constexpr double kShares[7][3] = {
        {0.5, 0.5, 0},     {0, 0.5, 0.5},
        {0.5, 0, 0.5},     {1. / 3, 1. / 3, 1. / 3},
        {0.25, 0.25, 0.5}, {0.25, 0.5, 0.25},
        {0.5, 0.25, 0.25}};
    const auto& corners = mesh_.triangles[triangle];
    Deviation deviation{0, longest_side(triangle)};
    for (std::size_t i = 0; i < 7; ++i) {
      const auto& share = kShares[i];
      gp_XYZ p;
      gp_XY at;
      for (std::size_t k = 0; k < 3; ++k) {
        p += mesh_.points[corners[k]].XYZ() * share[k];
        at += mesh_.uv[corners[k]] * share[k];
      }
      const double distance = surface_.distance(p, at, chordal_error_);
      if (i < 3 && distance > std::max(chordal_error_, deviation.greatest)) {
        deviation.side.k = i;
      }
      deviation.greatest = std::max(deviation.greatest, distance);
    }
    return deviation;
  }

  // Whether splits bring it nearer to the surface. Of a smooth one two bring it
  // four times as near; but where an edge of the face is off the surface, as
  // many programs write it, none do.
  bool gains(Index triangle, double deviation) {
    constexpr int kPatience = 6;
    Progress& progress = progress_[triangle];
    if (std::isinf(progress.before) || progress.splits >= kPatience) {
      if (deviation > progress.before / 2) return false;
      progress = {deviation, 0};
    }
    return true;
  }

  // Returns false for a triangle that is small enough to be left, or where many
  // have been split already.
  bool split(Side side) {
    constexpr std::size_t kMostNew = 100000;
    if (length(side) < chordal_error_ / 2) return false;
    if (mesh_.points.size() - first_new_ > kMostNew) return false;
    if (pairs_.empty()) find_pairs();
    const Index other = neighbour(side);
    if (other == kNone) {
      split_at_middle(side.triangle);
    } else {
      split_pair(side, other);
    }
    return true;
  }

  double length(Side side) const {
    return mesh_.points[from(side)].Distance(mesh_.points[to(side)]);
  }
  Index from(Side side) const { return mesh_.triangles[side.triangle][side.k]; }
  Index to(Side side) const {
    return mesh_.triangles[side.triangle][(side.k + 1) % 3];
  }
  Index beside(Side side) const {
    return mesh_.triangles[side.triangle][(side.k + 2) % 3];
  }

  Side longest_side(Index triangle) const {
    Side longest{triangle, 0};
    for (const std::size_t k : {1U, 2U}) {
      if (length({triangle, k}) > length(longest)) longest.k = k;
    }
    return longest;
  }

  static std::uint64_t key(Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    return std::uint64_t{high} << 32 | low;
  }

  // Only where something is to be split: most faces need none of this.
  void find_pairs() {
    for (Index i = 0; i < mesh_.triangles.size(); ++i) {
      for (const std::size_t k : {0U, 1U, 2U}) {
        const Side side{i, k};
        Pair& pair =
            pairs_.try_emplace(key(from(side), to(side)), Pair{kNone, kNone})
                .first->second;
        (pair[0] == kNone ? pair[0] : pair[1]) = i;
      }
    }
  }

  Index neighbour(Side side) const {
    const Pair& pair = pairs_.at(key(from(side), to(side)));
    return pair[0] == side.triangle ? pair[1] : pair[0];
  }

  // At a side that `now` has instead of `before`.
  void replace(Index a, Index b, Index before, Index now) {
    Pair& pair = pairs_.at(key(a, b));
    (pair[0] == before ? pair[0] : pair[1]) = now;
  }

  Index add_point(gp_XY uv) {
    mesh_.points.push_back(surface_.at(uv));
    mesh_.uv.push_back(uv);
    return static_cast<Index>(mesh_.points.size() - 1);
  }
  Index add_triangle(Index a, Index b, Index c, Index part_of) {
    mesh_.triangles.push_back({a, b, c});
    progress_.push_back(progress_[part_of]);
    return static_cast<Index>(mesh_.triangles.size() - 1);
  }
  void set(Index triangle, Index a, Index b, Index c) {
    mesh_.triangles[triangle] = {a, b, c};
    doubtful_.push_back(triangle);
  }

  //     c              c
  //    / \            /|\       The triangle becomes (a, m, c),
  //   a───b    ▶     a─m─b      the other one (m, a, d);
  //    \ /            \|/       (m, b, c) and (b, m, d) are new.
  //     d              d
  void split_pair(Side side, Index other) {
    const Index triangle = side.triangle;
    const Index a = from(side);
    const Index b = to(side);
    const Index c = beside(side);
    Index d = kNone;
    for (const Index corner : mesh_.triangles[other]) {
      if (corner != a && corner != b) d = corner;
    }
    const Index m = add_point((mesh_.uv[a] + mesh_.uv[b]) * 0.5);
    ++progress_[triangle].splits;
    ++progress_[other].splits;
    set(triangle, a, m, c);
    set(other, m, a, d);
    const Index third = add_triangle(m, b, c, triangle);
    const Index fourth = add_triangle(b, m, d, other);
    doubtful_.push_back(third);
    doubtful_.push_back(fourth);
    replace(b, c, triangle, third);
    replace(b, d, other, fourth);
    pairs_.erase(key(a, b));
    pairs_[key(a, m)] = {triangle, other};
    pairs_[key(m, b)] = {third, fourth};
    pairs_[key(m, c)] = {triangle, third};
    pairs_[key(m, d)] = {other, fourth};
  }

  void split_at_middle(Index triangle) {
    const auto [a, b, c] = mesh_.triangles[triangle];
    const Index m =
        add_point((mesh_.uv[a] + mesh_.uv[b] + mesh_.uv[c]) * (1. / 3));
    ++progress_[triangle].splits;
    set(triangle, a, b, m);
    const Index second = add_triangle(b, c, m, triangle);
    const Index third = add_triangle(c, a, m, triangle);
    doubtful_.push_back(second);
    doubtful_.push_back(third);
    replace(b, c, triangle, second);
    replace(c, a, triangle, third);
    pairs_[key(a, m)] = {triangle, third};
    pairs_[key(b, m)] = {triangle, second};
    pairs_[key(c, m)] = {second, third};
  }

  Surface surface_;
  double chordal_error_;
  FaceMesh& mesh_;
  std::size_t first_new_;           // of the points
  std::vector<Progress> progress_;  // of the triangles
  std::vector<Index> doubtful_;
  std::unordered_map<std::uint64_t, Pair> pairs_;  // by side
};

}  // namespace

FaceMesh face_mesh(const TopoDS_Face& face,
                   const Poly_Triangulation& triangulation,
                   const TopLoc_Location& place) {
  FaceMesh mesh;
  for (int i = 1; i <= triangulation.NbNodes(); ++i) {
    mesh.points.push_back(triangulation.Node(i).Transformed(place));
    if (triangulation.HasUVNodes()) {
      mesh.uv.push_back(triangulation.UVNode(i).XY());
    }
  }
  const bool is_turned = (face.Orientation() == TopAbs_REVERSED) !=
                         place.Transformation().IsNegative();
  for (int i = 1; i <= triangulation.NbTriangles(); ++i) {
    int nodes[3];
    triangulation.Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    if (is_turned) std::swap(nodes[1], nodes[2]);
    mesh.triangles.push_back({static_cast<Index>(nodes[0] - 1),
                              static_cast<Index>(nodes[1] - 1),
                              static_cast<Index>(nodes[2] - 1)});
  }
  return mesh;
}

double refine(const TopoDS_Face& face, double chordal_error, FaceMesh& mesh) {
  return Refiner(face, chordal_error, mesh).refine();
}

}  // namespace lamina::cad
