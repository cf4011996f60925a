#include "plane/sweep/stitcher.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "plane/chains.h"

namespace lamina::plane {
namespace {

// Ends in one point may be on both sides of the event cluster.
constexpr double kPinchDistance = 2 * kClusterWidth;

// As many ends of one event point are compared with each other; more are
// sorted. Where a thousand walls stand in the ray, all have ends there.
constexpr std::size_t kFewEnds = 64;

bool are_near(const Vec2& a, const Vec2& b, double distance) {
  return std::abs(a.x - b.x) < distance && std::abs(a.y - b.y) < distance;
}

double y_on_segment(const Vec2* segment, double x) {
  const Vec2& from = segment[0];
  const Vec2& to = segment[1];
  return from.y + (x - from.x) * ((to.y - from.y) / (to.x - from.x));
}

}  // namespace

void Stitcher::begin() {
  arcs_.clear();
  ends_.clear();
  keys_.clear();
  visits_.clear();
  place_count_ = 0;
  has_jumps_ = false;
}

std::uint32_t Stitcher::start_arc(Vec2 point, double key, const Vec2* segment,
                                  std::int8_t side) {
  const auto number = static_cast<std::uint32_t>(arcs_.size());
  BoundaryArc arc;
  arc.left = point;
  arc.vertices_begin = segment + 1;
  arc.side = side;
  arcs_.push_back(arc);
  ends_.push_back({key, point, segment, number, side < 0, false});
  return number;
}

void Stitcher::end_arc(std::uint32_t number, Vec2 point, double key,
                       const Vec2* segment) {
  BoundaryArc& arc = arcs_[number];
  arc.right = point;
  arc.vertices_end = std::max(segment + 1, arc.vertices_begin);
  ends_.push_back({key, point, segment, number, arc.side > 0, true});
}

void Stitcher::add_loop(std::span<const Vec2> lower,
                        std::span<const Vec2> upper, std::int8_t side) {
  const auto number = static_cast<std::uint32_t>(arcs_.size());
  const auto add = [this](std::span<const Vec2> chain, std::uint32_t other,
                          std::int8_t chain_side) {
    BoundaryArc arc;
    arc.left = chain.front();
    arc.right = chain.back();
    arc.vertices_begin = chain.data() + 1;
    arc.vertices_end = chain.data() + chain.size() - 1;
    arc.next = arc.previous = other;
    arc.side = chain_side;
    arcs_.push_back(arc);
  };
  add(lower, number + 1, side);
  add(upper, number, static_cast<std::int8_t>(-side));
}

bool Stitcher::has_end_near(double y) {
  const auto is_near = [y](double key) {
    return std::abs(key - y) < kPinchDistance;
  };
  if (ends_.size() <= kFewEnds) {
    return std::ranges::any_of(ends_, is_near, &ArcEnd::key);
  }
  for (std::size_t i = keys_.size(); i < ends_.size(); ++i) {
    keys_.insert(ends_[i].key);
  }
  const auto above = keys_.lower_bound(y);
  return (above != keys_.end() && is_near(*above)) ||
         (above != keys_.begin() && is_near(*std::prev(above)));
}

// The order of y; among ends of one side that could tie, the order in which
// their chains come from, or go to, the next vertex.
bool Stitcher::is_lower(const ArcEnd& a, const ArcEnd& b) const {
  const double distance = b.key - a.key;
  if (a.is_left != b.is_left || std::abs(distance) > 2 * tie_distance_) {
    return distance > 0;
  }
  const double x = a.is_left ? std::max(a.segment[0].x, b.segment[0].x)
                             : std::min(a.segment[1].x, b.segment[1].x);
  return distance + y_on_segment(b.segment, x) - y_on_segment(a.segment, x) > 0;
}

// Few ends, nearly sorted: insertion. Equal ends keep their order.
void Stitcher::sort_ends() {
  if (ends_.size() > kFewEnds) {
    std::ranges::stable_sort(ends_, {}, &ArcEnd::key);
  }
  for (std::size_t i = 1; i < ends_.size(); ++i) {
    const ArcEnd end = ends_[i];
    std::size_t k = i;
    for (; k > 0 && is_lower(end, ends_[k - 1]); --k) ends_[k] = ends_[k - 1];
    ends_[k] = end;
  }
}

void Stitcher::link_ends() {
  if (ends_.empty()) return;
  sort_ends();
  // Going up, heads and tails alternate. Of ends in one point, take first the
  // one that the lowest waiting end can link to.
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    for (std::size_t k = i; k < ends_.size() && !waiting_.empty(); ++k) {
      if (ends_[k].key - ends_[i].key >= kPinchDistance) break;
      if (ends_[k].is_head == waiting_.back().is_head) continue;
      std::rotate(ends_.begin() + static_cast<std::ptrdiff_t>(i),
                  ends_.begin() + static_cast<std::ptrdiff_t>(k),
                  ends_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      break;
    }
    take_end(ends_[i]);
  }
  assert(waiting_.empty());  // I4
  unlinked_ends_ += waiting_.size();
  if (has_pinches_) list_visits();
  waiting_.clear();
  has_linked_ = has_pinches_ = false;
  ends_.clear();
  keys_.clear();
}

// Links an end to the one that waits, or lets it wait for the next opposite
// one where rounding disturbed the order.
void Stitcher::take_end(const ArcEnd& end) {
  if (waiting_.empty() || waiting_.back().is_head == end.is_head) {
    waiting_.push_back(end);
    return;
  }
  const ArcEnd lower = waiting_.back();
  waiting_.pop_back();
  link(lower, end);
  const bool is_pinch =
      has_linked_ && are_near(linked_upper_.point, lower.point, kPinchDistance);
  has_pinches_ |= is_pinch;
  if (is_pinch && arcs_[linked_upper_.arc].side > 0) {
    exchange_partners(arc_before(linked_upper_), arc_before(lower));
    if (!are_near(linked_lower_.point, lower.point, kPinchDistance) &&
        !are_near(end.point, lower.point, kPinchDistance)) {
      add_point(lower.point, arc_before(end));
    }
  } else {
    linked_lower_ = lower;
  }
  linked_upper_ = end;
  has_linked_ = true;
}

// A point of an upright edge: an arc without a length, after `arc`.
void Stitcher::add_point(const Vec2& point, std::uint32_t arc) {
  const auto number = static_cast<std::uint32_t>(arcs_.size());
  const std::uint32_t next = arcs_[arc].next;
  arcs_[arc].next = arcs_[next].previous = number;
  arcs_.push_back(
      {.left = point, .right = point, .next = next, .previous = arc});
  added_points_.push_back(number);
}

void Stitcher::link(const ArcEnd& a, const ArcEnd& b) {
  const ArcEnd& head = a.is_head ? a : b;
  const ArcEnd& tail = a.is_head ? b : a;
  arcs_[head.arc].next = tail.arc;
  arcs_[tail.arc].previous = head.arc;
  const double jump = std::abs(a.point.y - b.point.y);
  has_jumps_ |= jump > kClusterWidth && jump <= kMostJump * tie_distance_;
}

// The places in which ends of several links lie.
void Stitcher::list_visits() {
  const auto y_of = [this](std::uint32_t arc) { return arcs_[arc].left.y; };
  std::ranges::stable_sort(added_points_, {}, y_of);
  for (std::size_t i = 0, end = 0; i < ends_.size(); i = end) {
    bool is_pinch = false;
    for (end = i + 1;
         end < ends_.size() &&
         are_near(ends_[end].point, ends_[end - 1].point, kPinchDistance);
         ++end) {
      is_pinch |= arc_before(ends_[end]) != arc_before(ends_[i]);
    }
    const Vec2& point = ends_[i].point;
    const std::size_t visits_before = visits_.size();
    for (auto arc = std::ranges::lower_bound(
             added_points_, point.y - kPinchDistance, {}, y_of);
         arc != added_points_.end() && y_of(*arc) < point.y + kPinchDistance;
         ++arc) {
      if (!are_near(arcs_[*arc].left, point, kPinchDistance)) continue;
      visits_.push_back({*arc, false, place_count_});
      is_pinch = true;
    }
    std::ranges::sort(
        visits_.begin() + static_cast<std::ptrdiff_t>(visits_before),
        visits_.end(), {}, &Visit::arc);
    if (!is_pinch) continue;
    for (std::size_t k = i; k < end; ++k) {
      visits_.push_back({ends_[k].arc, ends_[k].is_head, place_count_});
    }
    ++place_count_;
  }
  added_points_.clear();
}

// Exchanges the ends of two links, each from an arc to the next one.
void Stitcher::exchange_partners(std::uint32_t a, std::uint32_t b) {
  std::swap(arcs_[a].next, arcs_[b].next);
  arcs_[arcs_[a].next].previous = a;
  arcs_[arcs_[b].next].previous = b;
}

std::uint32_t Stitcher::arc_before(const ArcEnd& end) const {
  return end.is_head ? end.arc : arcs_[end.arc].previous;
}

void Stitcher::write_loops(Contours& contours) {
  contours.clear();
  if (!visits_.empty()) split_loops();
  pen_.begin(contours);
  for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
    if (arcs_[i].is_walked) continue;
    walk(i);
    pen_.close_loop();
  }
  pen_.lift();
}

