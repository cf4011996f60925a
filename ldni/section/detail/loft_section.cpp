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
  if (rises_and_falls_once()) {
    cut_runs();
  } else {
    cut_all_crossings();
  }
}

void SweepSectioner::place(const csg::Sweep& sweep,
                           const Affine& world_from_leaf) {
  const Affine& m = world_from_leaf;
  rings_.resize(ring_count_);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    const Vec3 centre = m[2] * sweep.profile[i].y + m[3];
    rings_[i] = {sweep.profile[i].x, {Lanes{centre.x, centre.y}, centre.z}};
  }
  // Spokes, the lowest first; behind the last one all of them again.
  const Lanes x_axis{m[0].x, m[0].y};
  const Lanes y_axis{m[1].x, m[1].y};
  const double x_rise = m[0].z;
  const double y_rise = m[1].z;
  const Vec2* outline = sweep.outline->data();
  std::uint32_t lowest = 0;
  double least = 1e300;
  for (std::uint32_t j = 0; j < spoke_count_; ++j) {
    const double z = x_rise * outline[j].x + y_rise * outline[j].y;
    if (z < least) {
      least = z;
      lowest = j;
    }
  }
  spokes_.resize(2 * std::size_t{spoke_count_});
  double greatest = least;
  highest_ = 0;
  for (std::uint32_t j = 0; j < spoke_count_; ++j) {
    const std::uint32_t from = j + lowest;
    const Vec2& point =
        outline[from < spoke_count_ ? from : from - spoke_count_];
    const Vertex spoke = {
        both_lanes(point.x) * x_axis + both_lanes(point.y) * y_axis,
        x_rise * point.x + y_rise * point.y};
    spokes_[j] = spokes_[j + spoke_count_] = spoke;
    if (spoke.z >= greatest) {
      greatest = spoke.z;
      highest_ = j;
    }
  }
}

bool SweepSectioner::rises_and_falls_once() const {
  for (std::uint32_t j = 0; j < highest_; ++j) {
    if (spokes_[j + 1].z < spokes_[j].z) return false;
  }
  for (std::uint32_t j = highest_; j < spoke_count_; ++j) {
    if (spokes_[j + 1].z > spokes_[j].z) return false;
  }
  return true;
}

