#pragma once
// Which instances reach a block of layers, for scenes of very many instances.
//
// Intervals of layers live on levels: level v holds those longer than
// 2^(v-1) and no longer than 2^v layers, bucketed into cells of 2^v layers by
// their first layer. An interval thus ends in its own cell or the next one, so
// a block asks few cells on each level, and every interval is stored once.

#include <bit>
#include <cstdint>
#include <vector>

namespace lamina::ldni::detail {

// Layers [first, last).
struct LayerSpan {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

class LayerIndex {
 public:
  // spans  one an instance; an empty one is never reported
  LayerIndex(std::vector<LayerSpan> spans, std::uint32_t layer_count);

  // Calls visit(instance) for each instance whose span meets `block`, always
  // in the same order whatever the block.
  template <typename Visit>
  void visit(LayerSpan block, const Visit& visit_instance) const {
    if (block.first >= block.last) return;
    for (std::uint32_t level = 0; level < level_begins_.size(); ++level) {
      const std::uint32_t last_cell = (block.last - 1) >> level;
      std::uint32_t cell = block.first >> level;
      if (cell > 0) --cell;
      const std::uint32_t base = level_begins_[level];
      const std::uint32_t begin = cell_begins_[base + cell];
      const std::uint32_t end = cell_begins_[base + last_cell + 1];
      for (std::uint32_t i = begin; i < end; ++i) {
        const LayerSpan& span = spans_[instances_[i]];
        if (span.first < block.last && span.last > block.first) {
          visit_instance(instances_[i]);
        }
      }
    }
  }

 private:
  static std::uint32_t level_of(const LayerSpan& span) {
    return static_cast<std::uint32_t>(
        std::bit_width(span.last - span.first - 1));
  }

  std::vector<LayerSpan> spans_;
  std::vector<std::uint32_t> level_begins_;  // of each level, in cell_begins_
  std::vector<std::uint32_t> cell_begins_;   // of each cell, in instances_
  std::vector<std::uint32_t> instances_;     // by level, cell, number
};

}  // namespace lamina::ldni::detail