// Walks the loops that touch others or themselves. Where the way comes to a
// place again, what lies between becomes a loop of its own.
void Stitcher::split_loops() {
  // The places of each arc's tail and head.
  std::vector<std::array<std::uint32_t, 2>> places(arcs_.size(),
                                                   {kNoPlace, kNoPlace});
  for (const Visit& visit : visits_) {
    places[visit.arc][visit.is_head ? 1 : 0] = visit.place;
  }
  std::vector<std::uint32_t> arc_before_place(place_count_, kNoArc);
  std::vector<std::uint32_t> way;
  std::vector<bool> is_done(arcs_.size());
  for (const Visit& start : visits_) {
    std::uint32_t arc = start.arc;
    while (arc != kNoArc && !is_done[arc]) {
      is_done[arc] = true;
      const std::uint32_t next = arcs_[arc].next;
      std::uint32_t before = arc;
      const auto come_to = [&](std::uint32_t place) {
        if (arc_before_place[place] == kNoArc) {
          arc_before_place[place] = before;
          way.push_back(place);
          return;
        }
        exchange_partners(arc_before_place[place], before);
        before = arc_before_place[place];
        for (; way.back() != place; way.pop_back()) {
          arc_before_place[way.back()] = kNoArc;
        }
      };
      const std::uint32_t head = places[arc][1];
      const std::uint32_t tail = next == kNoArc ? kNoPlace : places[next][0];
      if (head != kNoPlace) come_to(head);
      if (tail != kNoPlace && tail != head) come_to(tail);
      arc = next;
    }
    for (const std::uint32_t place : way) arc_before_place[place] = kNoArc;
    way.clear();
  }
}

void Stitcher::walk(std::uint32_t start) {
  for (std::uint32_t i = start; i != kNoArc;) {
    BoundaryArc& arc = arcs_[i];
    if (arc.is_walked) break;
    arc.is_walked = true;
    if (arc.side > 0) {
      pen_.draw_forward(arc.left, arc.vertices_begin, arc.vertices_end,
                        arc.right);
    } else {
      pen_.draw_backward(arc.right, arc.vertices_begin, arc.vertices_end,
                         arc.left);
    }
    i = arc.next;
  }
}

}  // namespace lamina::plane
