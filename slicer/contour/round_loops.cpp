#include "slicer/contour/round_loops.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/check.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "slicer/contour/detail/planar_loops.h"

namespace lamina::slicer {
namespace {

constexpr int kFloatDigits = 24;  // of a float32's binary fraction

// Snapped coordinates are integers up to 2^24 times this: small numbers, among
// which the ray's event points of 1e-9 are narrow.
constexpr double kUnit = 0x1p-14;

// Points nearer than this [mm] are one vertex to the moving ray.
constexpr double kMergeDistance = 2e-9;

// Boxes and steps are measured with this times the spacing, so that rounding
// hides nothing.
constexpr double kTreeReach = 1.001;

// Rounds of snapping by the moving ray; two are usual. Then the last round
// routes each edge on until no part of it meets a foreign hot pixel, and the
// loops are linked without the ray. Where edges crowd, the ray takes the tips
// of spikes for touches, event point by event point, and an edge may drift
// through hundreds of hot pixels: rounds without end.
constexpr int kMostRoutings = 8;

double to_float(double value) {
  // Adding 0 turns -0 to 0: equal points shall have equal bytes. In float32:
  // GCC 12 leaves out both conversions of a vector where nothing is between.
  return static_cast<double>(static_cast<float>(value) + 0.0F);
}
Vec2 to_float(Vec2 point) { return {to_float(point.x), to_float(point.y)}; }

}  // namespace

LoopRounder::LoopRounder()
    : resolver_({.tie_distance = 0, .merge_distance = 0},
                plane::FillRule::kPositive) {}

bool LoopRounder::round(plane::Contours& contours, double clearance) {
  has_snapped_ = false;
  if (contours.is_empty()) return false;
  int exponent = 0;
  std::frexp(greatest_coordinate(contours.points), &exponent);
  spacing_ = std::ldexp(1.0, exponent - kFloatDigits);
  const bool is_known = clearance >= kTreeReach * spacing_;
  if (is_known || is_safe(contours)) {
    for (Vec2& point : contours.points) point = to_float(point);
    return !is_known;
  }
  has_snapped_ = true;
  ++snapped_layers_;
  snap(contours);
  return true;
}

// --- Proof ------------------------------------------------------------------

bool LoopRounder::is_safe(const plane::Contours& contours) {
  points_.clear();
  ends_.clear();
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    const auto loop = contours.loop(l);
    points_.insert(points_.end(), loop.begin(), loop.end());
    points_.push_back(loop.front());
    ends_.push_back(static_cast<std::uint32_t>(points_.size()));
  }
  for (std::size_t i = vertices_.size(); i < points_.size(); ++i) {
    vertices_.push_back(static_cast<std::uint32_t>(i));
  }
  tree_.fill(points_, {vertices_.data(), points_.size()}, ends_);
  // Both ends of a distance move, by half the spacing in each direction.
  const double reach = kTreeReach * spacing_;
  near_pairs_.clear();
  const bool is_crowded =
      tree_.visit_near(reach, [this](const plane::EdgeTree::Bundle& a,
                                     const plane::EdgeTree::Bundle& b) {
        near_pairs_.push_back({&a, &b});
        return false;
      });
  if (is_crowded) return is_safe_by_grid();
  const auto meet = [&](const plane::EdgeTree::Bundle& a,
                        const plane::EdgeTree::Bundle& b) {
    return tree_.visit_meetings(
        a, b, reach, [&](std::uint32_t vertex, std::uint32_t edge) {
          return a.loop == b.loop || !touch(vertex, edge);
        });
  };
  return std::ranges::none_of(near_pairs_, [&](const auto& pair) {
    const auto& [a, b] = pair;
    return meet(*a, *b) || (a != b && meet(*b, *a));
  });
}

// Returns what is_safe() does where too many loops run beside each other for
// the tree.
bool LoopRounder::is_safe_by_grid() {
  members_.clear();
  std::uint32_t begin = 0;
  for (const std::uint32_t end : ends_) {
    for (std::uint32_t i = begin; i + 1 < end; ++i) members_.push_back(i);
    begin = end;
  }
  grid_.fill(points_, members_);
  begin = 0;
  for (const std::uint32_t end : ends_) {
    for (std::uint32_t edge = begin; edge + 1 < end; ++edge) {
      const std::uint32_t to = edge + 2 == end ? begin : edge + 1;
      const auto meets = [&](std::uint32_t i) {
        if (i == edge || i == to) return false;
        const bool is_same_loop = i >= begin && i < end;
        return plane::meets_square(points_[edge], points_[edge + 1], points_[i],
                                   kTreeReach * spacing_) &&
               (is_same_loop || !touch(i, edge));
      };
      if (grid_.has_near(points_[edge], points_[edge + 1],
                         kTreeReach * spacing_, meets)) {
        return false;
      }
    }
    begin = end;
  }
  return true;
}

// Whether two loops touch in a vertex of both and go on doing so: it is rounded
// to one point.
bool LoopRounder::touch(std::uint32_t vertex, std::uint32_t edge) const {
  const Vec2& point = points_[vertex];
  for (const std::uint32_t end : {edge, edge + 1}) {
    const Vec2 step = point - points_[end];
    if (std::abs(step.x) < kMergeDistance &&
        std::abs(step.y) < kMergeDistance &&
        to_float(point) == to_float(points_[end])) {
      return true;
    }
  }
  return false;
}

