#include "slicer/check/print/layer_match.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "slicer/check/print/layer_overlay.h"

namespace lamina::slicer {
namespace {

using Set = BoxedLoops::Set;

// The disc in both regions has this radius [mm]: ten times what the ray calls a
// contact (kContactWidth).
constexpr double kDisc = 0.01;

Set bit(std::uint32_t loop) { return Set{1} << loop; }

double squared_length(Vec2 a) { return dot(a, a); }

// A place on a walk: on both loops, and the vertices that follow there.
struct Rung {
  Vec2 below = Vec2(0);
  Vec2 above = Vec2(0);
  std::size_t next_below = 1;
  std::size_t next_above = 1;
};

// Goes on to the nearer of the next vertices on the two loops.
void step(Rung& rung, std::span<const Vec2> below,
          std::span<const Vec2> above) {
  if (rung.next_above == above.size()) {
    rung.below = below[rung.next_below++];
    return;
  }
  const Vec2& vertex_above = above[rung.next_above];
  if (rung.next_below == below.size()) {
    rung.above = vertex_above;
    ++rung.next_above;
    return;
  }
  const Vec2& vertex_below = below[rung.next_below];
  if (vertex_above == vertex_below) {
    rung.above = rung.below = vertex_above;
    ++rung.next_above;
    ++rung.next_below;
    return;
  }
  const Vec2 along = vertex_below - rung.below;
  const double length = squared_length(along);
  const double share = dot(vertex_above - rung.below, along);
  if (share < length) {
    if (share > 0) rung.below += share / length * along;
    rung.above = vertex_above;
    ++rung.next_above;
    return;
  }
  const Vec2 along_above = vertex_above - rung.above;
  const double length_above = squared_length(along_above);
  const double share_above = dot(vertex_below - rung.above, along_above);
  rung.below = vertex_below;
  ++rung.next_below;
  if (share_above >= length_above) {
    rung.above = vertex_above;
    ++rung.next_above;
  } else if (share_above > 0) {
    rung.above += share_above / length_above * along_above;
  }
}

// Whether two segments meet whose boxes do.
bool do_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return orientation(a, b, c) * orientation(a, b, d) <= 0 &&
         orientation(c, d, a) * orientation(c, d, b) <= 0;
}

// The loop from a place on, which it returns to.
//
// next  the vertex that follows there
void rotate(std::span<const Vec2> loop, std::size_t next, Vec2 place,
            std::vector<Vec2>& rotated) {
  const auto middle = loop.begin() + static_cast<std::ptrdiff_t>(next);
  rotated.assign(1, place);
  rotated.insert(rotated.end(), middle, loop.end());
  rotated.insert(rotated.end(), loop.begin(), middle);
  if (rotated.back() != place) rotated.push_back(place);
}

}  // namespace

// --- Boxed loops ------------------------------------------------------------

void BoxedLoops::fill(const plane::Contours& contours) {
  points_.clear();
  begins_.assign(1, 0);
  boxes_.clear();
  first_boxes_.assign(1, 0);
  loop_boxes_.clear();
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    points_.insert(points_.end(), loop.begin(), loop.end());
    if (!loop.empty()) points_.push_back(loop.front());
    Box whole = {both_lanes(1e300), both_lanes(-1e300)};
    for (std::size_t k = begins_.back(); k + 1 < points_.size();
         k += kEdgesPerBox) {
      const std::size_t end = std::min(k + kEdgesPerBox + 1, points_.size());
      Box box = {lanes_of(points_[k]), lanes_of(points_[k])};
      for (std::size_t j = k + 1; j < end; ++j) box.add(lanes_of(points_[j]));
      boxes_.push_back(box);
      whole.add(box.low);
      whole.add(box.high);
    }
    loop_boxes_.push_back(whole);
    begins_.push_back(points_.size());
    first_boxes_.push_back(boxes_.size());
  }
}

Set BoxedLoops::around(Vec2 place, std::uint32_t left_out) const {
  Set set = 0;
  for (std::uint32_t i = 0; i < count(); ++i) {
    if (i != left_out && *winding_number(i, place, 0) != 0) set |= bit(i);
  }
  return set;
}

