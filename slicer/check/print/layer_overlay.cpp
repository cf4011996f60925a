#include "slicer/check/print/layer_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/diagnostic.h"
#include "plane/edge_tree.h"
#include "plane/loop_area.h"
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
  const Vec2* at = nullptr;  // the segment from at[0] to at[1]
  const Vec2* last = nullptr;
  double slope = 0;
  std::uint32_t loop = 0;
  std::uint8_t layer = 0;  // 0: below, 1: above
  bool is_solid_above = false;
  Label above;  // once it is on the ray

  void set(const Vec2* place) {
    at = place;
    slope = (at[1].y - at[0].y) / (at[1].x - at[0].x);
  }
  // Moves on to the segment that holds x or begins there.
  void advance(double x) {
    if (at[1].x > x || at + 1 == last) return;
    const Vec2* place = at;
    while (place[1].x <= x && place + 1 != last) ++place;
    set(place);
  }
  double y_at(double x) const {
    return x == at[1].x ? at[1].y : at->y + (x - at->x) * slope;
  }
};

// The gap above a sample, up to the next one.
struct Gap {
  std::uint32_t upper = kNone;  // sample; none: the gap has no end
  std::uint32_t stamp = 0;      // of its events
  // Of the layers. Those of a new gap differ from all, so that the gaps above
  // it are renewed.
  std::array<Label, 2> labels = {Label{kUnknown}, Label{kUnknown}};
  double begin = 0;      // x from where on it has been the same
  bool is_wide = false;  // its certificate has seen more than the reach
  int segments = 0;      // that the next look along its chains takes in
  const Vec2* lower_at = nullptr;
  const Vec2* upper_at = nullptr;

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

// A ledge from one x to another, between two chains.
struct Ledge {
  std::uint32_t region = 0;
  double begin = 0;
  double end = 0;
  const Vec2* lower = nullptr;  // of the segments at `begin`
  const Vec2* upper = nullptr;
  const Vec2* lower_last = nullptr;
  const Vec2* upper_last = nullptr;
  bool is_lower_held = false;  // the chain bounds the solid below
  bool is_upper_held = false;
};

// What a look along two neighbours finds.
struct Outlook {
  double crossing = kNever;
  double contact = kNever;  // from where on they are kContactWidth apart
  double valid_until = kNever;
  bool is_wide = false;  // farther apart than the reach somewhere on the way
};

// A place on a chain that moves on from segment to segment.
class Cursor {
 public:
  Cursor(const Vec2* at, const Vec2* last) : at_(at), last_(last) { set(); }

  double right() const { return at_[1].x; }
  const Vec2* at() const { return at_; }
  const Vec2& end() const { return at_[1]; }
  // False on the last segment.
  bool step() {
    if (at_ + 1 == last_) return false;
    ++at_;
    set();
    return true;
  }
  double y_at(double x) const {
    return x == at_[1].x ? at_[1].y : at_->y + (x - at_->x) * slope_;
  }

 private:
  void set() { slope_ = (at_[1].y - at_->y) / (at_[1].x - at_->x); }

  const Vec2* at_;
  const Vec2* last_;
  double slope_ = 0;
};

// Looks from x on, which the present segments of both samples hold. Most of the
// sweep's time passes here.
Outlook look_along(const Sample& lower, const Sample& upper, double x,
                   bool may_cross, double reach, int segments) {
  const Vec2* a = lower.at;
  const Vec2* b = upper.at;
  double slope_a = lower.slope;
  double slope_b = upper.slope;
  Outlook outlook;
  double left = x;
  double distance = upper.y_at(x) - lower.y_at(x);
  outlook.is_wide = distance > reach;
  if (distance > kContactWidth) {
    outlook.contact = x;
    if (!may_cross) return outlook;
  }
  for (int i = 0; i < segments; ++i) {
    const bool ends_a = a[1].x <= b[1].x;
    const bool ends_b = b[1].x <= a[1].x;
    const double right = ends_a ? a[1].x : b[1].x;
    const double y_a = ends_a ? a[1].y : a->y + (right - a->x) * slope_a;
    const double y_b = ends_b ? b[1].y : b->y + (right - b->x) * slope_b;
    const double next = y_b - y_a;
    if (next > reach) outlook.is_wide = true;
    if (next > kContactWidth && outlook.contact == kNever) {
      outlook.contact = left + (right - left) * (kContactWidth - distance) /
                                   (next - distance);
      if (!may_cross) return outlook;
    }
    if (next < -kCrossingDepth && may_cross) {
      outlook.crossing =
          distance > 0 ? left + (right - left) * distance / (distance - next)
                       : left;
      return outlook;
    }
    if (ends_a) {
      if (++a == lower.last) return outlook;
      slope_a = (a[1].y - a->y) / (a[1].x - a->x);
    }
    if (ends_b) {
      if (++b == upper.last) return outlook;
      slope_b = (b[1].y - b->y) / (b[1].x - b->x);
    }
    left = right;
    distance = next;
  }
  outlook.valid_until = left;
  return outlook;
}

// Finds overhangs on ledges. Places of a square grid are asked, and the
// vertices of the layer above. The grid depends on the ledges alone, so that
// what else the layer holds changes nothing.
//
// Successive vertices of either chain cut a ledge into trapezoids, its parts. A
// part where no place of the grid hangs over may still be a narrow bridge
// between them, so its middle is asked.
class OverhangSearch {
 public:
  //
  // tree  any; it will hold the edges of `below` where places ask for them
  OverhangSearch(const plane::Contours& below, const plane::Contours& above,
                 const std::vector<Ledge>& ledges, double reach,
                 plane::EdgeTree& tree, std::vector<Overhang>& found)
      : below_(below),
        tree_(tree),
        reach_(reach),
        box_(box_of(above)),
        pitch_(std::max(kPitch, least_pitch(ledges))),
        found_(found) {}

