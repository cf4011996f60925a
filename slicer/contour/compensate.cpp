#include "slicer/contour/compensate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/offset.h"
#include "plane/tie_distance.h"
#include "slicer/contour/edge_order.h"

namespace lamina::slicer {
namespace {

using plane::Contour;
using plane::Region;

// Offsetting rounds the number of sides of an arc: one side where 1.5 were
// asked for is 1.5² times as far from the circle.
constexpr double kArcExcess = 2.25;

// Finds the innermost loop of a region around a point.
class Nesting {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  explicit Nesting(const Region& region)
      : parents_(region.contours.size(), kNone) {
    for (std::uint32_t i = 0; i < region.contours.size(); ++i) {
      const Contour& contour = region.contours[i];
      is_outer_.push_back(sliver_area(contour) > 0);
      for (std::size_t k = 0; k < contour.size(); ++k) {
        const Vec2 from = contour[k];
        const Vec2 to = contour[k + 1 < contour.size() ? k + 1 : 0];
        if (from.x != to.x) order_.add(from, to, i);
      }
    }
    order_.build();
    find_parents();
  }

  // The innermost loop around a point; kNone outside all loops.
  std::size_t innermost(Vec2 point) const {
    return loop_above(order_.below(point).nearest);
  }
  // The innermost loop around another one.
  std::size_t parent(std::size_t loop) const { return parents_[loop]; }

 private:
  // What lies below the left end of a loop belongs to loops that begin farther
  // to the left or below: these come first.
  void find_parents() {
    std::vector<const EdgeOrder::Edge*> firsts(parents_.size(), nullptr);
    for (const EdgeOrder::Edge& edge : order_.edges()) {
      const EdgeOrder::Edge*& first = firsts[edge.loop];
      if (first == nullptr || comes_first(&edge, first)) first = &edge;
    }
    std::erase(firsts, nullptr);
    std::ranges::sort(firsts, comes_first);
    for (const EdgeOrder::Edge* first : firsts) {
      parents_[first->loop] = loop_above(order_.below(*first).nearest);
    }
  }

  static bool comes_first(const EdgeOrder::Edge* a, const EdgeOrder::Edge* b) {
    return a->left != b->left ? precedes(a->left, b->left)
                              : EdgeOrder::is_below(*a, *b);
  }

  // The innermost loop right above an edge.
  std::size_t loop_above(const EdgeOrder::Edge* edge) const {
    if (edge == nullptr) return kNone;
    const bool is_inside = (edge->winding > 0) == is_outer_[edge->loop];
    return is_inside ? edge->loop : parents_[edge->loop];
  }

  EdgeOrder order_;
  std::vector<bool> is_outer_;
  std::vector<std::size_t> parents_;
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
    // What lay in a component that vanished is not a component any more.
    const std::size_t home = nesting.parent(i);
    if (home == Nesting::kNone || is_left[home] != 0) ++parted;
  }
  losses.parted = static_cast<std::uint64_t>(std::max<std::int64_t>(parted, 0));
  return losses;
}

}  // namespace

double Foot::of(std::uint32_t index) const {
  return index < layers ? inset * (layers - index) / layers : 0;
}

CompensationCounts& CompensationCounts::operator+=(
    const CompensationCounts& other) {
  vanished_regions += other.vanished_regions;
  vanished_holes += other.vanished_holes;
  broken_walls += other.broken_walls;
  closed_gaps += other.closed_gaps;
  return *this;
}

CompensationCounts compensate(plane::Contours& contours, double amount) {
  if (amount == 0 || contours.is_empty()) return {};
  const Region before = plane::to_region(contours);
  Region after = plane::offset(before, -amount, plane::Join::kRound,
                               kArcTolerance / kArcExcess);
  // Drop what rounding left of walls exactly as thick as the beam.
  plane::drop_hairlines(after, kTieDistance);
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