bool BoxedLoops::holds_disc(Set loops, Vec2 place, double radius) const {
  for (std::uint32_t i = 0; i < count(); ++i) {
    const std::optional<int> winding = winding_number(i, place, radius);
    if (!winding || (*winding != 0) != ((loops & bit(i)) != 0)) return false;
  }
  return true;
}

std::optional<int> BoxedLoops::winding_number(std::uint32_t i, Vec2 place,
                                              double margin) const {
  const Vec2 aside(margin);
  const Box square = {lanes_of(place - aside), lanes_of(place + aside)};
  if (square.is_apart(loop_boxes_[i])) return 0;
  int winding = 0;
  const std::span<const Box> boxes = boxes_of(i);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const std::span<const Vec2> points = edges_of(i, k);
    if (square.is_apart(boxes[k])) {
      if (place.x > boxes[k].low[0]) continue;
      winding += static_cast<int>(points.front().y <= place.y) -
                 static_cast<int>(points.back().y <= place.y);
      continue;
    }
    for (std::size_t j = 0; j + 1 < points.size(); ++j) {
      const Vec2& from = points[j];
      const Vec2& to = points[j + 1];
      if (margin > 0 && distance_to_segment(place, from, to) < margin) {
        return std::nullopt;
      }
      winding += crossing(from, to, place);
    }
  }
  return winding;
}

bool BoxedLoops::meets(std::uint32_t i, const BoxedLoops& other,
                       std::uint32_t j) const {
  const Box& other_loop = other.loop_boxes_[j];
  if (loop_boxes_[i].is_apart(other_loop)) return false;
  const std::span<const Box> boxes = boxes_of(i);
  const std::span<const Box> other_boxes = other.boxes_of(j);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (boxes[k].is_apart(other_loop)) continue;
    for (std::size_t l = 0; l < other_boxes.size(); ++l) {
      if (boxes[k].is_apart(other_boxes[l])) continue;
      if (do_meet(edges_of(i, k), boxes[k], other.edges_of(j, l),
                  other_boxes[l])) {
        return true;
      }
    }
  }
  return false;
}

bool BoxedLoops::do_meet(std::span<const Vec2> a, const Box& box_a,
                         std::span<const Vec2> b, const Box& box_b) {
  const auto box_of = [](std::span<const Vec2> line, std::size_t k) {
    Box box = {lanes_of(line[k]), lanes_of(line[k])};
    box.add(lanes_of(line[k + 1]));
    return box;
  };
  for (std::size_t k = 0; k + 1 < a.size(); ++k) {
    const Box edge = box_of(a, k);
    if (edge.is_apart(box_b)) continue;
    for (std::size_t l = 0; l + 1 < b.size(); ++l) {
      const Box other = box_of(b, l);
      if (other.is_apart(box_a) || other.is_apart(edge)) continue;
      if (do_cross(a[k], a[k + 1], b[l], b[l + 1])) return true;
    }
  }
  return false;
}

Vec2 BoxedLoops::place_in(std::uint32_t i, Set holes, double share) const {
  const Box& box = loop_boxes_[i];
  const double x = box.low[0] + share * (box.high[0] - box.low[0]);
  std::vector<double> crossings;
  for (std::uint32_t j = 0; j < count(); ++j) {
    if (j != i && (holes & bit(j)) == 0) continue;
    const std::span<const Vec2> points = loop(j);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const Vec2& from = points[k];
      const Vec2& to = points[k + 1];
      if ((from.x <= x) == (to.x <= x)) continue;
      crossings.push_back(from.y +
                          (x - from.x) * (to.y - from.y) / (to.x - from.x));
    }
  }
  std::ranges::sort(crossings);
  Vec2 place(x, box.low[1]);
  double longest = 0;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const double length = crossings[k + 1] - crossings[k];
    if (length <= longest) continue;
    longest = length;
    place.y = (crossings[k] + crossings[k + 1]) / 2;
  }
  return place;
}

// --- The proof --------------------------------------------------------------

void LayerMatch::Side::fill() {
  if (!is_filled) loops.fill(*contours);
  is_filled = true;
}

void LayerMatch::set(const plane::Contours& layer) {
  above_.contours = &layer;
  above_.is_filled = false;
  above_.areas.clear();
  for (std::size_t i = 0; i < layer.loop_count(); ++i) {
    above_.areas.push_back(signed_area(layer.loop(i)));
  }
}