  void search(const Ledge& ledge) {
    overhang_ = {};
    overhang_.region = ledge.region;
    asked_vertex_ = Vec2(kNever);
    does_vertex_hang_over_ = false;
    bool is_first = true;
    visit_parts(ledge,
                [&](const Cursor& lower, const Cursor& upper, double left,
                    double right, double width, double next) {
                  if (std::max(width, next) > reach_) {
                    for (const Cursor* const cursor : {&lower, &upper}) {
                      if (!is_first || cursor->at()->x < left) continue;
                      ask_vertex(ledge, lower, upper, *cursor, *cursor->at());
                    }
                    search_part(ledge, lower, upper, left, right);
                  }
                  is_first = false;
                });
    if (overhang_.distance > 0) found_.push_back(overhang_);
  }

 private:
  static Box2 box_of(const plane::Contours& contours) {
    Box2 box;
    box.add(std::span<const Vec2>(contours.points));
    return box;
  }

  // Calls visit(lower, upper, left, right, width, next) for the parts of a
  // ledge, with their widths in y on the left and on the right.
  template <typename Visit>
  static void visit_parts(const Ledge& ledge, const Visit& visit) {
    Cursor lower(ledge.lower, ledge.lower_last);
    Cursor upper(ledge.upper, ledge.upper_last);
    double left = ledge.begin;
    double width = upper.y_at(left) - lower.y_at(left);
    for (;;) {
      const double right = std::min({lower.right(), upper.right(), ledge.end});
      const double next = upper.y_at(right) - lower.y_at(right);
      visit(lower, upper, left, right, width, next);
      if (right >= ledge.end) return;
      // An end of the ledge that rounding puts behind that of a chain.
      if ((lower.right() == right && !lower.step()) ||
          (upper.right() == right && !upper.step())) {
        return;
      }
      left = right;
      width = next;
    }
  }

  // From which on the ledges take no more than the most places, their columns
  // counted as one each besides.
  double least_pitch(const std::vector<Ledge>& ledges) const {
    double length = 0;
    for (const Ledge& ledge : ledges) length += ledge.end - ledge.begin;
    const auto pitch_for = [&](double area) {
      return (length + std::sqrt(length * length + 4 * kMostPlaces * area)) /
             (2 * kMostPlaces);
    };
    // They hardly ever fill the layer's box.
    const double box_pitch = pitch_for(box_.size().x * box_.size().y);
    if (box_pitch <= kPitch) return box_pitch;
    double area = 0;
    for (const Ledge& ledge : ledges) {
      visit_parts(ledge, [&](const Cursor&, const Cursor&, double left,
                             double right, double width, double next) {
        area += (right - left) * std::max((width + next) / 2, 0.0);
      });
    }
    return pitch_for(area);
  }

