#include "slicer/contour/layer_edges.h"

#include <cmath>

namespace lamina::slicer {

void collect_edges(const plane::Contours& contours,
                   std::vector<LayerEdge>& edges) {
  edges.clear();
  edges.reserve(contours.points.size());
  for (std::uint32_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    const auto first = static_cast<std::uint32_t>(edges.size());
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 from = loop[k];
      const Vec2 step = loop[k + 1 < loop.size() ? k + 1 : 0] - from;
      const double length = std::sqrt(dot(step, step));
      if (!(length > 0)) continue;
      const auto number = static_cast<std::uint32_t>(edges.size());
      edges.push_back({from, step / length, length, number - 1, number + 1, i});
    }
    if (edges.size() == first) continue;
    edges[first].previous = static_cast<std::uint32_t>(edges.size()) - 1;
    edges.back().next = first;
  }
}

}  // namespace lamina::slicer
