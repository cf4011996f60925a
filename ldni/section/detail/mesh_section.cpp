#include "ldni/section/detail/mesh_section.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

namespace lamina::ldni::detail {

void MeshSectioner::cut(const csg::Mesh& mesh, const MeshIndex& index,
                        const Affine& world_from_leaf, std::uint32_t instance,
                        std::int32_t orientation, const BlockLayers& layers,
                        plane::ChainBuilder& builder) {
  mesh_ = &mesh;
  world_from_leaf_ = world_from_leaf;
  layers_ = &layers;
  builder_ = &builder;
  instance_ = instance;
  orientation_ = orientation;
  count_layers_below(index);
  find_crossed(index);
  if (crossed_.empty()) return;
  const bool is_closed = pair_edges();
  if (!is_closed) trace_all(true);
  trace_all(false);
}

void MeshSectioner::count_layers_below(const MeshIndex& index) {
  const csg::Mesh& mesh = *mesh_;
  layers_below_.resize(mesh.vertices.size());
  const LayerSpan block = layers_->span();
  index.vertices.for_each([&](LayerSpan layers, std::size_t begin,
                              std::size_t end) {
    if (!layers.meets(block)) {
      const std::uint32_t below =
          std::clamp(layers.first, block.first, block.last) - block.first;
      std::fill(layers_below_.data() + begin, layers_below_.data() + end,
                below);
      return;
    }
    for (std::size_t i = begin; i < end; ++i) {
      layers_below_[i] =
          layers_->layers_below(height_of(world_from_leaf_, mesh.vertices[i]));
    }
  });
}

void MeshSectioner::find_crossed(const MeshIndex& index) {
  const csg::Mesh& mesh = *mesh_;
  const LayerSpan block = layers_->span();
  crossed_.clear();
  flag_count_ = 0;
  index.triangles.for_each(
      [&](LayerSpan layers, std::size_t begin, std::size_t end) {
        if (!layers.meets(block)) return;
        for (std::size_t i = begin; i < end; ++i) {
          const auto& corners = mesh.triangles[i];
          const std::uint32_t a = layers_below_[corners[0]];
          const std::uint32_t b = layers_below_[corners[1]];
          const std::uint32_t c = layers_below_[corners[2]];
          if (a == b && b == c) continue;
          const LayerSpan crossing{std::min({a, b, c}), std::max({a, b, c})};
          crossed_.push_back(
              {static_cast<std::uint32_t>(i), crossing, flag_count_});
          flag_count_ += crossing.last - crossing.first;
        }
      });
  is_passed_.assign(flag_count_, false);
}

// Whether every half-edge found its partner.
bool MeshSectioner::pair_edges() {
  const csg::Mesh& mesh = *mesh_;
  // A triangle that one layer crosses has two crossed edges, each of them
  // shared; no triangle has more than three. So a quarter of the slots is free.
  slots_.assign(std::bit_ceil(2 * crossed_.size()), {});
  partners_.assign(3 * crossed_.size(), kNone);
  waiting_count_ = 0;
  for (std::uint32_t i = 0; i < crossed_.size(); ++i) {
    const auto& corners = mesh.triangles[crossed_[i].triangle];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k];
      const std::uint32_t to = corners[k == 2 ? 0 : k + 1];
      if (layers_below_[from] != layers_below_[to]) {
        pair_edge(from, to, 3 * i + k);
      }
    }
  }
  if (waiting_count_ == 0) return true;
  for (const EdgeSlot& slot : slots_) {
    for (std::uint32_t waiting = slot.waiting; waiting != kNone;) {
      waiting = std::exchange(partners_[waiting], kNone);
    }
  }
  return false;
}