  // Between two successive vertices of either chain.
  void search_part(const Ledge& ledge, const Cursor& lower, const Cursor& upper,
                   double left, double right) {
    const double area = overhang_.area;
    const double least = least_step((right - left) / pitch_);
    double columns = 1;
    for (double column = std::ceil(left / pitch_); column * pitch_ < right;) {
      if (columns > 1) {
        columns = std::min(columns, std::ceil(right / pitch_) - column);
      }
      const double beyond =
          search_column(ledge, lower, upper, column * pitch_, columns);
      column += columns;
      columns = least;
      if (beyond > 0) {
        columns = std::max(least, std::floor(kStride / 2 * beyond / pitch_));
      }
    }
    for (const Cursor* const cursor : {&lower, &upper}) {
      if (cursor->right() != right) continue;
      ask_vertex(ledge, lower, upper, *cursor, cursor->end());
    }
    if (overhang_.area == area) ask_middle(ledge, lower, upper, left, right);
  }

  // The stretch of a column that no held chain above or below is within reach
  // of. Where loops of a file cross, a ledge may reach beyond its layer.
  double low_at(const Ledge& ledge, const Cursor& lower, double x) const {
    return std::max(lower.y_at(x) + (ledge.is_lower_held ? reach_ : 0),
                    box_.low.y);
  }
  double high_at(const Ledge& ledge, const Cursor& upper, double x) const {
    return std::min(upper.y_at(x) - (ledge.is_upper_held ? reach_ : 0),
                    box_.high.y);
  }

  // A part has straight sides: so many columns, and places in one, tell of any.
  static double least_step(double count) {
    constexpr double kMost = 64;
    return count < 2 * kMost ? 1.0 : std::floor(count / kMost);
  }

  // Returns how far beyond the reach the farthest place is that was asked.
  //
  // columns  for which this one stands: from here on to the right
  double search_column(const Ledge& ledge, const Cursor& lower,
                       const Cursor& upper, double x, double columns) {
    const double low = low_at(ledge, lower, x);
    const double high = high_at(ledge, upper, x);
    double farthest = 0;
    if (!(low <= high)) return farthest;
    const double first_row = std::ceil(low / pitch_);
    const double last_row = std::floor(high / pitch_);
    const double least = least_step(last_row - first_row);
    for (double row = first_row; row <= last_row;) {
      const Vec2 place(x, row * pitch_);
      const double distance =
          ask(place, distance_to_chains(ledge, lower, upper, place));
      if (distance <= reach_) {
        row += least;
        continue;
      }
      // What is nearer than that to the place hangs over as well.
      const double rows =
          std::max(least, std::floor(kStride * (distance - reach_) / pitch_));
      const double end = std::min(row + rows, last_row + 1);
      farthest = std::max(farthest, distance - reach_);
      overhang_.area += (end - row) * columns * pitch_ * pitch_;
      overhang_.box.add(Vec2(x, (end - 1) * pitch_));
      overhang_.box.add(Vec2(x + (columns - 1) * pitch_, row * pitch_));
      row = end;
    }
    return farthest;
  }

  // Asks the middle of a part, or of its free side if it has one whose vertex
  // has not hung over.
  void ask_middle(const Ledge& ledge, const Cursor& lower, const Cursor& upper,
                  double left, double right) {
    const bool has_free_side = ledge.is_lower_held != ledge.is_upper_held;
    if (has_free_side && does_vertex_hang_over_) return;
    if (!(right - left > 2 * reach_)) return;
    // Leave the ends out that the two chains hold.
    const double begin =
        high_at(ledge, upper, left) - low_at(ledge, lower, left);
    const double end =
        high_at(ledge, upper, right) - low_at(ledge, lower, right);
    if (!(std::max(begin, end) > 0)) return;
    const double inner = left + (right - left) * begin / (begin - end);
    if (begin < 0) left = inner;
    if (end < 0) right = inner;
    const double width = right - left;
    if (!(width > 2 * reach_)) return;
    const double x = left + width / 2;
    const double low = low_at(ledge, lower, x);
    const double high = high_at(ledge, upper, x);
    const double height = high - low;
    const Vec2 place(x, !has_free_side        ? low + height / 2
                        : ledge.is_lower_held ? high
                                              : low);
    const double distance =
        ask(place, distance_to_chains(ledge, lower, upper, place));
    if (distance <= reach_) return;
    // It is a strip along the part, as wide as its middle tells.
    for (const double end_x : {left, right}) {
      overhang_.box.add(Vec2(end_x, low_at(ledge, lower, end_x)));
      overhang_.box.add(Vec2(end_x, high_at(ledge, upper, end_x)));
    }
    overhang_.area +=
        std::min(width * height, (has_free_side ? 1 : 2) * (distance - reach_) *
                                     std::max(width, height));
  }

