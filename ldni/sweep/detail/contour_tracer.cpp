#include "ldni/sweep/detail/contour_tracer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "ldni/section/leaf_section.h"

namespace lamina::ldni::detail {
namespace {

// Ends of a stop in one point may be on both sides of its column.
constexpr double kPinchDistance = 2 * kColumnWidth;

bool are_near(const Vec2& a, const Vec2& b, double distance) {
  return std::abs(a.x - b.x) < distance && std::abs(a.y - b.y) < distance;
}

double y_on_segment(const Vec2* segment, double x) {
  const Vec2& from = segment[0];
  const Vec2& to = segment[1];
  return from.y + (x - from.x) * ((to.y - from.y) / (to.x - from.x));
}

}  // namespace

void ContourTracer::begin() {
  pieces_.clear();
  ends_.clear();
  pinches_.clear();
  has_jumps_ = false;
}

std::uint32_t ContourTracer::start_piece(Vec2 point, double key,
                                         const Vec2* segment,
                                         std::int8_t direction) {
  const auto number = static_cast<std::uint32_t>(pieces_.size());
  Piece piece;
  piece.left = point;
  piece.vertices_begin = segment + 1;
  piece.direction = direction;
  pieces_.push_back(piece);
  ends_.push_back({key, point, segment, number, direction < 0, false});
  return number;
}

void ContourTracer::end_piece(std::uint32_t number, Vec2 point, double key,
                              const Vec2* segment) {
  Piece& piece = pieces_[number];
  piece.right = point;
  piece.vertices_end = std::max(segment + 1, piece.vertices_begin);
  ends_.push_back({key, point, segment, number, piece.direction > 0, true});
}

void ContourTracer::add_loop(std::span<const Vec2> lower,
                             std::span<const Vec2> upper,
                             std::int8_t direction) {
  const auto number = static_cast<std::uint32_t>(pieces_.size());
  const auto add = [this](std::span<const Vec2> chain, std::uint32_t other,
                          std::int8_t chain_direction) {
    Piece piece;
    piece.left = chain.front();
    piece.right = chain.back();
    piece.vertices_begin = chain.data() + 1;
    piece.vertices_end = chain.data() + chain.size() - 1;
    piece.next = piece.previous = other;
    piece.direction = chain_direction;
    pieces_.push_back(piece);
  };
  add(lower, number + 1, direction);
  add(upper, number, static_cast<std::int8_t>(-direction));
}

bool ContourTracer::has_end_near(double y) const {
  return std::any_of(ends_.begin(), ends_.end(), [y](const End& end) {
    return std::abs(end.key - y) < kPinchDistance;
  });
}

// The order of y; among ends of one side that could tie, the order in which
// their chains come from, or go to, the next vertex.
bool ContourTracer::is_lower(const End& a, const End& b) const {
  const double distance = b.key - a.key;
  if (a.is_left != b.is_left || std::abs(distance) > 2 * tie_distance_) {
    return distance > 0;
  }
  const double x = a.is_left ? std::max(a.segment[0].x, b.segment[0].x)
                             : std::min(a.segment[1].x, b.segment[1].x);
  return distance + y_on_segment(b.segment, x) - y_on_segment(a.segment, x) > 0;
}

// Few ends, nearly sorted: insertion. Equal ends keep their order.
void ContourTracer::sort_ends() {
  for (std::size_t i = 1; i < ends_.size(); ++i) {
    const End end = ends_[i];
    std::size_t k = i;
    for (; k > 0 && is_lower(end, ends_[k - 1]); --k) ends_[k] = ends_[k - 1];
    ends_[k] = end;
  }
}

void ContourTracer::link_stop() {
  if (ends_.empty()) return;
  sort_ends();
  // Going up, ends arrive and depart in turn. Of ends in one point, take
  // first the one that the lowest waiting end can link to.
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    for (std::size_t k = i; k < ends_.size() && !waiting_.empty(); ++k) {
      if (ends_[k].key - ends_[i].key >= kPinchDistance) break;
      if (ends_[k].arrives == waiting_.back().arrives) continue;
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
void ContourTracer::take_end(const End& end) {
  if (waiting_.empty() || waiting_.back().arrives == end.arrives) {
    waiting_.push_back(end);
    return;
  }
  const End lower = waiting_.back();
  waiting_.pop_back();
  link(lower, end);
  for (std::size_t i = linked_.size(); i-- > 0;) {
    if (!are_near(linked_[i].point, lower.point, kPinchDistance)) break;
    pinches_.push_back({linked_[i], lower});
  }
  linked_.push_back(end);
}

void ContourTracer::link(const End& a, const End& b) {
  const End& arriving = a.arrives ? a : b;
  const End& departing = a.arrives ? b : a;
  pieces_[arriving.piece].next = departing.piece;
  pieces_[departing.piece].previous = arriving.piece;
  const double jump = std::abs(a.point.y - b.point.y);
  has_jumps_ |= jump > kColumnWidth && jump <= kMostJump * tie_distance_;
}

std::uint32_t ContourTracer::arriving_piece(const End& end) const {
  return end.arrives ? end.piece : pieces_[end.piece].previous;
}

void ContourTracer::trace(Contours& contours) {
  contours.clear();
  number_loops();
  split_pinches();
  // A loop is walked from its first piece; walked pieces lose their number.
  pen_.begin(contours);
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].loop == kNoPiece) continue;
    walk(i);
    pen_.close_loop();
  }
  pen_.lift();
}

void ContourTracer::number_loops() {
  loop_count_ = 0;
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].loop == kNoPiece) number_loop(i, loop_count_++);
  }
}

void ContourTracer::number_loop(std::uint32_t piece, std::uint32_t loop) {
  while (piece != kNoPiece && pieces_[piece].loop != loop) {
    pieces_[piece].loop = loop;
    piece = pieces_[piece].next;
  }
}

void ContourTracer::split_pinches() {
  for (const Pinch& pinch : pinches_) {
    const std::uint32_t a = arriving_piece(pinch.first);
    const std::uint32_t b = arriving_piece(pinch.second);
    if (a == b || pieces_[a].loop != pieces_[b].loop) continue;
    std::swap(pieces_[a].next, pieces_[b].next);
    pieces_[pieces_[a].next].previous = a;
    pieces_[pieces_[b].next].previous = b;
    number_loop(pieces_[a].next, loop_count_++);
  }
}

void ContourTracer::walk(std::uint32_t start) {
  for (std::uint32_t i = start; i != kNoPiece;) {
    Piece& piece = pieces_[i];
    if (piece.loop == kNoPiece) break;
    piece.loop = kNoPiece;
    if (piece.direction > 0) {
      pen_.draw_forward(piece.left, piece.vertices_begin, piece.vertices_end,
                        piece.right);
    } else {
      pen_.draw_backward(piece.right, piece.vertices_begin, piece.vertices_end,
                         piece.left);
    }
    i = piece.next;
  }
}

}  // namespace lamina::ldni::detail
