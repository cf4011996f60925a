#include "ldni/section/detail/loft_section.h"

#include <algorithm>
#include <cstddef>

namespace lamina::ldni::detail {

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

void LoftSectioner::cut(const csg::Loft& loft, const Affine& world_from_leaf,
                        std::uint32_t instance, std::int32_t orientation,
                        const BlockLayers& layers,
                        plane::ChainBuilder& builder) {
  outline_size_ = static_cast<std::uint32_t>(loft.outline->size());
  ring_count_ = static_cast<std::uint32_t>(loft.profile.size());
  if (outline_size_ < 3 || ring_count_ < 2) return;
  is_closed_ = loft.is_closed_profile;
  instance_ = instance;
  orientation_ = orientation;
  layers_ = &layers;
  builder_ = &builder;
  place(loft, world_from_leaf);
  find_ranges();
  cut_strips();
  if (is_outline_monotone()) {
    cut_runs();
  } else {
    cut_all_crossings();
  }
}

void LoftSectioner::place(const csg::Loft& loft,
                          const Affine& world_from_leaf) {
  const Affine& m = world_from_leaf;
  rings_.resize(ring_count_);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    const Vec3 centre = m[2] * loft.profile[i].y + m[3];
    rings_[i] = {loft.profile[i].x, {Lanes{centre.x, centre.y}, centre.z}};
  }
  // Place the outline twice round, from its lowest corner on.
  const Lanes x_axis{m[0].x, m[0].y};
  const Lanes y_axis{m[1].x, m[1].y};
  const double x_rise = m[0].z;
  const double y_rise = m[1].z;
  const Vec2* outline = loft.outline->data();
  std::uint32_t lowest = 0;
  double least = 1e300;
  for (std::uint32_t j = 0; j < outline_size_; ++j) {
    const double z = x_rise * outline[j].x + y_rise * outline[j].y;
    if (z < least) {
      least = z;
      lowest = j;
    }
  }
  outline_.resize(2 * std::size_t{outline_size_});
  double greatest = least;
  highest_ = 0;
  for (std::uint32_t j = 0; j < outline_size_; ++j) {
    const std::uint32_t from = j + lowest;
    const Vec2& point =
        outline[from < outline_size_ ? from : from - outline_size_];
    const Vertex corner = {
        both_lanes(point.x) * x_axis + both_lanes(point.y) * y_axis,
        x_rise * point.x + y_rise * point.y};
    outline_[j] = outline_[j + outline_size_] = corner;
    if (corner.z >= greatest) {
      greatest = corner.z;
      highest_ = j;
    }
  }
}

bool LoftSectioner::is_outline_monotone() const {
  for (std::uint32_t j = 0; j < highest_; ++j) {
    if (outline_[j + 1].z < outline_[j].z) return false;
  }
  for (std::uint32_t j = highest_; j < outline_size_; ++j) {
    if (outline_[j + 1].z > outline_[j].z) return false;
  }
  return true;
}

void LoftSectioner::find_ranges() {
  ranges_.resize(ring_count_);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    const Ring& ring = rings_[i];
    ranges_[i].low = layers_->layers_below(ring.vertex(outline_[0]).z);
    ranges_[i].high = layers_->layers_below(ring.vertex(outline_[highest_]).z);
  }
}

void LoftSectioner::begin(std::uint32_t layer) {
  height_ = layers_->heights[layer];
  threshold_ = layers_->thresholds[layer];
}

void LoftSectioner::close(std::uint32_t layer) {
  builder_->close_loop(layer, instance_, orientation_);
}

// --- Loops round a strip ----------------------------------------------------

void LoftSectioner::cut_strips() {
  for (std::uint32_t i = 0; i + 1 < ring_count_; ++i) cut_strip(i, i + 1);
  if (is_closed_) cut_strip(ring_count_ - 1, 0);
}

void LoftSectioner::cut_strip(std::uint32_t ring, std::uint32_t upper) {
  // Through an ascending strip the loop runs with the outline,
  cut_strip_layers(ring, upper, {ranges_[ring].high, ranges_[upper].low}, 0,
                   outline_size_);
  // through a descending one against it.
  cut_strip_layers(ring, upper, {ranges_[upper].high, ranges_[ring].low},
                   outline_size_, 0);
}

// Adds the loops of one strip, from corner `from` to corner `to`. Through
// upright walls they are one loop, repeated.
void LoftSectioner::cut_strip_layers(std::uint32_t ring, std::uint32_t upper,
                                     RingRange layers, std::uint32_t from,
                                     std::uint32_t to) {
  const bool is_upright = rings_[ring].is_upright_to(rings_[upper]);
  for (std::uint32_t l = layers.low; l < layers.high; ++l) {
    if (is_upright && l > layers.low) {
      builder_->repeat_loop(l);
      continue;
    }
    begin(l);
    add_strip_points(ring, from, to);
    close(l);
  }
}