  // Asks a vertex of one of the chains if that bounds the layer above.
  void ask_vertex(const Ledge& ledge, const Cursor& lower, const Cursor& upper,
                  const Cursor& chain, Vec2 vertex) {
    if (&chain == &lower ? ledge.is_lower_held : ledge.is_upper_held) return;
    if (is_near(vertex, asked_vertex_)) return;
    asked_vertex_ = vertex;
    does_vertex_hang_over_ =
        ask(vertex, distance_to_chains(ledge, lower, upper, vertex)) > reach_;
  }

  // The distance from those parts of the two chains near the place that hold
  // it. Where chains are steep they are within reach, though not above or
  // below.
  double distance_to_chains(const Ledge& ledge, const Cursor& lower,
                            const Cursor& upper, Vec2 place) const {
    double least = kNever;
    if (ledge.is_lower_held) {
      look_around(lower.at(), ledge.lower, ledge.lower_last, place, least);
    }
    if (ledge.is_upper_held && least > reach_) {
      look_around(upper.at(), ledge.upper, ledge.upper_last, place, least);
    }
    return least;
  }
  // Looks from a segment of a chain to both sides.
  void look_around(const Vec2* at, const Vec2* first, const Vec2* last,
                   Vec2 place, double& least) const {
    const auto look = [&](const Vec2* segment) {
      least =
          std::min(least, distance_to_segment(place, segment[0], segment[1]));
    };
    const Vec2* left = at;
    const Vec2* right = at + 1;
    for (int i = 0; i < kFirstSegments && least > reach_; ++i) {
      const bool goes_left = left >= first && left[1].x >= place.x - reach_;
      const bool goes_right = right < last && right->x <= place.x + reach_;
      if (!goes_left && !goes_right) return;
      if (goes_left) look(left--);
      if (goes_right) look(right++);
    }
  }

  bool is_near(Vec2 a, Vec2 b) const {
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) < pitch_;
  }

  // The distance from what holds the place; within reach, that from any such.
  //
  // known  the distance from some of that
  double ask(Vec2 place, double known) {
    if (known <= reach_) return known;
    if (!is_tree_filled_) tree_.fill(below_);
    is_tree_filled_ = true;
    double distance = std::min(known, tree_.distance(guess_, place));
    if (distance > reach_) tree_.lower(place, reach_, distance, guess_);
    if (distance <= reach_) return distance;
    overhang_.box.add(place);
    if (distance > overhang_.distance) {
      overhang_.distance = distance;
      overhang_.place = place;
    }
    return distance;
  }

  // Places are so far apart [mm], where a layer needs no more than so many.
  static constexpr double kPitch = 0.1;
  static constexpr double kMostPlaces = 512 * 512;
  // In a column the next place follows after this share of the distance that
  // the last one had beyond the reach: the greatest distance falls short by a
  // tenth at most. Columns go by the greatest of the one before, and by half of
  // that: what is greater may stand out to either side.
  static constexpr double kStride = 0.2;

  const plane::Contours& below_;
  // Filled once a place asks for more than the chains beside its ledge.
  plane::EdgeTree& tree_;
  bool is_tree_filled_ = false;
  const double reach_;
  const Box2 box_;  // of the layer above
  const double pitch_;
  std::vector<Overhang>& found_;
  std::size_t guess_ = 0;
  // Of the ledge in hand.
  Overhang overhang_;
  Vec2 asked_vertex_ = Vec2(kNever);  // of a free side
  bool does_vertex_hang_over_ = false;
};

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
  plane::EdgeTree tree_;  // of the layer below, in the search for overhangs
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
      sample.last = &points.back();
      sample.set(points.data());
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
      if (samples_[endpoint.sample].last->x > end) {
        begun_.push_back(endpoint.sample);
      }
    } else if (order_.holds(endpoint.sample)) {
      remove(endpoint.sample, endpoint.x);
    }
  }
  for (const std::uint32_t sample : begun_) {
    insert(sample, samples_[sample].at->x);
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
  Sample one = sample;
  one.advance(x);
  const double distance = other.at->y - one.y_at(x);
  if (std::abs(distance) > kSamePoint) return distance > 0;
  const double right = std::min(one.at[1].x, other.at[1].x);
  return other.y_at(right) > one.y_at(right);
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
  samples_[lower].advance(x);
  samples_[upper].advance(x);
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
  a.advance(x);
  b.advance(x);
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
                     gap.upper_at, a.last, b.last, a.layer == 0, b.layer == 0});
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
  if (ledges_.empty()) return;
  OverhangSearch search(below, above, ledges_, reach_, tree_,
                        overlay.overhangs);
  for (const Ledge& ledge : ledges_) search.search(ledge);
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
