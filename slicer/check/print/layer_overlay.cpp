#include "slicer/check/print/layer_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/diagnostic.h"
#include "plane/loop_area.h"
#include "plane/order/chain_cursor.h"
#include "plane/order/order_tree.h"

namespace lamina::slicer {
namespace {

using plane::Chain;
using plane::kClusterWidth;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNone = 0xffffffff;
constexpr std::uint32_t kUnknown = 0xfffffffd;  // a region, so far

// Neighbours of different layers have crossed where their order is wrong by
// more than this [mm]: what lies between them until then is none.
constexpr double kCrossingDepth = kContactWidth;

// Chains begin at one point of the ray where they are no farther apart [mm].
constexpr double kSamePoint = 1e-9;

// Segments that a first look at a pair takes in; each further look takes in
// twice as many. A pair that is parted soon has cost little.
constexpr int kFirstSegments = 16;

// Crossings of two layers, at most: they take a minute.
constexpr std::uint64_t kMostCrossings = 200'000'000;

struct Label {
  std::uint32_t region = kOutside;
  bool is_solid = false;

  bool operator==(const Label&) const = default;
};

// Chains of both layers on the ray.
struct Sample {
  plane::ChainCursor at;
  std::uint32_t loop = 0;
  std::uint8_t layer = 0;  // 0: below, 1: above
  bool is_solid_above = false;
  Label above;  // once it is on the ray
};

// The gap above a sample, up to the next one.
struct Gap {
  std::uint32_t upper = kNone;  // sample; none: the gap has no end
  std::uint32_t stamp = 0;      // of its events
  // Of the layers. Those of a new gap differ from all, so that the gaps above
  // it are renewed.
  std::array<Label, 2> labels = {Label{kUnknown}, Label{kUnknown}};
  double begin = 0;             // x from where on it has been the same
  bool is_wide = false;         // its certificate has seen more than the reach
  int segments = 0;             // that the next look along its chains takes in
  plane::ChainCursor lower_at;  // at `begin`
  plane::ChainCursor upper_at;

  bool is_ledge() const { return labels[1].is_solid && !labels[0].is_solid; }
};

enum class EventKind : std::uint8_t { kCrossing, kRenewal, kContact };

struct Event {
  double x = 0;
  std::uint32_t sample = 0;
  std::uint32_t stamp = 0;
  EventKind kind = EventKind::kCrossing;
};

bool is_later(const Event& a, const Event& b) {
  return a.x != b.x ? a.x > b.x : a.sample > b.sample;
}

struct Endpoint {
  double x = 0;
  std::uint32_t sample = 0;
  bool is_right = false;
};

// What a look along two neighbours finds.
struct Outlook {
  double crossing = kNever;
  double contact = kNever;  // from where on they are kContactWidth apart
  double valid_until = kNever;
  bool is_wide = false;  // farther apart than the reach somewhere on the way
};

// Looks from x on, which the present segments of both samples hold. Most of the
// sweep's time passes here.
Outlook look_along(const Sample& lower, const Sample& upper, double x,
                   bool may_cross, double reach, int segments) {
  plane::ChainCursor a = lower.at;
  plane::ChainCursor b = upper.at;
  Outlook outlook;
  double left = x;
  double distance = b.y_at(x) - a.y_at(x);
  // Distances from `least` to `greatest` say nothing new.
  const double least = may_cross ? -kCrossingDepth : -kNever;
  double greatest = 0;
  const auto expect = [&] {
    greatest = kNever;
    if (outlook.contact == kNever) greatest = kContactWidth;
    if (!outlook.is_wide) greatest = std::min(greatest, reach);
  };
  // Whether the look ends here.
  const auto take = [&](double right, double next) {
    if (next > reach) outlook.is_wide = true;
    if (next > kContactWidth && outlook.contact == kNever) {
      outlook.contact = distance > kContactWidth
                            ? left
                            : left + (right - left) *
                                         (kContactWidth - distance) /
                                         (next - distance);
      if (!may_cross) return true;
    }
    if (next < least) {
      outlook.crossing =
          distance > 0 ? left + (right - left) * distance / (distance - next)
                       : left;
      return true;
    }
    expect();
    return false;
  };
  expect();
  if (distance > greatest && take(x, distance)) return outlook;
  for (int i = 0; i < segments; ++i) {
    const double right_a = a.right_x();
    const double right_b = b.right_x();
    const double right = std::min(right_a, right_b);
    const double next = b.y_at(right) - a.y_at(right);
    if ((next > greatest || next < least) && take(right, next)) return outlook;
    if (right_a == right) {
      if (a.is_last_segment()) return outlook;
      a.step();
    }
    if (right_b == right) {
      if (b.is_last_segment()) return outlook;
      b.step();
    }
    left = right;
    distance = next;
  }
  outlook.valid_until = left;
  return outlook;
}

}  // namespace

void LayerOverlay::clear() {
  solids.clear();
  voids.clear();
  around.clear();
  areas.clear();
  overhangs.clear();
}

void ChainedLayer::fill(const plane::Contours& contours) {
  block_.layer_count = 1;
  areas_.clear();
  builder_.begin(block_);
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    areas_.push_back(signed_area(loop));
    builder_.loop().assign(loop.begin(), loop.end());
    builder_.close_loop(0, static_cast<std::uint32_t>(i), 1);
  }
  builder_.finish(block_);
}

