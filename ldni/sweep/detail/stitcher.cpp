#include "ldni/sweep/detail/stitcher.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "ldni/section/chains.h"

namespace lamina::ldni::detail {
namespace {

// Ends in one point may be on both sides of the event cluster.
constexpr double kPinchDistance = 2 * kClusterWidth;

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
  pinches_.clear();
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

bool Stitcher::has_end_near(double y) const {
  return std::any_of(ends_.begin(), ends_.end(), [y](const ArcEnd& end) {
    return std::abs(end.key - y) < kPinchDistance;
  });
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
  waiting_.clear();
  linked_.clear();
  ends_.clear();
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
  for (std::size_t i = linked_.size(); i-- > 0;) {
    if (!are_near(linked_[i].point, lower.point, kPinchDistance)) break;
    pinches_.push_back({linked_[i], lower});
  }
  linked_.push_back(end);
}

void Stitcher::link(const ArcEnd& a, const ArcEnd& b) {
  const ArcEnd& head = a.is_head ? a : b;
  const ArcEnd& tail = a.is_head ? b : a;
  arcs_[head.arc].next = tail.arc;
  arcs_[tail.arc].previous = head.arc;
  const double jump = std::abs(a.point.y - b.point.y);
  has_jumps_ |= jump > kClusterWidth && jump <= kMostJump * tie_distance_;
}

std::uint32_t Stitcher::arc_before(const ArcEnd& end) const {
  return end.is_head ? end.arc : arcs_[end.arc].previous;
}

void Stitcher::write_loops(Contours& contours) {
  contours.clear();
  number_loops();
  split_pinches();
  // A loop is walked from its first arc; walked arcs lose their number.
  pen_.begin(contours);
  for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
    if (arcs_[i].loop == kNoArc) continue;
    walk(i);
    pen_.close_loop();
  }
  pen_.lift();
}

void Stitcher::number_loops() {
  loop_count_ = 0;
  for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
    if (arcs_[i].loop == kNoArc) number_loop(i, loop_count_++);
  }
}

void Stitcher::number_loop(std::uint32_t arc, std::uint32_t loop) {
  while (arc != kNoArc && arcs_[arc].loop != loop) {
    arcs_[arc].loop = loop;
    arc = arcs_[arc].next;
  }
}

void Stitcher::split_pinches() {
  for (const Pinch& pinch : pinches_) {
    const std::uint32_t a = arc_before(pinch.first);
    const std::uint32_t b = arc_before(pinch.second);
    if (a == b || arcs_[a].loop != arcs_[b].loop) continue;
    std::swap(arcs_[a].next, arcs_[b].next);
    arcs_[arcs_[a].next].previous = a;
    arcs_[arcs_[b].next].previous = b;
    number_loop(arcs_[a].next, loop_count_++);
  }
}

void Stitcher::walk(std::uint32_t start) {
  for (std::uint32_t i = start; i != kNoArc;) {
    BoundaryArc& arc = arcs_[i];
    if (arc.loop == kNoArc) break;
    arc.loop = kNoArc;
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

}  // namespace lamina::ldni::detail
