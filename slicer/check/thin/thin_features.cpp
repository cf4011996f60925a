#include "slicer/check/thin/thin_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

// Sides that are no farther apart than this [mm] meet in an edge.
constexpr double kEdgeWidth = 1e-6;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// A feature is reported where it is thinnest; of points as thin but for this
// [mm], which rounding decides, at the lowest.
constexpr double kSameWidth = 1e-7;

// Cells are no smaller than this share of the width, so that a search around
// the largest disk visits some hundred at most.
constexpr double kLeastCell = 0.125;

// Cells for each line, at most, and cells that lines pass, on the average.
constexpr double kCellsPerLine = 2;
constexpr double kMostCellsPerLine = 64;

// Disks that miss each other by less overlap: rounding may part them [mm].
constexpr double kOverlapSlack = 1e-7;

bool lie_on_two_sides(Vec2 from, Vec2 to, Vec2 a, Vec2 b) {
  const Vec2 along = to - from;
  return (cross(along, a - from) > 0) != (cross(along, b - from) > 0);
}

// Whether the boxes of two lines are farther apart than this.
bool are_farther(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double distance) {
  return std::min(c.x, d.x) - std::max(a.x, b.x) > distance ||
         std::min(a.x, b.x) - std::max(c.x, d.x) > distance ||
         std::min(c.y, d.y) - std::max(a.y, b.y) > distance ||
         std::min(a.y, b.y) - std::max(c.y, d.y) > distance;
}

// Lines shorter than rounding have no sides: lines that are far apart do not
// cross.
bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return !are_farther(a, b, c, d, 0) && lie_on_two_sides(a, b, c, d) &&
         lie_on_two_sides(c, d, a, b);
}

double distance_of_lines(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (cross_each_other(a, b, c, d)) return 0;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d),
                   distance_to_segment(c, a, b), distance_to_segment(d, a, b)});
}

// Whether the disks along two stretches are the same, but for what counts as an
// overlap anyway.
bool are_same_disks(Vec2 from, Vec2 to, double reach, Vec2 other_from,
                    Vec2 other_to, double other_reach) {
  return std::abs(reach - other_reach) <= kOverlapSlack &&
         glm::distance(from, other_from) <= kOverlapSlack &&
         glm::distance(to, other_to) <= kOverlapSlack;
}

// Whether a feature is to be reported at `by` rather than where it is so far.
bool is_better(const ThinFeature& by, const ThinFeature& feature) {
  if (std::abs(by.width - feature.width) > kSameWidth) {
    return by.width < feature.width;
  }
  if (by.layer != feature.layer) return by.layer < feature.layer;
  return by.length > feature.length;
}

void extend(ThinFeature& feature, const ThinFeature& by) {
  const ThinFeature before = feature;
  if (is_better(by, feature)) feature = by;
  feature.low = glm::min(before.low, by.low);
  feature.high = glm::max(before.high, by.high);
  feature.first_layer = std::min(before.first_layer, by.first_layer);
  feature.last_layer = std::max(before.last_layer, by.last_layer);
  feature.bottom = std::min(before.bottom, by.bottom);
  feature.top = std::max(before.top, by.top);
}

}  // namespace

bool is_low(const ThinFeature& feature, double width) {
  return feature.height > 0 && feature.height < width - kEdgeWidth;
}

bool is_edge(const ThinFeature& feature) { return feature.width < kEdgeWidth; }

std::pair<bool, double> rank_of(const ThinFeature& feature) {
  return {is_edge(feature), feature.width};
}

std::string_view name_of(ThinKind kind) {
  return kind == ThinKind::kWall ? "wall" : "gap";
}

// --- Stretches by place ------------------------------------------------------

void FeatureCollector::StretchGrid::clear(
    std::span<const ThinStretch> stretches, double least) {
  members_.clear();
  items_.clear();
  last_visits_.clear();
  visit_ = 0;
  greatest_reach_ = 0;
  Box2 box;
  double length = 0;
  for (const ThinStretch& stretch : stretches) {
    greatest_reach_ = std::max(greatest_reach_, stretch.reach);
    box.add(stretch.from);
    box.add(stretch.to);
    length += glm::distance(stretch.from, stretch.to);
  }
  const auto count = static_cast<double>(stretches.size());
  grid_ = stretches.empty()
              ? CellGrid()
              : CellGrid(kCellsPerLine * count, box,
                         std::max({2 * greatest_reach_, least,
                                   length / (kMostCellsPerLine * count)}));
  heads_.assign(grid_.size(), kNone);
}

