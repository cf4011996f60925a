#include "ldni/detail/sweep_section.h"

#include <algorithm>
#include <cstddef>

namespace lamina::ldni::detail {
namespace {

Vec2 crossing(const Vec3& from, const Vec3& to, double height) {
  // A vertex within kOnPlaneDistance of the section is on it: clamp.
  const double t =
      std::min(std::max((height - from.z) / (to.z - from.z), 0.0), 1.0);
  return {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
}

}  // namespace

std::uint32_t BlockLayers::layers_below(double z) const {
  if (thresholds.empty() || !(z > thresholds.front())) return 0;
  if (z > thresholds.back()) {
    return static_cast<std::uint32_t>(thresholds.size());
  }
  if (layers_per_mm == 0) {
    const auto it =
        std::partition_point(thresholds.begin(), thresholds.end(),
                             [z](double threshold) { return threshold < z; });
    return static_cast<std::uint32_t>(it - thresholds.begin());
  }
  auto layers = std::min(
      static_cast<std::size_t>((z - thresholds.front()) * layers_per_mm),
      thresholds.size() - 1);
  while (layers > 0 && !(z > thresholds[layers - 1])) --layers;
  while (layers < thresholds.size() && z > thresholds[layers]) ++layers;
  return static_cast<std::uint32_t>(layers);
}

void SweepSectioner::cut(const csg::Sweep& sweep, const Affine& world_from_leaf,
                         std::uint32_t instance, std::int32_t orientation,
                         const BlockLayers& layers, ChainBuilder& builder) {
  spoke_count_ = static_cast<std::uint32_t>(sweep.outline->size());
  ring_count_ = static_cast<std::uint32_t>(sweep.profile.size());
  if (spoke_count_ < 3 || ring_count_ < 2) return;
  is_closed_ = sweep.is_closed_profile;
  instance_ = instance;
  orientation_ = orientation;
  layers_ = &layers;
  builder_ = &builder;
  place(sweep, world_from_leaf);
  find_ranges();
  cut_strips();
  if (is_nested_) {
    cut_runs();
  } else {
    cut_all_crossings();
  }
}

void SweepSectioner::place(const csg::Sweep& sweep,
                           const Affine& world_from_leaf) {
  const Vec3 x_axis = world_from_leaf[0];
  const Vec3 y_axis = world_from_leaf[1];
  const Vec3 z_axis = world_from_leaf[2];
  const Vec3 origin = world_from_leaf[3];
  spokes_.resize(spoke_count_);
  for (std::uint32_t j = 0; j < spoke_count_; ++j) {
    const Vec2& point = (*sweep.outline)[j];
    spokes_[j] = x_axis * point.x + y_axis * point.y;
  }
  rings_.resize(ring_count_);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    rings_[i] = {sweep.profile[i].x, z_axis * sweep.profile[i].y + origin};
  }
  const auto [lowest, highest] = std::minmax_element(
      spokes_.begin(), spokes_.end(),
      [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  lowest_ = static_cast<std::uint32_t>(lowest - spokes_.begin());
  highest_ = static_cast<std::uint32_t>(highest - spokes_.begin());
  is_nested_ = rises_and_falls_once();
}

bool SweepSectioner::rises_and_falls_once() const {
  for (std::uint32_t j = lowest_; j != highest_; j = next_spoke(j)) {
    if (spokes_[next_spoke(j)].z < spokes_[j].z) return false;
  }
  for (std::uint32_t j = highest_; j != lowest_; j = next_spoke(j)) {
    if (spokes_[next_spoke(j)].z > spokes_[j].z) return false;
  }
  return true;
}

void SweepSectioner::find_ranges() {
  ranges_.resize(ring_count_);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    const Ring& ring = rings_[i];
    ranges_[i].low = layers_->layers_below(ring.vertex(spokes_[lowest_]).z);
    ranges_[i].high = layers_->layers_below(ring.vertex(spokes_[highest_]).z);
  }
}

void SweepSectioner::begin(std::uint32_t layer) {
  height_ = layers_->heights[layer];
  threshold_ = layers_->thresholds[layer];
}

void SweepSectioner::close(std::uint32_t layer) {
  builder_->close_loop(layer, instance_, orientation_);
}

inline void SweepSectioner::add_ring_point(RingEdge edge) {
  const Ring& ring = rings_[edge.ring];
  builder_->loop().push_back(
      crossing(ring.vertex(spokes_[edge.spoke]),
               ring.vertex(spokes_[next_spoke(edge.spoke)]), height_));
}

// --- Loops round a strip ----------------------------------------------------

void SweepSectioner::cut_strips() {
  for (std::uint32_t i = 0; i + 1 < ring_count_; ++i) cut_strip(i, i + 1);
  if (is_closed_) cut_strip(ring_count_ - 1, 0);
}

void SweepSectioner::cut_strip(std::uint32_t ring, std::uint32_t upper) {
  // The profile rises through the layer: the loop runs with the outline.
  for (std::uint32_t l = ranges_[ring].high; l < ranges_[upper].low; ++l) {
    begin(l);
    add_strip_points(ring, upper);
    close(l);
  }
  // It falls through the layer: against the outline.
  for (std::uint32_t l = ranges_[upper].high; l < ranges_[ring].low; ++l) {
    begin(l);
    add_strip_points(ring, upper);
    std::reverse(builder_->loop().begin(), builder_->loop().end());
    close(l);
  }
}

// Where the section crosses each spoke between the two rings.
void SweepSectioner::add_strip_points(std::uint32_t ring, std::uint32_t upper) {
  std::vector<Vec2>& loop = builder_->loop();
  loop.resize(spoke_count_);
  const Ring lower_ring = rings_[ring];
  const Ring upper_ring = rings_[upper];
  const double height = height_;
  const Vec3* spokes = spokes_.data();
  Vec2* points = loop.data();
  for (std::uint32_t j = 0; j < spoke_count_; ++j) {
    points[j] = crossing(lower_ring.vertex(spokes[j]),
                         upper_ring.vertex(spokes[j]), height);
  }
}

// --- Loops that cross rings -------------------------------------------------

void SweepSectioner::cut_runs() {
  // Seed each layer at rings whose predecessor it does not cross.
  RingRange all = ranges_[0];
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    const RingRange& range = ranges_[i];
    all.low = std::max(all.low, range.low);
    all.high = std::min(all.high, range.high);
    const bool has_previous = i > 0 || is_closed_;
    const RingRange before =
        has_previous ? ranges_[previous_ring(i)] : RingRange{};
    for (std::uint32_t l = range.low; l < range.high; ++l) {
      if (l >= before.low && l < before.high) continue;
      begin(l);
      trace({i, find_rise(i)}, l);
    }
  }
  if (!is_closed_) return;
  // A closed profile crossed all the way round gives two loops.
  for (std::uint32_t l = all.low; l < all.high; ++l) {
    begin(l);
    trace({0, find_rise(0)}, l);
    trace({0, find_fall(0)}, l);
  }
}

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
    if (!is_nested_) mark(edge, layer);
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
  const Vec3* spokes = spokes_.data();
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
    const Vec3& spoke = spokes[exit == Side::kNextSpoke ? k : j];
    loop.push_back(
        crossing(lower_ring.vertex(spoke), upper_ring.vertex(spoke), height_));
    j = exit == Side::kNextSpoke ? k : previous_spoke(j);
  }
}

