#include "slicer/contour/simplify.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "slicer/contour/detail/farthest_reach.h"

namespace lamina::slicer {
namespace {

// Strips are widened across by this share of the greatest coordinate: a little
// more than rounding to the 32-bit numbers of a file can move a vertex and an
// edge towards each other, 2 · √2 · 2⁻²⁴.
constexpr double kClearance = 2e-7;

// They are widened along by this [mm], so that rounding hides nothing at their
// ends.
constexpr double kEndMargin = 1e-9;

// Loops change their area by at most this factor, or its inverse.
constexpr double kAreaFactor = 2;

// Rounds of repair before no vertex is left out but one by one. Usual are one
// or two.
constexpr std::uint32_t kMostRounds = 32;

bool keeps_area(double before, double after) {
  return after / before >= 1 / kAreaFactor && after / before <= kAreaFactor;
}

}  // namespace

// A straight line past a run of vertices, and the run seen in its frame.
struct Simplifier::Shortcut {
  std::uint32_t first;
  std::uint32_t last;
  Vec2 origin;
  Vec2 along;  // unit length
  double length;
  double lowest = 0;  // deviations of the run, positive to the left
  double highest = 0;
  std::uint32_t farthest = 0;  // the vertex of greatest deviation
  bool is_ahead = true;        // the run lies between the ends

  // abscissa and deviation of a point
  Vec2 place_of(Vec2 point) const {
    const Vec2 to = point - origin;
    return {dot(along, to), cross(along, to)};
  }
};

void Simplifier::simplify(plane::Contours& contours) {
  is_apart_ = false;
  if (!(tolerance_ > 0) || contours.is_empty()) return;
  copy_loops(contours);
  vertices_.clear();
  ends_.clear();
  for (Loop& loop : loops_) choose(loop);
  kept_.assign(points_.size(), 0);
  for (const std::uint32_t i : vertices_) kept_[i] = 1;
  find_neighbours();
  // A vertex that a repair brings back can lie in another strip: look again.
  // A wall can hand that on to the next, and so on through thousands of walls.
  for (std::uint32_t round = 1; repair(); ++round) {
    if (round == kMostRounds) keep_all();
    list_kept();
    find_neighbours();
  }
  // Clear shortcuts keep the distance as well.
  is_apart_ = !is_crowded_ && !has_meetings();
  for (std::size_t l = 0; l < loops_.size(); ++l) {
    if (loops_[l].has_spare) {
      thin_out(loops_[l], l == 0 ? 0 : ends_[l - 1], ends_[l]);
    }
  }
  write_kept(contours);
}

void Simplifier::copy_loops(const plane::Contours& contours) {
  points_.clear();
  loops_.clear();
  Reach reach;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    const Vec2* first = loop.data();
    DoubledArea doubled_area(loop.front(), loop.back());
    for (const Vec2& point : loop) {
      if (point.x <= first->x && (point.x < first->x || point.y < first->y)) {
        first = &point;
      }
      reach.add(point);
      doubled_area.add(point);
    }
    const auto begin = static_cast<std::uint32_t>(points_.size());
    points_.insert(points_.end(), first, loop.data() + loop.size());
    points_.insert(points_.end(), loop.data(), first + 1);
    loops_.push_back({begin, static_cast<std::uint32_t>(points_.size() - 1),
                      doubled_area.value()});
  }
  clearance_ = kClearance * reach.value();
}

// Chooses the vertices of a loop as if it were alone.
void Simplifier::choose(Loop& loop) {
  const std::size_t begin = vertices_.size();
  bool is_chosen = false;
  for (double tolerance = tolerance_; tolerance > kEndMargin && !is_chosen;
       tolerance /= 2) {
    vertices_.resize(begin);
    choose_farthest(points_, loop.begin, loop.end, tolerance, vertices_);
    is_chosen = keeps_area(loop.doubled_area,
                           doubled_area_kept(begin, vertices_.size()));
    loop.has_spare = loop.has_spare || !is_chosen;
  }
  if (!is_chosen) {
    vertices_.resize(begin);
    for (std::uint32_t i = loop.begin; i <= loop.end; ++i) {
      vertices_.push_back(i);
    }
  }
  ends_.push_back(static_cast<std::uint32_t>(vertices_.size()));
}

void Simplifier::keep_all() {
  kept_.assign(points_.size(), 1);
  for (Loop& loop : loops_) loop.has_spare = true;
}

// Lists the vertices that are kept.
void Simplifier::list_kept() {
  vertices_.clear();
  ends_.clear();
  for (const Loop& loop : loops_) {
    for (std::uint32_t i = loop.begin; i <= loop.end; ++i) {
      if (kept_[i] != 0) vertices_.push_back(i);
    }
    ends_.push_back(static_cast<std::uint32_t>(vertices_.size()));
  }
}

