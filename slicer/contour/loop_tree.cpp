#include "slicer/contour/loop_tree.h"

#include <glm/common.hpp>

namespace lamina::slicer {

void LoopTree::Node::add(const Node& other) {
  low = least(low, other.low);
  high = greatest(high, other.high);
  if (loop == other.loop && loop != kNone) {
    least_step = least(least_step, other.least_step);
    greatest_step = greatest(greatest_step, other.greatest_step);
  } else {
    // The edges do not follow each other: they advance nowhere.
    least_step = both_lanes(-1e300);
    greatest_step = both_lanes(1e300);
    loop = kNone;
  }
}

bool LoopTree::follow_apart(const Node& a, const Node& b, double reach) const {
  if (a.loop != b.loop || a.loop == kNone) return false;
  Node both = a;
  both.add(b);
  return both.advances(reach);
}

// False where the node's box is apart from it in x, in y or across the segment.
bool LoopTree::Strip::meets(const Node& node) const {
  if (holds_for_any((node.low > high) | (node.high < low))) return false;
  const Lanes centre = (node.low + node.high) * 0.5 - middle;
  const Lanes half = (node.high - node.low) * 0.5;
  const double across = along.x * centre[1] - along.y * centre[0];
  return std::abs(across) <=
         reach + std::abs(along.x) * half[1] + std::abs(along.y) * half[0];
}

void LoopTree::fill(std::span<const Vec2> points,
                    std::span<const std::uint32_t> vertices,
                    std::span<const std::uint32_t> ends) {
  points_ = points;
  vertices_ = vertices;
  ends_ = ends;
  bundles_.clear();
  nodes_.clear();
  bundle_of_.resize(vertices.size());
  sort_loops();
  for (const auto& [place, loop] : order_) add_bundles(loop);
  build_levels();
}

// Sorts loops by place: into strips in x, and in a strip by y, so that loops
// near each other are mostly neighbours.
void LoopTree::sort_loops() {
  order_.clear();
  Box2 box;
  for (std::uint32_t l = 0; l < ends_.size(); ++l) {
    order_.push_back({0, l});
    box.add(points_[vertices_[loop_begin(l)]]);
  }
  if (order_.size() < 3) return;
  const double strips = std::sqrt(static_cast<double>(order_.size()));
  const Vec2 size = glm::max(box.size(), Vec2(1e-9));
  for (auto& [place, l] : order_) {
    const Vec2 at = (points_[vertices_[loop_begin(l)]] - box.low) / size;
    const auto strip = static_cast<std::uint64_t>(at.x * strips);
    place = strip << 32 | static_cast<std::uint32_t>(at.y * 0x1p31);
  }
  std::ranges::sort(order_);
}

void LoopTree::add_bundles(std::uint32_t loop) {
  const std::uint32_t last = ends_[loop] - 1;  // the copy of the first vertex
  for (std::uint32_t k = loop_begin(loop); k < last; k += kEdgesPerBundle) {
    const std::uint32_t end = std::min(k + kEdgesPerBundle, last);
    std::fill(bundle_of_.begin() + k, bundle_of_.begin() + end,
              static_cast<std::uint32_t>(bundles_.size()));
    bundles_.push_back({k, end, loop});
    nodes_.push_back(measure(bundles_.back()));
  }
}

LoopTree::Node LoopTree::measure(const Bundle& bundle) const {
  Node node;
  node.loop = bundle.loop;
  const Vec2* point = &points_[vertices_[bundle.begin]];
  const Vec2* last = &points_[vertices_[bundle.end]];
  Lanes before = lanes_of(*point);
  node.low = node.high = before;
  while (point != last) {
    const Lanes here = lanes_of(*++point);
    const Lanes step = here - before;
    node.low = least(node.low, here);
    node.high = greatest(node.high, here);
    node.least_step = least(node.least_step, step);
    node.greatest_step = greatest(node.greatest_step, step);
    before = here;
  }
  return node;
}

void LoopTree::build_levels() {
  level_begins_.assign(1, 0);
  level_begins_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  while (node_count(top()) > 1) {
    const std::uint32_t begin = level_begins_[top()];
    const std::uint32_t end = level_begins_.back();
    for (std::uint32_t i = begin; i < end; i += 2) {
      Node parent = nodes_[i];
      if (i + 1 < end) parent.add(nodes_[i + 1]);
      nodes_.push_back(parent);
    }
    level_begins_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  }
}

}  // namespace lamina::slicer