std::uint32_t FeatureCollector::StretchGrid::add(const Member& member) {
  const auto number = static_cast<std::uint32_t>(members_.size());
  members_.push_back(member);
  last_visits_.push_back(0);
  grid_.visit_cells(
      member.from, member.to, Vec2(kOverlapSlack), [&](std::size_t cell) {
        items_.push_back({number, heads_[cell]});
        heads_[cell] = static_cast<std::uint32_t>(items_.size()) - 1;
      });
  return number;
}

template <typename Visit>
void FeatureCollector::StretchGrid::visit_near(Vec2 from, Vec2 to,
                                               double distance,
                                               const Visit& visit) {
  if (members_.empty()) return;
  ++visit_;
  const Vec2 reach(distance + greatest_reach_);
  grid_.visit_cells(from, to, reach, [&](std::size_t cell) {
    for (std::uint32_t item = heads_[cell]; item != kNone;
         item = items_[item].next) {
      const std::uint32_t member = items_[item].member;
      if (last_visits_[member] == visit_) continue;
      last_visits_[member] = visit_;
      visit(members_[member]);
    }
  });
}

// --- Features --------------------------------------------------------------

std::vector<std::uint32_t> source_ids(const csg::Scene& scene) {
  std::map<std::tuple<const Source*, std::uint32_t, std::uint32_t>,
           std::uint32_t>
      known;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(scene.instances.size());
  for (const csg::Instance& instance : scene.instances) {
    const SourceRange& range = instance.range;
    const auto next = static_cast<std::uint32_t>(known.size());
    numbers.push_back(
        known.try_emplace({range.source, range.begin, range.end}, next)
            .first->second);
  }
  return numbers;
}

FeatureCollector::FeatureCollector(double width,
                                   std::vector<std::uint32_t> source_ids)
    : width_(width), source_ids_(std::move(source_ids)) {}

std::uint32_t FeatureCollector::join_features(std::uint32_t a,
                                              std::uint32_t b) {
  if (a == kNone || a == b) return b;
  const std::uint32_t kept = feature_union_.unite(a, b);
  extend(features_[kept], features_[std::max(a, b)]);
  return kept;
}

std::uint32_t FeatureCollector::join_thin_places(std::uint32_t a,
                                                 std::uint32_t b) {
  if (a == kNone || a == b) return b;
  const std::uint32_t kept = thin_place_union_.unite(a, b);
  const Span gone = thin_places_[std::max(a, b)];
  thin_places_[kept] = {std::min(thin_places_[kept].bottom, gone.bottom),
                        std::max(thin_places_[kept].top, gone.top)};
  return kept;
}

FeatureCollector::Member FeatureCollector::member_of(
    const ThinStretch& stretch) const {
  const auto source = [this](std::uint32_t instance) {
    return instance < source_ids_.size() ? source_ids_[instance] : kNone;
  };
  const auto [low, high] =
      std::minmax({source(stretch.instances[0]), source(stretch.instances[1])});
  return {stretch.from,
          stretch.to,
          stretch.reach,
          stretch.kind,
          std::uint64_t{high} << 32 | low,
          kNone,
          kNone};
}

// Joins the stretch with all that it overlaps. Returns the number of a member
// of its layer that stands for it, too, or kNone: one with the same disks and
// the same lines of the design, which has been joined with all that these
// overlap.
//
// gap  by which its disks may miss those of the layer below [mm]
std::uint32_t FeatureCollector::join_neighbours(Member& stretch, double gap) {
  std::uint32_t equal = kNone;
  const auto look = [&](StretchGrid& grid, double slack) {
    const double distance = stretch.reach + slack;
    grid.visit_near(
        stretch.from, stretch.to, distance, [&](const Member& other) {
          if (other.kind != stretch.kind) return;
          const std::uint32_t place = thin_place_union_.find(other.thin_place);
          const bool is_alike = other.sources == stretch.sources;
          if (is_alike && &grid == &here_ &&
              are_same_disks(stretch.from, stretch.to, stretch.reach,
                             other.from, other.to, other.reach)) {
            equal = here_.number_of(other);
          }
          const std::uint32_t feature =
              is_alike ? feature_union_.find(other.feature) : stretch.feature;
          if (place == stretch.thin_place && feature == stretch.feature) {
            return;
          }
          const double most = distance + other.reach;
          if (are_farther(stretch.from, stretch.to, other.from, other.to,
                          most) ||
              distance_of_lines(stretch.from, stretch.to, other.from,
                                other.to) > most) {
            return;
          }
          stretch.thin_place = join_thin_places(stretch.thin_place, place);
          if (is_alike)
            stretch.feature = join_features(stretch.feature, feature);
        });
  };
  look(here_, kOverlapSlack);
  if (equal == kNone) look(below_, gap);
  return equal;
}