// Fills the tree and finds the bundles whose strips and vertices may meet. A
// strip lies within the box of its run, widened by the clearance; where runs
// follow each other and advance along an axis, so do their strips.
void Simplifier::find_neighbours() {
  tree_.fill(points_, vertices_, ends_);
  near_pairs_.clear();
  is_crowded_ = tree_.visit_near(clearance_ + 2 * kEndMargin,
                                 [this](const plane::EdgeTree::Bundle& a,
                                        const plane::EdgeTree::Bundle& b) {
                                   const std::uint32_t i = tree_.index_of(a);
                                   const std::uint32_t k = tree_.index_of(b);
                                   near_pairs_.push_back({i, k});
                                   if (i != k) near_pairs_.push_back({k, i});
                                   return false;
                                 });
  if (is_crowded_) {
    grid_.fill(points_, vertices_);
    return;
  }
  // Sort by the first bundle: count, sum up, and deal out from the back.
  near_begins_.assign(tree_.bundle_count() + 1, 0);
  for (const auto& [bundle, other] : near_pairs_) ++near_begins_[bundle];
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : near_begins_) begin = sum += begin;
  near_bundles_.resize(near_pairs_.size());
  for (const auto& [bundle, other] : near_pairs_) {
    near_bundles_[--near_begins_[bundle]] = other;
  }
}

// Whether a vertex is within the clearance of a foreign edge.
bool Simplifier::has_meetings() const {
  const auto take = [](std::uint32_t, std::uint32_t) { return true; };
  return std::ranges::any_of(near_pairs_, [&](const auto& pair) {
    return tree_.visit_meetings(tree_.bundle(pair.first),
                                tree_.bundle(pair.second), clearance_, take);
  });
}

// Splits runs until each is safe. Returns whether it brought a vertex back. All
// runs are close to their shortcuts, by the choice or by an earlier call; a run
// without neighbours is clear as well.
bool Simplifier::repair() {
  bool is_changed = false;
  for (std::uint32_t k = 0; k + 1 < vertices_.size(); ++k) {
    // The last vertex of a loop is followed by the first one of the next.
    if (vertices_[k + 1] <= vertices_[k] + 1) continue;
    const std::uint32_t bundle = tree_.bundle_of(k);
    if (!is_crowded_ && near_begins_[bundle] == near_begins_[bundle + 1])
      continue;
    if (split_run(k)) {
      is_changed = true;
      loops_[tree_.bundle(bundle).loop].has_spare = true;
    }
  }
  return is_changed;
}

bool Simplifier::split_run(std::uint32_t k) {
  bool is_changed = false;
  std::uint32_t first = vertices_[k];
  pending_.assign(1, vertices_[k + 1]);
  while (!pending_.empty()) {
    const std::uint32_t last = pending_.back();
    if (last > first + 1) {
      const Shortcut shortcut = measure(first, last);
      if (!is_close(shortcut) || !is_clear(shortcut, k, k + 1)) {
        kept_[shortcut.farthest] = 1;
        pending_.push_back(shortcut.farthest);
        is_changed = true;
        continue;
      }
    }
    first = last;
    pending_.pop_back();
  }
  return is_changed;
}

// Leaves out every vertex of the loop that can be spared, one after another.
// The loop stands at [k, end) in vertices_.
void Simplifier::thin_out(const Loop& loop, std::uint32_t k,
                          std::uint32_t end) {
  double area = doubled_area_kept(k, end);
  std::uint32_t first_k = k;
  for (++k; k + 1 < end; ++k) {
    const std::uint32_t first = vertices_[first_k];
    const std::uint32_t middle = vertices_[k];
    const std::uint32_t last = vertices_[k + 1];
    const Vec2 to_middle = points_[middle] - points_[first];
    const Vec2 to_last = points_[last] - points_[first];
    const double corner = cross(to_middle, to_last);
    if (corner * corner <= tolerance_ * tolerance_ * dot(to_last, to_last) &&
        keeps_area(loop.doubled_area, area - corner)) {
      const Shortcut shortcut = measure(first, last);
      if (is_close(shortcut) && is_clear(shortcut, first_k, k + 1)) {
        kept_[middle] = 0;
        area -= corner;
        continue;
      }
    }
    first_k = k;
  }
}

void Simplifier::write_kept(plane::Contours& contours) const {
  contours.ends.clear();
  contours.points.resize(vertices_.size());
  Vec2* const first = contours.points.data();
  Vec2* next = first;
  std::size_t k = 0;
  for (const std::uint32_t end : ends_) {
    for (; k + 1 < end; ++k) {
      const std::uint32_t i = vertices_[k];
      *next = points_[i];
      next += kept_[i];
    }
    ++k;  // the copy of the first
    contours.ends.push_back(static_cast<std::uint32_t>(next - first));
  }
  contours.points.resize(contours.ends.back());
}