struct OverlaySweep::State {
  void start(const plane::Contours& layer) {
    layers_[1].fill(layer);
    contours_ = &layer;
  }
  void lay_over(const plane::Contours& layer, double reach,
                LayerOverlay& overlay);

 private:
  void begin();
  void take_endpoints(double end);
  void take_events(double end);
  void remove(std::uint32_t sample, double x);
  void insert(std::uint32_t sample, double x);
  void swap_with_upper(std::uint32_t lower);
  void settle(double x);
  bool is_ascending(const std::vector<std::uint32_t>& samples) const;
  void sort_by_place(std::vector<std::uint32_t>& samples);
  bool renew_gap(std::uint32_t lower, double x);
  void watch(std::uint32_t lower, double x);
  void close(std::uint32_t lower, double x);
  void link(const Gap& gap);
  bool is_linked(const Gap& gap) const;
  void find_overhangs(const plane::Contours& below,
                      const plane::Contours& above, LayerOverlay& overlay);

  bool is_below(const Sample& sample, const Sample& other, double x) const;
  Label label_above(const Sample& sample) const {
    const bool is_inside =
        layers_[sample.layer].is_outer(sample.loop) == sample.is_solid_above;
    return {is_inside ? sample.loop : around_[sample.layer][sample.loop],
            sample.is_solid_above};
  }
  Label label_below(std::uint32_t sample, std::uint8_t layer) const;
  void connect(std::uint32_t lower, std::uint32_t upper) {
    uppers_[lower] = upper;
    lowers_[upper] = lower;
  }
  void mark(std::uint32_t sample) { dirty_.push_back(sample); }
  void push(const Event& event) {
    events_.push_back(event);
    std::push_heap(events_.begin(), events_.end(), is_later);
  }

  std::array<ChainedLayer, 2> layers_;
  const plane::Contours* contours_ = nullptr;  // of the layer before
  std::array<std::vector<std::uint32_t>, 2> around_;
  double reach_ = 0;
  LayerOverlay* overlay_ = nullptr;
  std::vector<Sample> samples_;
  std::vector<Gap> gaps_;  // above each sample
  // The samples on the ray, ascending in y: a tree, and a ring of neighbours in
  // which rim_ stands below the first and above the last.
  plane::OrderTree order_;
  std::vector<std::uint32_t> lowers_;
  std::vector<std::uint32_t> uppers_;
  std::uint32_t rim_ = 0;
  std::vector<Endpoint> endpoints_;
  std::size_t next_endpoint_ = 0;
  std::uint64_t crossings_ = 0;
  std::vector<Event> events_;  // heap
  std::vector<std::uint32_t> dirty_;
  // Those in the order of the ray.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places_;
  std::vector<std::uint32_t> begun_;
  std::vector<Ledge> ledges_;
  OverhangSearch overhang_search_;
  // The region below that each region above was last found to overlap, the
  // outside last: nearly all questions are answered here.
  std::array<std::vector<std::uint32_t>, 2> last_linked_;  // voids, solids
};

