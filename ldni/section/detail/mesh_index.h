#pragma once
// Which parts of a mesh a block of layers meets.
//
// A mesh has a million triangles and a block of layers crosses few of them. So
// the index groups triangles, and vertices likewise, into runs that are
// together in the mesh, and knows for each run the layers between its lowest
// and its highest vertex. Meshes from files come in some order along the
// surface, so a run is a small patch of it; where they do not, every run is
// opened, and nothing but time is lost.
//
// Each instance has an index of its own, made in one pass over the mesh. It
// takes 0.4 bytes for a triangle, where the mesh, which instances share,
// has 24.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/scene.h"
#include "ldni/section/grid.h"

namespace lamina::ldni::detail {

// Height in the world of a point of the leaf: the third row of the product.
inline double height_of(const Affine& world_from_leaf, const Vec3& point) {
  const Affine& m = world_from_leaf;
  return m[0].z * point.x + m[1].z * point.y + m[2].z * point.z + m[3].z;
}

// Layers [first, last).
struct LayerSpan {
  std::uint32_t first = 0;
  std::uint32_t last = 0;

  bool meets(const LayerSpan& other) const {
    return std::max(first, other.first) < std::min(last, other.last);
  }
};

// Heights from the lowest to the highest point.
struct HeightRange {
  double low = 0;
  double high = 0;
};

// Runs of so many things that are together in the mesh, the last one shorter.
class LayerRuns {
 public:
  // Groups `count` things; thing i has the heights heights_of(i).
  template <typename HeightsOf>
  void group(std::size_t count, const LayerGrid& grid,
             const HeightsOf& heights_of) {
    count_ = count;
    spans_.reserve(count / kLength + 1);
    for (std::size_t begin = 0; begin < count; begin += kLength) {
      HeightRange whole = heights_of(begin);
      for (std::size_t i = begin + 1; i < end_of(begin); ++i) {
        const HeightRange heights = heights_of(i);
        whole.low = std::min(whole.low, heights.low);
        whole.high = std::max(whole.high, heights.high);
      }
      spans_.push_back(
          {grid.layers_below(whole.low), grid.layers_below(whole.high)});
    }
  }

  // Calls visit(layers, begin, end) for each run of things [begin, end), with
  // the layers of the job that pass between its lowest and highest point.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      visit(spans_[i], i * kLength, end_of(i * kLength));
    }
  }

 private:
  static constexpr std::size_t kLength = 32;

  std::size_t end_of(std::size_t begin) const {
    return std::min(begin + kLength, count_);
  }

  std::size_t count_ = 0;
  std::vector<LayerSpan> spans_;
};

// The runs of one mesh of one instance.
struct MeshIndex {
  LayerRuns vertices;
  LayerRuns triangles;
};

MeshIndex index_mesh(const csg::Mesh& mesh, const Affine& world_from_leaf,
                     const LayerGrid& grid);

}  // namespace lamina::ldni::detail
