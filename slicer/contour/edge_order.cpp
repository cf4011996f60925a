#include "slicer/contour/edge_order.h"

#include <algorithm>

#include "plane/predicates.h"

namespace lamina::slicer {

void EdgeOrder::add(Vec2 from, Vec2 to, std::uint32_t loop) {
  const bool runs_right = from.x < to.x;
  edges_.push_back({runs_right ? from : to, runs_right ? to : from, loop,
                    runs_right ? 1 : -1});
}

bool EdgeOrder::is_below(const Edge& a, const Edge& b) {
  int side = a.left.x < b.left.x ? orientation(a.left, a.right, b.left)
                                 : -orientation(b.left, b.right, a.left);
  if (side == 0) {
    side = a.right.x > b.right.x ? orientation(a.left, a.right, b.right)
                                 : -orientation(b.left, b.right, a.right);
  }
  return side > 0;
}

std::size_t EdgeOrder::interval_of(double x) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(ends_, x) -
                                  ends_.begin());
}

template <typename Visit>
void EdgeOrder::visit_nodes(const Edge& edge, const Visit& visit) const {
  const std::size_t leaves = ends_.size() + 1;
  std::size_t first = interval_of(edge.left.x) + leaves;
  std::size_t end = interval_of(edge.right.x) + leaves;
  for (; first < end; first /= 2, end /= 2) {
    if (first % 2 == 1) visit(first++);
    if (end % 2 == 1) visit(--end);
  }
}

void EdgeOrder::build() {
  for (const Edge& edge : edges_) {
    ends_.push_back(edge.left.x);
    ends_.push_back(edge.right.x);
  }
  std::ranges::sort(ends_);
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    visit_nodes(edges_[i], [&](std::size_t node) {
      entries_.push_back(
          {static_cast<std::uint32_t>(node), i, edges_[i].winding});
    });
  }
  // Merging bears edges that rounding made cross all the same.
  std::ranges::stable_sort(entries_, [this](const Entry& a, const Entry& b) {
    return a.node != b.node ? a.node < b.node
                            : is_below(edges_[a.edge], edges_[b.edge]);
  });
  starts_.assign(2 * (ends_.size() + 1) + 1, 0);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    if (i > 0 && entries_[i - 1].node == entry.node) {
      entry.winding += entries_[i - 1].winding;
    }
    starts_[entry.node + 1] = i + 1;
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) {
    starts_[i] = std::max(starts_[i], starts_[i - 1]);
  }
}

// Finds what lies below at x: in each node the edges before the first that
// is_above(edge) holds for.
template <typename IsAbove>
EdgeOrder::Below EdgeOrder::find(double x, const IsAbove& is_above) const {
  Below below;
  for (std::size_t node = interval_of(x) + ends_.size() + 1; node > 0;
       node /= 2) {
    const std::span<const Entry> entries = std::span(entries_).subspan(
        starts_[node], starts_[node + 1] - starts_[node]);
    const auto above = std::ranges::partition_point(
        entries,
        [&](const Entry& entry) { return !is_above(edges_[entry.edge]); });
    if (above == entries.begin()) continue;
    const Entry& last = *(above - 1);
    below.winding += last.winding;
    const Edge& edge = edges_[last.edge];
    if (below.nearest == nullptr || is_below(*below.nearest, edge)) {
      below.nearest = &edge;
    }
  }
  return below;
}

EdgeOrder::Below EdgeOrder::below(Vec2 point) const {
  return find(point.x, [point](const Edge& edge) {
    return orientation(edge.left, edge.right, point) <= 0;
  });
}

EdgeOrder::Below EdgeOrder::below(const Edge& edge) const {
  return find(edge.left.x,
              [&edge](const Edge& other) { return !is_below(other, edge); });
}

}  // namespace lamina::slicer