void OverlaySweep::State::lay_over(const plane::Contours& layer, double reach,
                                   LayerOverlay& overlay) {
  overlay.clear();
  overlay_ = &overlay;
  reach_ = reach;
  std::swap(layers_[0], layers_[1]);
  layers_[1].fill(layer);
  begin();
  while (next_endpoint_ < endpoints_.size()) {
    double x = endpoints_[next_endpoint_].x;
    if (!events_.empty()) x = std::min(x, events_.front().x);
    const double end = x + kClusterWidth;
    take_events(end);
    take_endpoints(end);
    settle(x);
  }
  for (std::vector<Overlap>* overlaps : {&overlay.solids, &overlay.voids}) {
    std::ranges::sort(*overlaps);
    overlaps->erase(std::unique(overlaps->begin(), overlaps->end()),
                    overlaps->end());
  }
  overlay.around = around_[1];
  overlay.areas = layers_[1].areas();
  find_overhangs(*contours_, layer, overlay);
  contours_ = &layer;
}

// Puts the endpoints of all chains in order.
void OverlaySweep::State::begin() {
  samples_.clear();
  endpoints_.clear();
  for (std::uint8_t layer = 0; layer < 2; ++layer) {
    const plane::LayerChains chains = layers_[layer].chains();
    around_[layer].assign(layers_[layer].loop_count(), kNowhere);
    for (const Chain& chain : chains.chains) {
      const std::span<const Vec2> points = chain.points_in(chains.points);
      Sample sample;
      sample.at = plane::ChainCursor(points.data(), &points.back());
      sample.loop = chain.operand;
      sample.layer = layer;
      sample.is_solid_above = chain.winding > 0;
      around_[layer][chain.operand] = kUnknown;
      const auto number = static_cast<std::uint32_t>(samples_.size());
      samples_.push_back(sample);
      endpoints_.push_back({points.front().x, number, false});
      endpoints_.push_back({points.back().x, number, true});
    }
  }
  std::ranges::sort(endpoints_, [](const Endpoint& a, const Endpoint& b) {
    return a.x != b.x ? a.x < b.x : a.sample < b.sample;
  });
  next_endpoint_ = 0;
  crossings_ = 0;
  gaps_.assign(samples_.size(), {});
  rim_ = static_cast<std::uint32_t>(samples_.size());
  order_.begin(samples_.size() + 1);
  lowers_.resize(samples_.size() + 1);
  uppers_.resize(samples_.size() + 1);
  connect(rim_, rim_);
  events_.clear();
  dirty_.clear();
  ledges_.clear();
  for (auto& linked : last_linked_) {
    linked.assign(layers_[1].loop_count() + 1, kUnknown);
  }
}

// --- Events -----------------------------------------------------------------

void OverlaySweep::State::take_events(double end) {
  while (!events_.empty() && events_.front().x <= end) {
    std::pop_heap(events_.begin(), events_.end(), is_later);
    const Event event = events_.back();
    events_.pop_back();
    if (!order_.holds(event.sample)) continue;
    if (gaps_[event.sample].stamp != event.stamp) continue;
    switch (event.kind) {
      case EventKind::kCrossing:
        if (++crossings_ > kMostCrossings) {
          throw GeometryError(
              "contours of neighbouring layers cross each other too often to "
              "be compared");
        }
        swap_with_upper(event.sample);
        settle(event.x);
        break;
      case EventKind::kRenewal:
        watch(event.sample, event.x);
        break;
      case EventKind::kContact:
        link(gaps_[event.sample]);
        break;
    }
  }
}

void OverlaySweep::State::take_endpoints(double end) {
  begun_.clear();
  for (; next_endpoint_ < endpoints_.size() &&
         endpoints_[next_endpoint_].x <= end;
       ++next_endpoint_) {
    const Endpoint& endpoint = endpoints_[next_endpoint_];
    if (!endpoint.is_right) {
      if (samples_[endpoint.sample].at.last()->x > end) {
        begun_.push_back(endpoint.sample);
      }
    } else if (order_.holds(endpoint.sample)) {
      remove(endpoint.sample, endpoint.x);
    }
  }
  for (const std::uint32_t sample : begun_) {
    insert(sample, samples_[sample].at.left_x());
  }
}

