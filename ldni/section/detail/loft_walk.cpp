// Loops that cross rings, of outlines that are not monotone: a walk from quad
// to quad (loft_section.h).

#include <algorithm>
#include <cstddef>

#include "ldni/section/detail/loft_section.h"

namespace lamina::ldni::detail {

void LoftSectioner::cut_all_crossings() {
  find_crossed_edges();
  for (const CrossedEdge& crossed : crossed_edges_) {
    for (std::uint32_t l = crossed.range.low; l < crossed.range.high; ++l) {
      if (is_passed_[crossed.first_flag + l - crossed.range.low]) continue;
      begin(l);
      trace(crossed.edge, l);
    }
  }
}

void LoftSectioner::find_crossed_edges() {
  crossed_edges_.clear();
  edge_indices_.resize(std::size_t{ring_count_} * outline_size_);
  std::uint32_t flags = 0;
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    if (ranges_[i].low >= ranges_[i].high) continue;
    const auto layers_below = [&](std::uint32_t j) {
      return layers_->layers_below(rings_[i].vertex(outline_[j]).z);
    };
    std::uint32_t here = layers_below(0);
    for (std::uint32_t j = 0; j < outline_size_; ++j) {
      const std::uint32_t next = layers_below(next_corner(j));
      const RingRange range{std::min(here, next), std::max(here, next)};
      here = next;
      if (range.low == range.high) continue;
      edge_indices_[std::size_t{i} * outline_size_ + j] =
          static_cast<std::uint32_t>(crossed_edges_.size());
      crossed_edges_.push_back({{i, j}, range, flags});
      flags += range.high - range.low;
    }
  }
  is_passed_.assign(flags, false);
}

void LoftSectioner::mark(RingEdge edge, std::uint32_t layer) {
  const CrossedEdge& crossed =
      crossed_edges_[edge_indices_[std::size_t{edge.ring} * outline_size_ +
                                   edge.corner]];
  is_passed_[crossed.first_flag + layer - crossed.range.low] = true;
}

// Walks from a crossing of a ring edge until it comes back. The solid of an
// outward loft is on the left. An edge whose first vertex is below is passed
// towards the previous ring, one whose first vertex is above towards the next.
void LoftSectioner::trace(RingEdge start, std::uint32_t layer) {
  RingEdge edge = start;
  bool is_towards_next = is_above(edge.ring, edge.corner);
  do {
    if (is_towards_next) {
      if (edge.ring + 1 == ring_count_ && !is_closed_) {
        edge.corner = leave_last_cap(edge.corner);
        is_towards_next = false;
      } else {
        is_towards_next = pass_strip(edge, edge.ring, Side::kLowerRing);
      }
    } else if (edge.ring == 0 && !is_closed_) {
      edge.corner = leave_first_cap(edge.corner);
      is_towards_next = true;
    } else {
      is_towards_next =
          pass_strip(edge, previous_ring(edge.ring), Side::kUpperRing);
    }
    add_ring_point(edge);
    mark(edge, layer);
  } while (edge != start);
  close(layer);
}

// Walks through the quads of a strip from `edge`, on its lower or upper ring,
// to the next crossing of a ring; returns whether that leads to the next ring.
//
// Seen from outside, a quad has vertices a b on the lower ring (at this corner
// and the next) and d c above them. Entered by an edge, counter-clockwise a
// vertex above and one below, it is left at the first edge backwards, over
// vertices above, that ends below.
bool LoftSectioner::pass_strip(RingEdge& edge, std::uint32_t strip,
                               Side entry) {
  const std::uint32_t upper = next_ring(strip);
  // Copies, which no point added can change for the compiler.
  const Ring lower_ring = rings_[strip];
  const Ring upper_ring = rings_[upper];
  const Vertex* outline = outline_.data();
  const double threshold = threshold_;
  const auto is_below = [&](const Ring& ring, std::uint32_t corner) {
    return !(ring.vertex(outline[corner]).z > threshold);
  };
  std::vector<Vec2>& loop = builder_->loop();
  std::uint32_t j = edge.corner;
  for (;;) {
    const std::uint32_t k = next_corner(j);
    Side exit = Side::kLowerRing;
    switch (entry) {
      case Side::kLowerRing:
        exit = is_below(upper_ring, j)   ? Side::kCorner
               : is_below(upper_ring, k) ? Side::kUpperRing
                                         : Side::kNextCorner;
        break;
      case Side::kNextCorner:
        exit = is_below(lower_ring, j)   ? Side::kLowerRing
               : is_below(upper_ring, j) ? Side::kCorner
                                         : Side::kUpperRing;
        break;
      case Side::kUpperRing:
        exit = is_below(lower_ring, k)   ? Side::kNextCorner
               : is_below(lower_ring, j) ? Side::kLowerRing
                                         : Side::kCorner;
        break;
      case Side::kCorner:
        exit = is_below(upper_ring, k)   ? Side::kUpperRing
               : is_below(lower_ring, k) ? Side::kNextCorner
                                         : Side::kLowerRing;
        break;
    }
    switch (exit) {
      case Side::kLowerRing:
        edge = {strip, j};
        return false;
      case Side::kUpperRing:
        edge = {upper, j};
        return true;
      case Side::kNextCorner:
        entry = Side::kCorner;
        break;
      case Side::kCorner:
        entry = Side::kNextCorner;
        break;
    }
    const Vertex& corner = outline[exit == Side::kNextCorner ? k : j];
    loop.push_back(crossing(lower_ring.vertex(corner),
                            upper_ring.vertex(corner), height_));
    j = exit == Side::kNextCorner ? k : previous_corner(j);
  }
}

// The first cap is seen from the other side: its boundary runs against the
// outline. Entered at an ascending edge, it is left at the next descending one.
std::uint32_t LoftSectioner::leave_first_cap(std::uint32_t corner) const {
  corner = next_corner(corner);
  while (is_above(0, next_corner(corner))) corner = next_corner(corner);
  return corner;
}

// Entered at a descending edge, the last cap is left at the ascending edge
// before it.
std::uint32_t LoftSectioner::leave_last_cap(std::uint32_t corner) const {
  const std::uint32_t ring = ring_count_ - 1;
  corner = previous_corner(corner);
  while (is_above(ring, corner)) corner = previous_corner(corner);
  return corner;
}

}  // namespace lamina::ldni::detail
