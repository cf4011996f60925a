#include "ldni/section/detail/layer_index.h"

#include <utility>

namespace lamina::ldni::detail {

LayerIndex::LayerIndex(std::vector<LayerSpan> spans, std::uint32_t layer_count)
    : spans_(std::move(spans)) {
  // Lay out the cells: each level covers all layers.
  const auto level_count =
      static_cast<std::uint32_t>(std::bit_width(layer_count)) + 1;
  std::uint32_t cells = 0;
  for (std::uint32_t level = 0; level < level_count; ++level) {
    level_begins_.push_back(cells);
    cells += (layer_count >> level) + 1;
  }
  // Sort the instances into them by counting.
  const auto cell_of = [this](const LayerSpan& span) {
    const std::uint32_t level = level_of(span);
    return level_begins_[level] + (span.first >> level);
  };
  cell_begins_.assign(cells + 1, 0);
  for (const LayerSpan& span : spans_) {
    if (span.first < span.last) ++cell_begins_[cell_of(span) + 1];
  }
  for (std::uint32_t i = 0; i < cells; ++i) {
    cell_begins_[i + 1] += cell_begins_[i];
  }
  instances_.resize(cell_begins_.back());
  std::vector<std::uint32_t> next(cell_begins_.begin(), cell_begins_.end() - 1);
  for (std::uint32_t i = 0; i < spans_.size(); ++i) {
    if (spans_[i].first >= spans_[i].last) continue;
    instances_[next[cell_of(spans_[i])]++] = i;
  }
}

}  // namespace lamina::ldni::detail
