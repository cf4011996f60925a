// Loops that cross rings, of outlines that rise more than once: a walk from
// quad to quad (sweep_section.h).

#include <algorithm>
#include <cstddef>

#include "ldni/section/detail/loft_section.h"

namespace lamina::ldni::detail {

void SweepSectioner::cut_all_crossings() {
  find_crossed_edges();
  for (const CrossedEdge& crossed : crossed_edges_) {
    for (std::uint32_t l = crossed.range.low; l < crossed.range.high; ++l) {
      if (is_passed_[crossed.first_flag + l - crossed.range.low]) continue;
      begin(l);
      trace(crossed.edge, l);
    }
  }
}

void SweepSectioner::find_crossed_edges() {
  crossed_edges_.clear();
  edge_indices_.resize(std::size_t{ring_count_} * spoke_count_);
  std::uint32_t flags = 0;
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    if (ranges_[i].low >= ranges_[i].high) continue;
    const auto layers_below = [&](std::uint32_t j) {
      return layers_->layers_below(rings_[i].vertex(spokes_[j]).z);
    };
    std::uint32_t here = layers_below(0);
    for (std::uint32_t j = 0; j < spoke_count_; ++j) {
      const std::uint32_t next = layers_below(next_spoke(j));
      const RingRange range{std::min(here, next), std::max(here, next)};
      here = next;
      if (range.low == range.high) continue;
      edge_indices_[std::size_t{i} * spoke_count_ + j] =
          static_cast<std::uint32_t>(crossed_edges_.size());
      crossed_edges_.push_back({{i, j}, range, flags});
      flags += range.high - range.low;
    }
  }
  is_passed_.assign(flags, false);
}

void SweepSectioner::mark(RingEdge edge, std::uint32_t layer) {
  const CrossedEdge& crossed =
      crossed_edges_[edge_indices_[std::size_t{edge.ring} * spoke_count_ +
                                   edge.spoke]];
  is_passed_[crossed.first_flag + layer - crossed.range.low] = true;
}

// Walks from a crossing of a ring edge until it comes back. The solid of an
// outward sweep is on the left. An edge whose first vertex is below is passed
// towards the previous ring, one whose first vertex is above towards the next.
void SweepSectioner::trace(RingEdge start, std::uint32_t layer) {
  RingEdge edge = start;
  bool is_towards_next = is_above(edge.ring, edge.spoke);
  do {
    if (is_towards_next) {
      if (edge.ring + 1 == ring_count_ && !is_closed_) {
        edge.spoke = leave_last_cap(edge.spoke);
        is_towards_next = false;
      } else {
        is_towards_next = pass_strip(edge, edge.ring, Side::kLowerRing);
      }
    } else if (edge.ring == 0 && !is_closed_) {
      edge.spoke = leave_first_cap(edge.spoke);
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
// Seen from outside, a quad has corners a b on the lower ring (this spoke, the
// next) and d c above them. Entered by an edge, counter-clockwise a vertex
// above and one below, it is left at the first edge backwards, over vertices
// above, that ends below.
bool SweepSectioner::pass_strip(RingEdge& edge, std::uint32_t strip,
                                Side entry) {
  const std::uint32_t upper = next_ring(strip);
  // Copies, which no point added can change for the compiler.
  const Ring lower_ring = rings_[strip];
  const Ring upper_ring = rings_[upper];
  const Vertex* spokes = spokes_.data();
  const double threshold = threshold_;
  const auto is_below = [&](const Ring& ring, std::uint32_t spoke) {
    return !(ring.vertex(spokes[spoke]).z > threshold);
  };
  std::vector<Vec2>& loop = builder_->loop();
  std::uint32_t j = edge.spoke;
  for (;;) {
    const std::uint32_t k = next_spoke(j);
    Side exit = Side::kLowerRing;
    switch (entry) {
      case Side::kLowerRing:
        exit = is_below(upper_ring, j)   ? Side::kSpoke
               : is_below(upper_ring, k) ? Side::kUpperRing
                                         : Side::kNextSpoke;
        break;
      case Side::kNextSpoke:
        exit = is_below(lower_ring, j)   ? Side::kLowerRing
               : is_below(upper_ring, j) ? Side::kSpoke
                                         : Side::kUpperRing;
        break;
      case Side::kUpperRing:
        exit = is_below(lower_ring, k)   ? Side::kNextSpoke
               : is_below(lower_ring, j) ? Side::kLowerRing
                                         : Side::kSpoke;
        break;
      case Side::kSpoke:
        exit = is_below(upper_ring, k)   ? Side::kUpperRing
               : is_below(lower_ring, k) ? Side::kNextSpoke
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
      case Side::kNextSpoke:
        entry = Side::kSpoke;
        break;
      case Side::kSpoke:
        entry = Side::kNextSpoke;
        break;
    }
    const Vertex& spoke = spokes[exit == Side::kNextSpoke ? k : j];
    loop.push_back(
        crossing(lower_ring.vertex(spoke), upper_ring.vertex(spoke), height_));
    j = exit == Side::kNextSpoke ? k : previous_spoke(j);
  }
}

// The first cap is seen from the other side: its boundary runs against the
// spokes. Entered at a rise, it is left at the next fall.
std::uint32_t SweepSectioner::leave_first_cap(std::uint32_t spoke) const {
  spoke = next_spoke(spoke);
  while (is_above(0, next_spoke(spoke))) spoke = next_spoke(spoke);
  return spoke;
}

// Entered at a fall, the last cap is left at the rise before it.
std::uint32_t SweepSectioner::leave_last_cap(std::uint32_t spoke) const {
  const std::uint32_t ring = ring_count_ - 1;
  spoke = previous_spoke(spoke);
  while (is_above(ring, spoke)) spoke = previous_spoke(spoke);
  return spoke;
}

}  // namespace lamina::ldni::detail