// Twice the area of the loop that stands at [begin, end) in vertices_.
double Simplifier::doubled_area_kept(std::size_t begin, std::size_t end) const {
  DoubledArea area(points_[vertices_[begin]], points_[vertices_[end - 1]]);
  for (std::size_t k = begin + 1; k < end; ++k) area.add(points_[vertices_[k]]);
  return area.value();
}

Simplifier::Shortcut Simplifier::measure(std::uint32_t first,
                                         std::uint32_t last) const {
  const Vec2 along = points_[last] - points_[first];
  const double length = std::sqrt(dot(along, along));
  Shortcut shortcut{first, last, points_[first], along / length, length};
  shortcut.farthest = first + (last - first) / 2;
  for (std::uint32_t i = first + 1; i < last; ++i) {
    const Vec2 place = shortcut.place_of(points_[i]);
    shortcut.is_ahead &= place.x >= 0 && place.x <= length;
    if (std::abs(place.y) > std::max(shortcut.highest, -shortcut.lowest)) {
      shortcut.farthest = i;
    }
    shortcut.lowest = std::min(shortcut.lowest, place.y);
    shortcut.highest = std::max(shortcut.highest, place.y);
  }
  return shortcut;
}

// Whether the run stays within the tolerance.
bool Simplifier::is_close(const Shortcut& shortcut) const {
  return shortcut.is_ahead && shortcut.highest <= tolerance_ &&
         -shortcut.lowest <= tolerance_;
}

// Whether no vertex that is kept lies in the strip of a shortcut from the
// tree's vertex `k` to `last_k`.
bool Simplifier::is_clear(const Shortcut& shortcut, std::uint32_t k,
                          std::uint32_t last_k) const {
  const Vec2 a = points_[shortcut.first];
  const Vec2 b = points_[shortcut.last];
  bool touches_a = false;
  bool touches_b = false;
  const auto is_hit = [&](std::uint32_t i) {
    if (kept_[i] == 0 || (i >= shortcut.first && i <= shortcut.last)) {
      return false;
    }
    // Another loop may touch this one in one end, but not in both: the shortcut
    // could be its own as well.
    const Vec2& point = points_[i];
    touches_a |= point == a;
    touches_b |= point == b;
    if (point == a || point == b) return touches_a && touches_b;
    return is_in_strip(shortcut, shortcut.place_of(point));
  };
  const double reach =
      std::max(shortcut.highest, -shortcut.lowest) + clearance_;
  if (is_crowded_) return !grid_.has_near(a, b, reach, is_hit);
  const std::uint32_t bundle = tree_.bundle_of(k);
  if (last_k > tree_.bundle(bundle).end) {
    return !tree_.has_near(a, b, reach, is_hit);
  }
  for (std::uint32_t i = near_begins_[bundle]; i < near_begins_[bundle + 1];
       ++i) {
    const plane::EdgeTree::Bundle& near = tree_.bundle(near_bundles_[i]);
    for (std::uint32_t n = near.begin; n < near.end; ++n) {
      if (is_hit(vertices_[n])) return false;
    }
  }
  return true;
}

bool Simplifier::is_in_strip(const Shortcut& shortcut, Vec2 place) const {
  if (place.x < -kEndMargin || place.x > shortcut.length + kEndMargin ||
      place.y < shortcut.lowest - clearance_ ||
      place.y > shortcut.highest + clearance_) {
    return false;
  }
  Vec2 from{0, 0};
  for (std::uint32_t i = shortcut.first + 1; i <= shortcut.last; ++i) {
    const Vec2 to = shortcut.place_of(points_[i]);
    // Take the part of this edge that is above or below the place.
    const Vec2 left = from.x <= to.x ? from : to;
    const Vec2 right = from.x <= to.x ? to : from;
    const double begin = std::max(left.x, place.x - kEndMargin);
    const double end = std::min(right.x, place.x + kEndMargin);
    if (begin <= end) {
      const double slope =
          right.x > left.x ? (right.y - left.y) / (right.x - left.x) : 0;
      const double y0 = left.y + slope * (begin - left.x);
      const double y1 = right.y - slope * (right.x - end);
      if (place.y >= std::min({0.0, y0, y1}) - clearance_ &&
          place.y <= std::max({0.0, y0, y1}) + clearance_) {
        return true;
      }
    }
    from = to;
  }
  return false;
}

}  // namespace lamina::slicer
