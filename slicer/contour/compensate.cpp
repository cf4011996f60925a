#include "slicer/contour/compensate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/loop_area.h"
#include "base/plane.h"
#include "csg/plane/offset.h"
#include "csg/tie_distance.h"

namespace lamina::slicer {
namespace {

using planar::Contour;
using planar::Region;

// Offsetting rounds the number of sides of an arc: one side where 1.5 were
// asked for is 1.5² times as far from the circle.
constexpr double kArcExcess = 2.25;

// Finds the innermost loop of a region around a point.
class Nesting {
 public:
  explicit Nesting(const Region& region) : region_(region) {
    for (const Contour& contour : region.contours) {
      boxes_.emplace_back().add(contour);
      areas_.push_back(std::abs(sliver_area(contour)));
    }
  }

  // The innermost loop but `skipped`; kNone outside all loops.
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t innermost(Vec2 point, std::size_t skipped = kNone) const {
    std::size_t result = kNone;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Box2& box = boxes_[i];
      if (i == skipped) continue;
      if ((result == kNone || areas_[i] < areas_[result]) &&
          point.x > box.low.x && point.x < box.high.x && point.y > box.low.y &&
          point.y < box.high.y &&
          winding_number(region_.contours[i], point) != 0) {
        result = i;
      }
    }
    return result;
  }

 private:
  const Region& region_;
  std::vector<Box2> boxes_;    // of the loops
  std::vector<double> areas_;  // and what they enclose, at least 0
};

// What happened to the components that shrink: regions, or holes and the
// outside.
struct Losses {
  std::uint64_t vanished = 0;
  std::uint64_t parted = 0;  // components that came apart from one that is
                             // left, and growing ones that met
};

// Loops of one sign (+1 regions, -1 holes) bound the components that shrink;
// those of the other sign bound components that grow and can meet.
Losses find_losses(const Region& before, const Region& after, int sign) {
  const auto shrinks = [sign](const Contour& contour) {
    return (sliver_area(contour) > 0) == (sign > 0);
  };
  const Nesting nesting(before);
  std::vector<char> is_left(before.contours.size(), 0);
  std::int64_t parted = 0;
  for (const Contour& contour : after.contours) {
    if (!shrinks(contour)) {
      --parted;
      continue;
    }
    ++parted;
    const std::size_t home = nesting.innermost(contour.front());
    if (home != Nesting::kNone) is_left[home] = 1;
  }
  Losses losses;
  for (std::size_t i = 0; i < before.contours.size(); ++i) {
    const Contour& contour = before.contours[i];
    if (shrinks(contour)) {
      if (is_left[i] != 0) {
        --parted;
      } else {
        ++losses.vanished;
      }
      continue;
    }
    // What lay in a component that vanished is no component any more.
    const std::size_t home =
        nesting.innermost((contour[0] + contour[1]) / 2.0, i);
    if (home == Nesting::kNone || is_left[home] != 0) ++parted;
  }
  losses.parted = static_cast<std::uint64_t>(std::max<std::int64_t>(parted, 0));
  return losses;
}

}  // namespace

CompensationCounts& CompensationCounts::operator+=(
    const CompensationCounts& other) {
  vanished_regions += other.vanished_regions;
  vanished_holes += other.vanished_holes;
  broken_walls += other.broken_walls;
  closed_gaps += other.closed_gaps;
  return *this;
}

CompensationCounts compensate(ldni::Contours& contours, double amount) {
  if (amount == 0 || contours.is_empty()) return {};
  const Region before = planar::to_region(contours);
  Region after = planar::offset(before, -amount, planar::Join::kRound,
                                kArcTolerance / kArcExcess);
  // Drop what rounding left of walls exactly as thick as the beam.
  planar::drop_hairlines(after, kTieDistance);
  contours = to_contours(after);
  CompensationCounts counts;
  if (amount > 0) {
    const Losses losses = find_losses(before, after, +1);
    counts.vanished_regions = losses.vanished;
    counts.broken_walls = losses.parted;
  } else {
    const Losses losses = find_losses(before, after, -1);
    counts.vanished_holes = losses.vanished;
    counts.closed_gaps = losses.parted;
  }
  return counts;
}

}  // namespace lamina::slicer