// --- Snapping ---------------------------------------------------------------

// In units of the spacing, times kUnit.
void LoopRounder::snap(plane::Contours& contours) {
  const double scale = kUnit / spacing_;
  for (Vec2& point : contours.points) point *= scale;
  int moves = 0;
  for (int round = 0;
       route_through_hot_pixels(contours, round == kMostRoutings); ++round) {
    // Snapped for the first time, or edges met foreign cells.
    moves += moves_of_round_;
    most_moves_ = std::max(most_moves_, moves);
    if (round == kMostRoutings) {
      link_planar_loops(contours);
      break;
    }
    resolver_.resolve(contours);
  }
  for (Vec2& point : contours.points) point = to_float(point / scale);
}

// Routes every edge through the hot pixels that it meets. Returns false where
// all points are middles of hot pixels and no edge had to bend: then edges meet
// in vertices only, or in a vertex that lies on an edge exactly.
//
// goes_on  for the last time: then edges meet in vertices only
bool LoopRounder::route_through_hot_pixels(plane::Contours& contours,
                                           bool goes_on) {
  // Find the hot pixels.
  hot_pixels_.clear();
  bool is_changed = false;
  for (const Vec2& point : contours.points) {
    const Vec2 middle(std::nearbyint(point.x / kUnit) * kUnit + 0.0,
                      std::nearbyint(point.y / kUnit) * kUnit + 0.0);
    is_changed |= middle != point;
    hot_pixels_.push_back(middle);
  }
  const std::vector<Vec2> snapped = hot_pixels_;
  std::ranges::sort(hot_pixels_, precedes);
  hot_pixels_.erase(std::unique(hot_pixels_.begin(), hot_pixels_.end()),
                    hot_pixels_.end());
  members_.resize(hot_pixels_.size());
  std::iota(members_.begin(), members_.end(), 0U);
  grid_.fill(hot_pixels_, members_);

  routed_.clear();
  moves_of_round_ = 1;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : contours.ends) {
    for (std::uint32_t from = begin; from < end; ++from) {
      const std::uint32_t to = from + 1 == end ? begin : from + 1;
      routed_.points.push_back(snapped[from]);
      is_changed |=
          goes_on ? routes_on(snapped[from], snapped[to])
                  : bends_edge(contours.points[from], contours.points[to]);
    }
    routed_.ends.push_back(static_cast<std::uint32_t>(routed_.points.size()));
    begin = end;
  }
  std::swap(contours, routed_);
  return is_changed;
}

// Adds the hot pixels between the ends of an edge, in its order. Returns
// whether one is off the edge.
bool LoopRounder::bends_edge(Vec2 from, Vec2 to) {
  const bool bends = find_passages(from, to);
  for (const Passage& passage : passages_) {
    routed_.points.push_back(passage.hot_pixel);
  }
  return bends;
}

// Does so with all parts of the edge as well, until they meet no foreign hot
// pixel. The ends are middles of hot pixels.
bool LoopRounder::routes_on(Vec2 from, Vec2 to) {
  bool bends = false;
  ways_.assign({{to, 1}});
  while (!ways_.empty()) {
    const Way way = ways_.back();
    if (!find_passages(from, way.end)) {
      // The hot pixels are on the edge: none is beside its parts.
      for (const Passage& passage : passages_) {
        routed_.points.push_back(passage.hot_pixel);
      }
      ways_.pop_back();
      from = way.end;
      if (!ways_.empty()) routed_.points.push_back(from);
      continue;
    }
    bends = true;
    // Each move leads to a hot pixel that the edge has not met.
    LAMINA_CHECK_EQ(std::cmp_less_equal(way.moves, hot_pixels_.size()), true);
    moves_of_round_ = std::max(moves_of_round_, way.moves);
    ways_.back().moves = way.moves + 1;
    for (std::size_t i = passages_.size(); i-- > 0;) {
      ways_.push_back({passages_[i].hot_pixel, way.moves + 1});
    }
  }
  return bends;
}

// Finds the hot pixels between the ends of an edge, in its order. Returns
// whether one is off the edge.
bool LoopRounder::find_passages(Vec2 from, Vec2 to) {
  passages_.clear();
  const Vec2 along = to - from;
  grid_.has_near(from, to, kUnit, [&](std::uint32_t i) {
    const Vec2& middle = hot_pixels_[i];
    const bool is_end = plane::meets_square(from, from, middle, kUnit / 2) ||
                        plane::meets_square(to, to, middle, kUnit / 2);
    if (!is_end && plane::meets_square(from, to, middle, kUnit / 2)) {
      passages_.push_back({dot(along, middle), middle});
    }
    return false;
  });
  std::ranges::sort(passages_, {}, &Passage::place);
  return std::ranges::any_of(passages_, [&](const Passage& passage) {
    return cross(along, passage.hot_pixel - from) != 0;
  });
}

}  // namespace lamina::slicer
