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
struct LayerRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

class LayerIndex {
 public:
  // ranges  one an instance; an empty one is never reported
  LayerIndex(std::vector<LayerRange> ranges, std::uint32_t layer_count);

  // Calls visit(instance) for each instance whose range meets `block`, always
  // in the same order whatever the block.
  template <typename Visit>
  void visit(LayerRange block, const Visit& visit_instance) const {
    if (block.first >= block.last) return;
    for (std::uint32_t level = 0; level < level_begins_.size(); ++level) {
      const std::uint32_t last_cell = (block.last - 1) >> level;
      std::uint32_t cell = block.first >> level;
      if (cell > 0) --cell;
      const std::uint32_t base = level_begins_[level];
      const std::uint32_t begin = cell_begins_[base + cell];
      const std::uint32_t end = cell_begins_[base + last_cell + 1];
      for (std::uint32_t i = begin; i < end; ++i) {
        const LayerRange& range = ranges_[instances_[i]];
        if (range.first < block.last && range.last > block.first) {
          visit_instance(instances_[i]);
        }
      }
    }
  }

 private:
  static std::uint32_t level_of(const LayerRange& range) {
    return static_cast<std::uint32_t>(
        std::bit_width(range.last - range.first - 1));
  }

  std::vector<LayerRange> ranges_;
  std::vector<std::uint32_t> level_begins_;  // of each level, in cell_begins_
  std::vector<std::uint32_t> cell_begins_;   // of each cell, in instances_
  std::vector<std::uint32_t> instances_;     // by level, cell, number
};

}  // namespace lamina::ldni::detail