void SweepSectioner::find_ranges() {
  ranges_.resize(ring_count_);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    const Ring& ring = rings_[i];
    ranges_[i].low = layers_->layers_below(ring.vertex(spokes_[0]).z);
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

// --- Loops round a strip ----------------------------------------------------

void SweepSectioner::cut_strips() {
  for (std::uint32_t i = 0; i + 1 < ring_count_; ++i) cut_strip(i, i + 1);
  if (is_closed_) cut_strip(ring_count_ - 1, 0);
}

void SweepSectioner::cut_strip(std::uint32_t ring, std::uint32_t upper) {
  // The profile rises through the layer: the loop runs with the outline.
  cut_strip_layers(ring, upper, {ranges_[ring].high, ranges_[upper].low}, 0,
                   spoke_count_);
  // It falls through the layer: against the outline.
  cut_strip_layers(ring, upper, {ranges_[upper].high, ranges_[ring].low},
                   spoke_count_, 0);
}

// Loops from spoke `from` to spoke `to`. Through upright walls all are one.
void SweepSectioner::cut_strip_layers(std::uint32_t ring, std::uint32_t upper,
                                      RingRange layers, std::uint32_t from,
                                      std::uint32_t to) {
  const bool is_upright = rings_[ring].is_upright_to(rings_[upper]);
  for (std::uint32_t l = layers.low; l < layers.high; ++l) {
    if (is_upright && l > layers.low) {
      builder_->repeat_loop(l);
      continue;
    }
    begin(l);
    add_spoke_points(ring, from, to);
    close(l);
  }
}

// Where the section crosses the spokes of a strip, on the way from edge `from`
// to edge `to`: edge j lies between spokes j and j + 1.
void SweepSectioner::add_spoke_points(std::uint32_t strip, std::uint32_t from,
                                      std::uint32_t to) {
  std::vector<Vec2>& loop = builder_->loop();
  const std::size_t begin = loop.size();
  loop.resize(begin + (from < to ? to - from : from - to));
  Vec2* point = loop.data() + begin;
  // Copies, which no point added can change for the compiler.
  const Ring lower = rings_[strip];
  const Ring upper = rings_[next_ring(strip)];
  const double height = height_;
  const Vertex* spoke = &spokes_[from];
  const Vertex* const last = &spokes_[to];
  while (spoke < last) {
    ++spoke;
    *point++ = crossing(lower.vertex(*spoke), upper.vertex(*spoke), height);
  }
  for (; spoke > last; --spoke) {
    *point++ = crossing(lower.vertex(*spoke), upper.vertex(*spoke), height);
  }
}

// --- Loops that cross rings, of outlines that rise and fall once ------------

void SweepSectioner::cut_runs() {
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

// The loop over the rings from `first` on that the layer crosses: along the
// falls to the last of them, and back along the rises.
void SweepSectioner::cut_run(std::uint32_t first, std::uint32_t layer) {
  std::uint32_t rise = find_rise(first);
  std::uint32_t fall = find_fall(first);
  if (has_previous(first)) {
    const std::uint32_t before = previous_ring(first);
    const bool is_above = layer < ranges_[before].low;
    add_spoke_points(before, rise + (is_above ? spoke_count_ : 0), fall);
  }
  add_ring_point({first, fall});
  std::uint32_t ring = first;
  for (; has_next(ring) && ranges_[next_ring(ring)].holds(layer);
       ring = next_ring(ring)) {
    fall = pass_falls(ring, fall);
  }
  if (ring != first) rise = find_rise(ring);
  if (has_next(ring)) {
    const bool is_above = layer < ranges_[next_ring(ring)].low;
    add_spoke_points(ring, fall, rise + (is_above ? spoke_count_ : 0));
  }
  add_ring_point({ring, rise});
  for (; ring != first; ring = previous_ring(ring)) {
    rise = pass_rises(ring, rise);
  }
  close(layer);
}

// A closed profile crossed all the way round gives two loops.
void SweepSectioner::cut_round(std::uint32_t layer) {
  std::uint32_t fall = find_fall(0);
  for (std::uint32_t i = 0; i < ring_count_; ++i) {
    fall = pass_falls(i, fall);
  }
  close(layer);
  std::uint32_t rise = find_rise(0);
  for (std::uint32_t i = ring_count_; i-- > 0;) {
    rise = pass_rises(next_ring(i), rise);
  }
  close(layer);
}

// From the fall of a ring to that of the next one, which it returns.
std::uint32_t SweepSectioner::pass_falls(std::uint32_t ring,
                                         std::uint32_t from) {
  const std::uint32_t next = next_ring(ring);
  std::uint32_t fall = from;
  if (is_above(next, fall)) {
    while (is_above(next, fall + 1)) add_spoke_point(ring, next, ++fall);
  } else {
    while (!is_above(next, fall)) add_spoke_point(ring, next, fall--);
  }
  add_ring_point({next, fall});
  return fall;
}

// From the rise of a ring to that of the previous one, which it returns.
std::uint32_t SweepSectioner::pass_rises(std::uint32_t ring,
                                         std::uint32_t from) {
  const std::uint32_t previous = previous_ring(ring);
  std::uint32_t rise = from;
  if (is_above(previous, rise)) {
    while (is_above(previous, rise)) add_spoke_point(previous, ring, rise--);
  } else {
    while (!is_above(previous, rise + 1)) {
      add_spoke_point(previous, ring, ++rise);
    }
  }
  add_ring_point({previous, rise});
  return rise;
}

// The edge where a ring rises above the layer: its first spoke is below.
std::uint32_t SweepSectioner::find_rise(std::uint32_t ring) const {
  std::uint32_t below = 0;
  std::uint32_t above = highest_;
  while (above - below > 1) {
    const std::uint32_t middle = (below + above) / 2;
    (is_above(ring, middle) ? above : below) = middle;
  }
  return below;
}

// The edge where a ring falls below the layer: its first spoke is above.
std::uint32_t SweepSectioner::find_fall(std::uint32_t ring) const {
  std::uint32_t above = highest_;
  std::uint32_t below = spoke_count_;
  while (below - above > 1) {
    const std::uint32_t middle = (above + below) / 2;
    (is_above(ring, middle) ? above : below) = middle;
  }
  return above;
}

}  // namespace lamina::ldni::detail
