#include "csg/mesh/fill_hole.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace lamina::csg {
namespace {

// The search for the least area takes time with the cube of the edges.
constexpr std::size_t kMostSearched = 128;

// The search for the narrowest place takes time with the square of the edges;
// of longer loops it looks at so many vertices, evenly.
constexpr std::size_t kMostLooks = 1024;

double area_of(Vec3 a, Vec3 b, Vec3 c) {
  return glm::length(glm::cross(b - a, c - a)) / 2;
}

// The triangulation of least area of a polygon in space, by the best third
// corner over each of its chords.
class LeastArea {
 public:
  LeastArea(Mesh& mesh, std::span<const std::uint32_t> loop)
      : mesh_(mesh), loop_(loop), chords_(loop.size() * loop.size()) {
    for (std::size_t length = 2; length < loop.size(); ++length) {
      for (std::size_t i = 0; i + length < loop.size(); ++i) {
        search(i, i + length);
      }
    }
  }

  void add_triangles() { add(0, loop_.size() - 1); }

 private:
  struct Chord {
    double area = 0;  // beyond it
    std::size_t corner = 0;
  };
  Chord& chord(std::size_t i, std::size_t k) {
    return chords_[i * loop_.size() + k];
  }
  Vec3 at(std::size_t i) const { return mesh_.vertices[loop_[i]]; }

  void search(std::size_t i, std::size_t k) {
    // Areas beyond all numbers leave any corner.
    Chord& best = chord(i, k);
    best = {std::numeric_limits<double>::infinity(), i + 1};
    for (std::size_t corner = i + 1; corner < k; ++corner) {
      const double area = chord(i, corner).area + chord(corner, k).area +
                          area_of(at(i), at(corner), at(k));
      if (area < best.area) best = {area, corner};
    }
  }

  void add(std::size_t i, std::size_t k) {
    std::vector<std::pair<std::size_t, std::size_t>> open{{i, k}};
    while (!open.empty()) {
      std::tie(i, k) = open.back();
      open.pop_back();
      if (k == i + 1) continue;
      const std::size_t corner = chord(i, k).corner;
      mesh_.triangles.push_back({loop_[i], loop_[corner], loop_[k]});
      open.push_back({i, corner});
      open.push_back({corner, k});
    }
  }

  Mesh& mesh_;
  std::span<const std::uint32_t> loop_;
  std::vector<Chord> chords_;  // from i to k > i
};

// Two vertices of the loop that are near each other in space and far from each
// other on it: those of the least such ratio.
std::pair<std::size_t, std::size_t> narrowest_place(
    const Mesh& mesh, std::span<const std::uint32_t> loop) {
  const std::size_t n = loop.size();
  const std::size_t step = (n + kMostLooks - 1) / kMostLooks;
  std::vector<double> ways(n + 1);  // along the loop
  for (std::size_t i = 0; i < n; ++i) {
    ways[i + 1] = ways[i] + glm::distance(mesh.vertices[loop[i]],
                                          mesh.vertices[loop[(i + 1) % n]]);
  }
  // Each part takes a fair share of the edges, so that parting ends soon.
  const std::size_t least_part = n / 8;
  std::pair<std::size_t, std::size_t> best{0, n / 2};
  double least_ratio = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; i += step) {
    for (std::size_t k = i + least_part; k < n && n - (k - i) >= least_part;
         k += step) {
      const double way = ways[k] - ways[i];
      const double around = std::min(way, ways[n] - way);
      const double across =
          glm::distance(mesh.vertices[loop[i]], mesh.vertices[loop[k]]);
      if (!(across < least_ratio * around)) continue;
      least_ratio = across / around;
      best = {i, k};
    }
  }
  return best;
}

}  // namespace

void fill_hole(Mesh& mesh, std::span<const std::uint32_t> loop) {
  std::vector<std::vector<std::uint32_t>> parts{{loop.begin(), loop.end()}};
  while (!parts.empty()) {
    const std::vector<std::uint32_t> part = std::move(parts.back());
    parts.pop_back();
    if (part.size() <= kMostSearched) {
      LeastArea(mesh, part).add_triangles();
      continue;
    }
    const auto [i, k] = narrowest_place(mesh, part);
    const auto first = part.begin() + static_cast<std::ptrdiff_t>(i);
    const auto second = part.begin() + static_cast<std::ptrdiff_t>(k);
    parts.emplace_back(first, second + 1);
    std::vector<std::uint32_t>& rest = parts.emplace_back(second, part.end());
    rest.insert(rest.end(), part.begin(), first + 1);
  }
}

}  // namespace lamina::csg