// Adds the points where the section crosses the side edges of a strip, on the
// way from outline edge `from` to `to`: edge j joins corners j and j + 1.
void LoftSectioner::add_strip_points(std::uint32_t strip, std::uint32_t from,
                                     std::uint32_t to) {
  std::vector<Vec2>& loop = builder_->loop();
  const std::size_t begin = loop.size();
  loop.resize(begin + (from < to ? to - from : from - to));
  Vec2* point = loop.data() + begin;
  // Copies, which no point added can change for the compiler.
  const Ring lower = rings_[strip];
  const Ring upper = rings_[next_ring(strip)];
  const double height = height_;
  const Vertex* corner = &outline_[from];
  const Vertex* const last = &outline_[to];
  while (corner < last) {
    ++corner;
    *point++ = crossing(lower.vertex(*corner), upper.vertex(*corner), height);
  }
  for (; corner > last; --corner) {
    *point++ = crossing(lower.vertex(*corner), upper.vertex(*corner), height);
  }
}

// --- Loops that cross rings, of monotone outlines ---------------------------

void LoftSectioner::cut_runs() {
  RingRange all = ranges_[0];
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    const RingRange& range = ranges_[i];
    all.low = std::max(all.low, range.low);
    all.high = std::min(all.high, range.high);
    for (std::uint32_t l = range.low; l < range.high; ++l) {
      if (has_previous(i) && ranges_[previous_ring(i)].holds(l)) continue;
      begin(l);
      cut_run(i, l);
    }
  }
  if (!is_closed_) return;
  for (std::uint32_t l = all.low; l < all.high; ++l) {
    begin(l);
    cut_round(l);
  }
}

// Leads the loop from the edge where a ring crosses the layer to that of a
// neighbour, and returns the latter: over descending edges, which start above,
// to the next ring, or over ascending ones back to the previous one.
template <bool kStartsAbove>
std::uint32_t LoftSectioner::pass_edge(std::uint32_t ring, std::uint32_t edge) {
  const std::uint32_t to = kStartsAbove ? next_ring(ring) : previous_ring(ring);
  const std::uint32_t lower = kStartsAbove ? ring : to;
  const std::uint32_t upper = kStartsAbove ? to : ring;
  if (is_above(to, edge) == kStartsAbove) {
    while (is_above(to, edge + 1) == kStartsAbove) {
      add_side_point(lower, upper, ++edge);
    }
  } else {
    while (is_above(to, edge) != kStartsAbove) {
      add_side_point(lower, upper, edge--);
    }
  }
  add_ring_point({to, edge});
  return edge;
}

// The loop over the rings from `first` on that the layer crosses: along the
// descending edges to the last of them, and back along the ascending ones.
void LoftSectioner::cut_run(std::uint32_t first, std::uint32_t layer) {
  std::uint32_t ascending = find_ascending_edge(first);
  std::uint32_t descending = find_descending_edge(first);
  if (has_previous(first)) {
    const std::uint32_t before = previous_ring(first);
    const bool is_above = layer < ranges_[before].low;
    add_strip_points(before, ascending + (is_above ? outline_size_ : 0),
                     descending);
  }
  add_ring_point({first, descending});
  std::uint32_t ring = first;
  for (; has_next(ring) && ranges_[next_ring(ring)].holds(layer);
       ring = next_ring(ring)) {
    descending = pass_edge<true>(ring, descending);
  }
  if (ring != first) ascending = find_ascending_edge(ring);
  if (has_next(ring)) {
    const bool is_above = layer < ranges_[next_ring(ring)].low;
    add_strip_points(ring, descending,
                     ascending + (is_above ? outline_size_ : 0));
  }
  add_ring_point({ring, ascending});
  for (; ring != first; ring = previous_ring(ring)) {
    ascending = pass_edge<false>(ring, ascending);
  }
  close(layer);
}

// A closed profile crossed all the way round gives two loops.
void LoftSectioner::cut_round(std::uint32_t layer) {
  std::uint32_t descending = find_descending_edge(0);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    descending = pass_edge<true>(i, descending);
  }
  close(layer);
  std::uint32_t ascending = find_ascending_edge(0);
  for (std::uint32_t i = ring_count_; i-- > 0;) {
    ascending = pass_edge<false>(next_ring(i), ascending);
  }
  close(layer);
}

// The one edge between corners `first` and `last` of a ring that crosses the
// layer.
std::uint32_t LoftSectioner::find_edge(std::uint32_t ring, std::uint32_t first,
                                       std::uint32_t last,
                                       bool starts_above) const {
  while (last - first > 1) {
    const std::uint32_t middle = (first + last) / 2;
    (is_above(ring, middle) == starts_above ? first : last) = middle;
  }
  return first;
}

}  // namespace lamina::ldni::detail
