#include "ldni/image/loop_builder.h"

#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace lamina::ldni {
namespace {

// A point this near to the line through its neighbours [mm] lies on it. Just
// above the rounding of a depth, so that the loops stay those of the paper:
// along an arc the distances add up over the rays of a loop (some 10³).
constexpr double kCollinearDistance = 1e-12;

constexpr std::uint32_t kWalked = std::numeric_limits<std::uint32_t>::max();

// Walks the samples of one ray upwards. Sample 2i enters interval i of the
// layer, sample 2i+1 leaves it.
class RayCursor {
 public:
  // The ray is empty where the layer has no such ray.
  RayCursor(const LayerIntervals& layer, std::size_t ray)
      : intervals_(layer.intervals.data()) {
    if (ray >= layer.ray_count()) return;
    sample_ = ray == 0 ? 0 : 2 * layer.ends[ray - 1];
    end_ = 2 * layer.ends[ray];
  }

  bool is_done() const { return sample_ == end_; }
  std::uint32_t sample() const { return sample_; }
  bool is_entry() const { return sample_ % 2 == 0; }
  double depth() const {
    const Interval& interval = intervals_[sample_ / 2];
    return is_entry() ? interval.enter.depth : interval.exit.depth;
  }
  void advance() { ++sample_; }

 private:
  const Interval* intervals_;
  std::uint32_t sample_ = 0;
  std::uint32_t end_ = 0;
};

// Whether the next sample of `a` comes before that of `b`. At one depth exits
// come first: intervals that only touch are apart, being half-open.
bool comes_first(const RayCursor& a, const RayCursor& b) {
  if (a.is_done()) return false;
  if (b.is_done()) return true;
  if (a.depth() != b.depth()) return a.depth() < b.depth();
  return !a.is_entry();
}

bool is_collinear(const Vec2& before, const Vec2& point, const Vec2& after) {
  const Vec2 to_point = point - before;
  const Vec2 to_after = after - before;
  const double area = to_point.x * to_after.y - to_point.y * to_after.x;
  return std::abs(area) <= kCollinearDistance * glm::length(to_after);
}

// Leaves the collinear points out of the loop that begins at `first`.
void drop_collinear_points(std::vector<Vec2>& points, std::size_t first) {
  std::size_t end = first;
  for (std::size_t i = first; i < points.size(); ++i) {
    const Vec2 point = points[i];
    const Vec2 after = points[i + 1 < points.size() ? i + 1 : first];
    const Vec2 before = end > first ? points[end - 1] : points.back();
    if (!is_collinear(before, point, after)) points[end++] = point;
  }
  points.resize(end);
}

}  // namespace

void LoopBuilder::build(const RayGrid& rays, const LayerIntervals& intervals,
                        plane::Contours& contours) {
  next_.resize(2 * intervals.intervals.size());
  ray_of_interval_.clear();
  for (std::size_t ray = 0; ray < intervals.ray_count(); ++ray) {
    ray_of_interval_.resize(intervals.ends[ray],
                            static_cast<std::uint32_t>(ray));
  }
  for (std::size_t gap = 0; gap <= intervals.ray_count(); ++gap) {
    link_gap(intervals, gap);
  }
  contours.clear();
  walk_links(rays, intervals, contours);
}

// Links the samples of the rays beside a gap: ray gap-1 and ray gap. Before the
// first ray and after the last nothing is solid.
void LoopBuilder::link_gap(const LayerIntervals& intervals, std::size_t gap) {
  RayCursor left(intervals, gap == 0 ? intervals.ray_count() : gap - 1);
  RayCursor right(intervals, gap);
  while (!left.is_done() || !right.is_done()) {
    // Take the two ends of the next stretch in which one ray alone is inside.
    std::array<std::uint32_t, 2> pair{};
    std::array<bool, 2> goes_on{};
    for (std::size_t i = 0; i < 2; ++i) {
      const bool takes_left = comes_first(left, right);
      RayCursor& cursor = takes_left ? left : right;
      pair[i] = cursor.sample();
      // The solid is on a loop's left: with entries it runs towards +x, out of
      // the left ray; with exits towards -x, out of the right one.
      goes_on[i] = cursor.is_entry() == takes_left;
      cursor.advance();
    }
    if (goes_on[0]) next_[pair[0]] = pair[1];
    if (goes_on[1]) next_[pair[1]] = pair[0];
  }
}

// Algorithm 1.1 of the paper: follows the links from every sample not yet
// visited until the loop closes.
void LoopBuilder::walk_links(const RayGrid& rays,
                             const LayerIntervals& intervals,
                             plane::Contours& contours) {
  for (std::uint32_t start = 0; start < next_.size(); ++start) {
    if (next_[start] == kWalked) continue;
    const std::size_t first_point = contours.points.size();
    for (std::uint32_t sample = start; next_[sample] != kWalked;) {
      const Interval& interval = intervals.intervals[sample / 2];
      contours.points.emplace_back(
          rays.ray_x(ray_of_interval_[sample / 2]),
          sample % 2 == 0 ? interval.enter.depth : interval.exit.depth);
      const std::uint32_t next = next_[sample];
      next_[sample] = kWalked;
      sample = next;
    }
    // A loop on one ray alone is a line without area.
    if (contours.points.size() - first_point < 4) {
      contours.points.resize(first_point);
      continue;
    }
    drop_collinear_points(contours.points, first_point);
    contours.ends.push_back(static_cast<std::uint32_t>(contours.points.size()));
  }
}

}  // namespace lamina::ldni