// Spoke of the last vertex below the layer before the ring rises above it.
std::uint32_t SweepSectioner::find_rise(std::uint32_t ring) const {
  std::uint32_t below = 0;  // spokes from the lowest one on
  std::uint32_t above = (highest_ + spoke_count_ - lowest_) % spoke_count_;
  while (above - below > 1) {
    const std::uint32_t middle = (below + above) / 2;
    const bool is_middle_above =
        is_above(ring, (lowest_ + middle) % spoke_count_);
    (is_middle_above ? above : below) = middle;
  }
  return (lowest_ + below) % spoke_count_;
}

// Spoke of the last vertex above the layer before the ring falls below it.
std::uint32_t SweepSectioner::find_fall(std::uint32_t ring) const {
  std::uint32_t above = 0;  // spokes from the highest one on
  std::uint32_t below = (lowest_ + spoke_count_ - highest_) % spoke_count_;
  while (below - above > 1) {
    const std::uint32_t middle = (above + below) / 2;
    const bool is_middle_above =
        is_above(ring, (highest_ + middle) % spoke_count_);
    (is_middle_above ? above : below) = middle;
  }
  return (highest_ + above) % spoke_count_;
}

// The first cap is seen from the other side: its boundary runs against the
// spokes. Entered at a rise, it is left at the next fall.
std::uint32_t SweepSectioner::leave_first_cap(std::uint32_t spoke) const {
  if (is_nested_) return find_fall(0);
  spoke = next_spoke(spoke);
  while (is_above(0, next_spoke(spoke))) spoke = next_spoke(spoke);
  return spoke;
}

// Entered at a fall, the last cap is left at the rise before it.
std::uint32_t SweepSectioner::leave_last_cap(std::uint32_t spoke) const {
  const std::uint32_t ring = ring_count_ - 1;
  if (is_nested_) return find_rise(ring);
  spoke = previous_spoke(spoke);
  while (is_above(ring, spoke)) spoke = previous_spoke(spoke);
  return spoke;
}

}  // namespace lamina::ldni::detail