void OverlaySweep::State::remove(std::uint32_t sample, double x) {
  close(sample, x);
  const std::uint32_t lower = lowers_[sample];
  const std::uint32_t upper = uppers_[sample];
  order_.remove(sample, upper);
  connect(lower, upper);
  mark(lower);
  mark(upper);
}

// Whether `other`, which begins at x, belongs above the sample; where they meet
// there, by how they go on.
bool OverlaySweep::State::is_below(const Sample& sample, const Sample& other,
                                   double x) const {
  plane::ChainCursor one = sample.at;
  one.advance(x);
  const double distance = other.at.left()->y - one.y_at(x);
  if (std::abs(distance) > kSamePoint) return distance > 0;
  const double right = std::min(one.right_x(), other.at.right_x());
  return other.at.y_at(right) > one.y_at(right);
}

void OverlaySweep::State::insert(std::uint32_t sample, double x) {
  Sample& begun = samples_[sample];
  const std::uint32_t lower = order_.find_last(
      [&](std::uint32_t other) { return is_below(samples_[other], begun, x); },
      rim_);
  const std::uint32_t upper = uppers_[lower];
  order_.insert(lower, upper, sample);
  connect(lower, sample);
  connect(sample, upper);
  std::uint32_t& around = around_[begun.layer][begun.loop];
  if (around == kUnknown) {
    // A loop begins on its left, where its outer side is below.
    const Label label = label_below(sample, begun.layer);
    const bool fits =
        label.is_solid != layers_[begun.layer].is_outer(begun.loop);
    around = fits ? label.region : kOutside;
  }
  begun.above = label_above(begun);
  mark(lower);
  mark(sample);
}

// The region of a layer below the sample.
Label OverlaySweep::State::label_below(std::uint32_t sample,
                                       std::uint8_t layer) const {
  do {
    sample = lowers_[sample];
    if (sample == rim_) return {};
  } while (samples_[sample].layer != layer);
  return samples_[sample].above;
}

void OverlaySweep::State::swap_with_upper(std::uint32_t lower) {
  const std::uint32_t upper = uppers_[lower];
  const std::uint32_t below = lowers_[lower];
  order_.swap(lower, upper);
  connect(lower, uppers_[upper]);
  connect(upper, lower);
  connect(below, upper);
  mark(below);
  mark(upper);
  mark(lower);
}

// --- Gaps -------------------------------------------------------------------

// Renews the gaps that have changed, and those above them whose labels do.
void OverlaySweep::State::settle(double x) {
  std::erase_if(dirty_, [&](auto sample) { return !order_.holds(sample); });
  if (!is_ascending(dirty_)) sort_by_place(dirty_);
  for (std::uint32_t sample : dirty_) {
    while (sample != rim_ && renew_gap(sample, x)) sample = uppers_[sample];
  }
  dirty_.clear();
}

// Whether each is the one before or its neighbour above: so it is after one
// event, and then no place in the order is asked.
bool OverlaySweep::State::is_ascending(
    const std::vector<std::uint32_t>& samples) const {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i] != samples[i - 1] && samples[i] != uppers_[samples[i - 1]]) {
      return false;
    }
  }
  return true;
}

void OverlaySweep::State::sort_by_place(std::vector<std::uint32_t>& samples) {
  places_.clear();
  for (const std::uint32_t sample : samples) {
    places_.emplace_back(order_.place_of(sample), sample);
  }
  std::ranges::sort(places_);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = places_[i].second;
  }
}

// Whether the labels are others than before.
bool OverlaySweep::State::renew_gap(std::uint32_t lower, double x) {
  const std::uint32_t upper = uppers_[lower] == rim_ ? kNone : uppers_[lower];
  const Sample& sample = samples_[lower];
  Gap& gap = gaps_[lower];
  std::array<Label, 2> labels;
  labels[sample.layer] = sample.above;
  const std::uint8_t other = sample.layer == 0 ? 1 : 0;
  if (lowers_[lower] != rim_) {
    labels[other] = gaps_[lowers_[lower]].labels[other];
  }
  const bool has_new_labels = labels != gap.labels;
  if (!has_new_labels && upper == gap.upper) return false;
  close(lower, x);
  gap.labels = labels;
  gap.upper = upper;
  gap.begin = x;
  gap.is_wide = false;
  gap.segments = kFirstSegments;
  ++gap.stamp;
  if (upper == kNone) {
    link(gap);
    return has_new_labels;
  }
  samples_[lower].at.advance(x);
  samples_[upper].at.advance(x);
  gap.lower_at = samples_[lower].at;
  gap.upper_at = samples_[upper].at;
  watch(lower, x);
  return has_new_labels;
}