// Adds the stretch to its feature and its thin place, or to new ones if it has
// none.
void FeatureCollector::count(const ThinFeature& one, Member& member) {
  if (member.thin_place == kNone) {
    member.thin_place = thin_place_union_.add();
    thin_places_.push_back({one.bottom, one.top});
  } else {
    thin_places_[member.thin_place].top =
        std::max(thin_places_[member.thin_place].top, one.top);
  }
  if (member.feature == kNone) {
    member.feature = feature_union_.add();
    features_.push_back(one);
    thin_place_of_.push_back(member.thin_place);
  } else {
    extend(features_[member.feature], one);
  }
}

ThinFeature FeatureCollector::feature_of(const ThinStretch& stretch,
                                         const Layer& layer) const {
  return {stretch.kind,
          layers_,
          layers_,
          layer.bottom,
          layer.top,
          glm::min(stretch.from, stretch.to),
          glm::max(stretch.from, stretch.to),
          stretch.width,
          glm::distance(stretch.from, stretch.to),
          layers_,
          layer.section_z,
          stretch.place,
          stretch.instances,
          0};
}

void FeatureCollector::take(const Layer& layer,
                            std::span<const ThinStretch> stretches) {
  ++layers_;
  const double gap =
      std::clamp(layer.section_z - last_z_, kOverlapSlack, width_);
  last_z_ = layer.section_z;
  const bool repeats = std::ranges::equal(stretches, last_stretches_);
  if (repeats && gap <= joined_gap_) {
    take_again(layer);
    return;
  }
  joined_gap_ = repeats ? gap : -1;
  last_stretches_.assign(stretches.begin(), stretches.end());
  std::swap(here_, below_);
  here_.clear(stretches, kLeastCell * width_);
  numbers_.clear();
  for (const ThinStretch& stretch : stretches) {
    Member member = member_of(stretch);
    const std::uint32_t equal = join_neighbours(member, gap);
    count(feature_of(stretch, layer), member);
    numbers_.push_back(equal == kNone ? here_.add(member) : equal);
  }
}

// Takes the stretches of the last two layers once more. Each overlaps itself
// below, and all that can be joined has been.
void FeatureCollector::take_again(const Layer& layer) {
  for (std::size_t i = 0; i < last_stretches_.size(); ++i) {
    Member& member = here_.members()[numbers_[i]];
    member.thin_place = thin_place_union_.find(member.thin_place);
    member.feature = feature_union_.find(member.feature);
    count(feature_of(last_stretches_[i], layer), member);
  }
}

std::vector<ThinFeature> FeatureCollector::finish() {
  std::vector<ThinFeature> features;
  for (std::uint32_t i = 0; i < features_.size(); ++i) {
    if (feature_union_.find(i) != i) continue;
    const Span& place = thin_places_[thin_place_union_.find(thin_place_of_[i])];
    features.push_back(features_[i]);
    features.back().height = place.top - place.bottom;
  }
  std::ranges::stable_sort(features, {}, [](const ThinFeature& feature) {
    return std::tuple(feature.first_layer, feature.kind, feature.place.x,
                      feature.place.y);
  });
  return features;
}

std::vector<ThinFeature> find_thin_features(const Layer& layer, double width) {
  std::vector<ThinStretch> stretches;
  ThinFinder(width).find(layer.contours, stretches);
  FeatureCollector collector(width, {});
  collector.take(layer, stretches);
  return collector.finish();
}

}  // namespace lamina::slicer