bool LayerMatch::take(const plane::Contours& layer, double reach) {
  std::swap(below_, above_);
  set(layer);
  if (skips_ > 0) {
    --skips_;
    return false;
  }
  const bool is_done = is_proven(reach);
  failures_ = is_done ? 0 : std::min(failures_ + 1, kMostSkips);
  skips_ = failures_;
  return is_done;
}

bool LayerMatch::is_proven(double reach) {
  const std::size_t count = above_.areas.size();
  if (count == 0 || count > BoxedLoops::kMostLoops ||
      count != below_.areas.size()) {
    return false;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(above_.areas[i] * below_.areas[i] > 0)) return false;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!walk(i, reach)) return false;
  }
  return are_regions_matched();
}

bool LayerMatch::walk(std::uint32_t i, double reach) {
  const std::span<const Vec2> above = above_.contours->loop(i);
  const std::span<const Vec2> below = below_.contours->loop(i);
  if (std::ranges::equal(above, below)) return true;
  // Begin with the first edge below that is within reach of the first vertex.
  const Vec2 place = above.front();
  const Vec2* before = &below.back();
  std::size_t next = 0;
  while (next < below.size() &&
         distance_to_segment(place, *before, below[next]) > reach) {
    before = &below[next++];
  }
  if (next == below.size()) return false;
  const Vec2 foot = *before + nearest_share(place, *before, below[next]) *
                                  (below[next] - *before);
  rotate(above, 1, place, walked_above_);
  rotate(below, next, foot, walked_below_);
  Rung rung = {foot, place};
  while (rung.next_above < walked_above_.size() ||
         rung.next_below < walked_below_.size()) {
    step(rung, walked_below_, walked_above_);
    if (squared_length(rung.above - rung.below) > reach * reach) return false;
  }
  return true;
}

bool LayerMatch::are_regions_matched() {
  below_.fill();
  above_.fill();
  const std::uint32_t count = above_.loops.count();
  outer_.resize(count);
  around_.resize(count);
  places_.resize(count, Vec2(0));
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = 0; j < count; ++j) {
      if (i != j && above_.loops.meets(i, below_.loops, j)) return false;
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!nests_alike(i)) return false;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!has_place_in_both(i)) return false;
  }
  return true;
}

// Finds the loops around loop i; false where they are others in the layer
// below, or of the counterpart.
bool LayerMatch::nests_alike(std::uint32_t i) {
  const Vec2 above = above_.contours->loop(i).front();
  const Vec2 below = below_.contours->loop(i).front();
  const Set outer = outer_[i] = above_.loops.around(above, i);
  const bool is_hole = std::popcount(outer) % 2 != 0;
  if (is_hole == (above_.areas[i] > 0) ||
      below_.loops.around(above, i) != outer ||
      above_.loops.around(below, i) != outer ||
      below_.loops.around(below, i) != outer) {
    return false;
  }
  // The innermost is the smallest.
  std::uint32_t& around = around_[i] = kOutside;
  for (std::uint32_t j = 0; j < above_.areas.size(); ++j) {
    if ((outer & bit(j)) == 0) continue;
    if (around == kOutside ||
        std::abs(above_.areas[j]) < std::abs(above_.areas[around])) {
      around = j;
    }
  }
  return true;
}

bool LayerMatch::is_in_both(std::uint32_t i, Vec2 place) const {
  const Set loops = outer_[i] | bit(i);
  return above_.loops.holds_disc(loops, place, kDisc) &&
         below_.loops.holds_disc(loops, place, kDisc);
}

// The place of the layer before will do as a rule.
bool LayerMatch::has_place_in_both(std::uint32_t i) {
  if (is_in_both(i, places_[i])) return true;
  Set holes = 0;
  for (std::uint32_t j = 0; j < around_.size(); ++j) {
    if (around_[j] == i) holes |= bit(j);
  }
  for (const double share : {0.5, 0.25, 0.75}) {
    places_[i] = above_.loops.place_in(i, holes, share);
    if (is_in_both(i, places_[i])) return true;
  }
  return false;
}

}  // namespace lamina::slicer