void MeshSectioner::pair_edge(std::uint32_t from, std::uint32_t to,
                              std::uint32_t half_edge) {
  const bool is_ascending = from < to;
  const std::uint64_t key = is_ascending ? std::uint64_t{from} << 32 | to
                                         : std::uint64_t{to} << 32 | from;
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = (key * 0x9e3779b97f4a7c15U >> 20) & mask;
  while (slots_[i].key != kFree && slots_[i].key != key) i = (i + 1) & mask;
  EdgeSlot& slot = slots_[i];
  slot.key = key;
  if (slot.waiting != kNone && slot.waits_ascending != is_ascending) {
    const std::uint32_t partner = slot.waiting;
    slot.waiting = partners_[partner];
    partners_[partner] = half_edge;
    partners_[half_edge] = partner;
    --waiting_count_;
  } else {
    partners_[half_edge] = slot.waiting;
    slot.waiting = half_edge;
    slot.waits_ascending = is_ascending;
    ++waiting_count_;
  }
}

void MeshSectioner::trace_all(bool only_open) {
  for (std::uint32_t i = 0; i < crossed_.size(); ++i) {
    const CrossedTriangle& crossed = crossed_[i];
    for (std::uint32_t l = crossed.layers.first; l < crossed.layers.last; ++l) {
      if (is_passed_[crossed.first_flag + l - crossed.layers.first]) continue;
      if (only_open && !is_entered_openly(i, l)) continue;
      if (only_open) ++open_paths_;
      trace(i, l);
    }
  }
}

// Corner whose edge to the next corner rises through the layer: the walk
// leaves there, with vertices above on its left as seen from outside.
std::uint32_t MeshSectioner::exit_corner(std::uint32_t crossed,
                                         std::uint32_t layer) const {
  const auto& corners = mesh_->triangles[crossed_[crossed].triangle];
  const bool a = is_above(corners[0], layer);
  const bool b = is_above(corners[1], layer);
  const bool c = is_above(corners[2], layer);
  return !a && b ? 0 : (!b && c ? 1 : 2);
}

bool MeshSectioner::is_entered_openly(std::uint32_t crossed,
                                      std::uint32_t layer) const {
  const auto& corners = mesh_->triangles[crossed_[crossed].triangle];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = k == 2 ? 0 : k + 1;
    if (is_above(corners[k], layer) && !is_above(corners[next], layer)) {
      return partners_[3 * crossed + k] == kNone;
    }
  }
  return false;
}

void MeshSectioner::trace(std::uint32_t start, std::uint32_t layer) {
  height_ = layers_->heights[layer];
  below_.vertex = kNone;
  above_.vertex = kNone;
  std::uint32_t current = start;
  do {
    const CrossedTriangle& crossed = crossed_[current];
    is_passed_[crossed.first_flag + layer - crossed.layers.first] = true;
    const std::uint32_t corner = exit_corner(current, layer);
    const auto& corners = mesh_->triangles[crossed.triangle];
    add_point(corners[corner], corners[corner == 2 ? 0 : corner + 1]);
    const std::uint32_t partner = partners_[3 * current + corner];
    if (partner == kNone) break;
    current = partner / 3;
  } while (current != start);
  builder_->close_loop(layer, instance_, orientation_);
}

// Interpolates from the lower to the higher vertex number, so that an edge
// used by several triangles gives one point. One end is that of the edge
// before.
void MeshSectioner::add_point(std::uint32_t below, std::uint32_t above) {
  const auto place = [&](End& end, std::uint32_t vertex) {
    if (end.vertex == vertex) return;
    end = {vertex, world_from_leaf_ * Vec4(mesh_->vertices[vertex], 1)};
  };
  place(below_, below);
  place(above_, above);
  const Vec3& start = below < above ? below_.place : above_.place;
  const Vec3& end = below < above ? above_.place : below_.place;
  const double t =
      std::clamp((height_ - start.z) / (end.z - start.z), 0.0, 1.0);
  builder_->loop().push_back(
      {start.x + t * (end.x - start.x), start.y + t * (end.y - start.y)});
}

}  // namespace lamina::ldni::detail
