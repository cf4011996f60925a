#pragma once
// Sections of a closed triangle mesh.
//
// Only triangles with vertices on both sides of some layer of the block take
// part; in a fine mesh they are few, and its index finds them. Their
// edges meet in a hash table keyed by the two vertices, which pairs each
// directed edge with one of the opposite direction; where an edge is used more
// often any such pairing gives closed loops. A walk then goes from triangle to
// triangle, layer by layer.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/scene.h"
#include "ldni/section/detail/loft_section.h"
#include "ldni/section/detail/mesh_index.h"
#include "plane/chain_builder.h"

namespace lamina::ldni::detail {

class MeshSectioner {
 public:
  // Adds the chains of one mesh of one instance. orientation: -1 where the
  // instance's matrix mirrors.
  void cut(const csg::Mesh& mesh, const MeshIndex& index,
           const Affine& world_from_leaf, std::uint32_t instance,
           std::int32_t orientation, const BlockLayers& layers,
           plane::ChainBuilder& builder);

  // Open paths closed since construction.
  std::uint64_t open_paths() const { return open_paths_; }

 private:
  // A triangle that layers cross, and where its flags begin.
  struct CrossedTriangle {
    std::uint32_t triangle = 0;
    LayerSpan layers;
    std::uint32_t first_flag = 0;
  };
  // One hash slot an undirected edge; half-edges (3 · crossed + corner) that
  // wait for a partner form a list through partners_.
  struct EdgeSlot {
    std::uint64_t key = kFree;
    std::uint32_t waiting = kNone;
    bool waits_ascending = false;
  };
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  static constexpr std::uint32_t kNone = 0xffffffff;

  void count_layers_below(const MeshIndex& index);
  void find_crossed(const MeshIndex& index);
  bool pair_edges();
  void pair_edge(std::uint32_t from, std::uint32_t to, std::uint32_t half_edge);
  bool is_entered_openly(std::uint32_t crossed, std::uint32_t layer) const;
  void trace_all(bool only_open);
  void trace(std::uint32_t crossed, std::uint32_t layer);
  std::uint32_t exit_corner(std::uint32_t crossed, std::uint32_t layer) const;
  void add_point(std::uint32_t below, std::uint32_t above);

  bool is_above(std::uint32_t vertex, std::uint32_t layer) const {
    return layers_below_[vertex] > layer;
  }

  const csg::Mesh* mesh_ = nullptr;
  Affine world_from_leaf_{1.0};
  const BlockLayers* layers_ = nullptr;
  plane::ChainBuilder* builder_ = nullptr;
  std::uint32_t instance_ = 0;
  std::int32_t orientation_ = 1;
  // An end of the edge that a walk crossed last.
  struct End {
    std::uint32_t vertex = kNone;
    Vec3 place{0};  // in the world
  };
  End below_;
  End above_;
  double height_ = 0;
  std::uint64_t open_paths_ = 0;
  std::vector<std::uint32_t> layers_below_;  // a vertex
  std::vector<CrossedTriangle> crossed_;
  std::vector<std::uint32_t> partners_;  // a half-edge; kNone: open
  std::vector<EdgeSlot> slots_;
  std::size_t waiting_count_ = 0;  // half-edges in slots_
  std::vector<bool> is_passed_;
  std::uint32_t flag_count_ = 0;
};

}  // namespace lamina::ldni::detail