// Looks ahead along the two chains of a gap.
void OverlaySweep::State::watch(std::uint32_t lower, double x) {
  Gap& gap = gaps_[lower];
  Sample& a = samples_[lower];
  Sample& b = samples_[gap.upper];
  a.at.advance(x);
  b.at.advance(x);
  const bool may_cross = a.layer != b.layer;
  const bool waits =
      gap.labels[0].is_solid == gap.labels[1].is_solid && !is_linked(gap);
  if (!may_cross && !waits) return;
  const Outlook outlook = look_along(a, b, x, may_cross, reach_, gap.segments);
  gap.segments *= 2;
  gap.is_wide = gap.is_wide || outlook.is_wide;
  if (outlook.crossing != kNever) {
    push({outlook.crossing, lower, gap.stamp, EventKind::kCrossing});
  } else if (outlook.valid_until != kNever) {
    push({outlook.valid_until, lower, gap.stamp, EventKind::kRenewal});
  }
  if (waits && outlook.contact != kNever) {
    push({std::max(outlook.contact, gap.begin) + kContactWidth, lower,
          gap.stamp, EventKind::kContact});
  }
}

// Keeps what was a ledge up to x.
void OverlaySweep::State::close(std::uint32_t lower, double x) {
  Gap& gap = gaps_[lower];
  if (gap.upper == kNone || !gap.is_ledge()) return;
  const Sample& a = samples_[lower];
  const Sample& b = samples_[gap.upper];
  if (a.layer != b.layer && !gap.is_wide) return;
  if (!(x > gap.begin)) return;
  ledges_.push_back({gap.labels[1].region, gap.begin, x, gap.lower_at,
                     gap.upper_at, a.layer == 0, b.layer == 0});
}

bool OverlaySweep::State::is_linked(const Gap& gap) const {
  const auto& linked = last_linked_[gap.labels[1].is_solid ? 1 : 0];
  const std::size_t above =
      std::min<std::size_t>(gap.labels[1].region, linked.size() - 1);
  return linked[above] == gap.labels[0].region;
}

void OverlaySweep::State::link(const Gap& gap) {
  const auto& [below, above] = gap.labels;
  if (below.is_solid != above.is_solid || is_linked(gap)) return;
  // Loops that cross may leave a solid that no loop goes around.
  if (above.is_solid &&
      (below.region == kOutside || above.region == kOutside)) {
    return;
  }
  auto& linked = last_linked_[above.is_solid ? 1 : 0];
  linked[std::min<std::size_t>(above.region, linked.size() - 1)] = below.region;
  (above.is_solid ? overlay_->solids : overlay_->voids)
      .push_back({below.region, above.region});
}

void OverlaySweep::State::find_overhangs(const plane::Contours& below,
                                         const plane::Contours& above,
                                         LayerOverlay& overlay) {
  std::vector<bool> overlaps_solid(overlay.around.size());
  for (const Overlap& overlap : overlay.solids) {
    overlaps_solid[overlap.above] = true;
  }
  // Loops that cross may leave a solid that no loop goes around.
  std::erase_if(ledges_, [&](const Ledge& ledge) {
    return ledge.region >= overlaps_solid.size() ||
           !overlaps_solid[ledge.region];
  });
  overhang_search_.find(below, above, ledges_, reach_, overlay.overhangs);
}

OverlaySweep::OverlaySweep() : state_(std::make_unique<State>()) {}
OverlaySweep::~OverlaySweep() = default;
OverlaySweep::OverlaySweep(OverlaySweep&&) noexcept = default;
OverlaySweep& OverlaySweep::operator=(OverlaySweep&&) noexcept = default;

void OverlaySweep::start(const plane::Contours& layer) { state_->start(layer); }

void OverlaySweep::lay_over(const plane::Contours& layer, double reach,
                            LayerOverlay& overlay) {
  state_->lay_over(layer, reach, overlay);
}

}  // namespace lamina::slicer
