#include "ldni/detail/mesh_section.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace lamina::ldni::detail {

void MeshSectioner::cut(const csg::Mesh& mesh, const Affine& world_from_leaf,
                        std::uint32_t instance, std::int32_t orientation,
                        const BlockLayers& layers, ChainBuilder& builder) {
  world_from_leaf_ = world_from_leaf;
  layers_ = &layers;
  builder_ = &builder;
  instance_ = instance;
  orientation_ = orientation;
  find_crossed(mesh);
  if (crossed_.empty()) return;
  const bool is_closed = pair_edges(mesh);
  if (!is_closed) trace_all(mesh, true);
  trace_all(mesh, false);
}

void MeshSectioner::find_crossed(const csg::Mesh& mesh) {
  layers_below_.resize(mesh.vertices.size());
  const Affine& m = world_from_leaf_;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    layers_below_[i] = layers_->layers_below((m * Vec4(mesh.vertices[i], 1)).z);
  }
  crossed_.clear();
  std::uint32_t flags = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const std::uint32_t a = layers_below_[corners[0]];
    const std::uint32_t b = layers_below_[corners[1]];
    const std::uint32_t c = layers_below_[corners[2]];
    if (a == b && b == c) continue;
    const std::uint32_t low = std::min({a, b, c});
    const std::uint32_t high = std::max({a, b, c});
    crossed_.push_back({static_cast<std::uint32_t>(t), low, high, flags});
    flags += high - low;
  }
  is_passed_.assign(flags, false);
}

// Whether every half-edge found its partner.
bool MeshSectioner::pair_edges(const csg::Mesh& mesh) {
  slots_.assign(std::bit_ceil(3 * crossed_.size()), {});
  twins_.assign(3 * crossed_.size(), kNone);
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
  bool is_closed = true;
  for (const EdgeSlot& slot : slots_) {
    for (std::uint32_t waiting = slot.waiting; waiting != kNone;) {
      is_closed = false;
      const std::uint32_t next = twins_[waiting];
      twins_[waiting] = kNone;
      waiting = next;
    }
  }
  return is_closed;
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
    const std::uint32_t twin = slot.waiting;
    slot.waiting = twins_[twin];
    twins_[twin] = half_edge;
    twins_[half_edge] = twin;
  } else {
    twins_[half_edge] = slot.waiting;
    slot.waiting = half_edge;
    slot.waits_ascending = is_ascending;
  }
}

void MeshSectioner::trace_all(const csg::Mesh& mesh, bool only_open) {
  for (std::uint32_t i = 0; i < crossed_.size(); ++i) {
    const CrossedTriangle& crossed = crossed_[i];
    for (std::uint32_t l = crossed.low; l < crossed.high; ++l) {
      if (is_passed_[crossed.first_flag + l - crossed.low]) continue;
      if (only_open && !is_entered_openly(mesh, i, l)) continue;
      if (only_open) ++open_paths_;
      trace(mesh, i, l);
    }
  }
}

// Corner whose edge to the next corner rises through the layer: the walk
// leaves there, with vertices above on its left as seen from outside.
std::uint32_t MeshSectioner::exit_corner(const csg::Mesh& mesh,
                                         std::uint32_t crossed,
                                         std::uint32_t layer) const {
  const auto& corners = mesh.triangles[crossed_[crossed].triangle];
  const bool a = is_above(corners[0], layer);
  const bool b = is_above(corners[1], layer);
  const bool c = is_above(corners[2], layer);
  return !a && b ? 0 : (!b && c ? 1 : 2);
}

bool MeshSectioner::is_entered_openly(const csg::Mesh& mesh,
                                      std::uint32_t crossed,
                                      std::uint32_t layer) const {
  const auto& corners = mesh.triangles[crossed_[crossed].triangle];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = k == 2 ? 0 : k + 1;
    if (is_above(corners[k], layer) && !is_above(corners[next], layer)) {
      return twins_[3 * crossed + k] == kNone;
    }
  }
  return false;
}

void MeshSectioner::trace(const csg::Mesh& mesh, std::uint32_t start,
                          std::uint32_t layer) {
  height_ = layers_->heights[layer];
  std::uint32_t current = start;
  do {
    const CrossedTriangle& crossed = crossed_[current];
    is_passed_[crossed.first_flag + layer - crossed.low] = true;
    const std::uint32_t corner = exit_corner(mesh, current, layer);
    const auto& corners = mesh.triangles[crossed.triangle];
    add_point(mesh, corners[corner], corners[corner == 2 ? 0 : corner + 1]);
    const std::uint32_t twin = twins_[3 * current + corner];
    if (twin == kNone) break;
    current = twin / 3;
  } while (current != start);
  builder_->close_loop(layer, instance_, orientation_);
}

// Interpolates from the lower to the higher vertex number, so that an edge
// used by several triangles gives one point.
void MeshSectioner::add_point(const csg::Mesh& mesh, std::uint32_t from,
                              std::uint32_t to) {
  if (from > to) std::swap(from, to);
  const Vec3 start = world_from_leaf_ * Vec4(mesh.vertices[from], 1);
  const Vec3 end = world_from_leaf_ * Vec4(mesh.vertices[to], 1);
  const double t =
      std::clamp((height_ - start.z) / (end.z - start.z), 0.0, 1.0);
  builder_->loop().push_back(
      {start.x + t * (end.x - start.x), start.y + t * (end.y - start.y)});
}

}  // namespace lamina::ldni::detail
