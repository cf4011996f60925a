#include "ldni/detail/contour_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "ldni/leaf_section.h"

namespace lamina::ldni::detail {
namespace {

constexpr std::uint32_t kNoPiece = 0xffffffff;

// Points nearer than this [mm] are one, and a point nearer than this to the
// line through its neighbours is left out: what a column can move a point by.
constexpr double kMergeDistance = kColumnWidth;

// Loops with less area [mm²] are dropped: 31 nm squared, the leftovers of
// faces that coincide up to rounding.
constexpr double kLeastArea = 1e-9;

bool are_near(const Vec2& a, const Vec2& b) {
  return std::abs(a.x - b.x) < kMergeDistance &&
         std::abs(a.y - b.y) < kMergeDistance;
}

// Whether leaving out `point` changes nothing: it repeats a neighbour, lies on
// the line between them, or is the tip of a spike without width.
bool is_redundant(const Vec2& before, const Vec2& point, const Vec2& after) {
  if (are_near(before, point)) return true;
  const Vec2 in = point - before;
  const Vec2 out = after - point;
  const double cross = in.x * out.y - in.y * out.x;
  const double longer =
      std::max(in.x * in.x + in.y * in.y, out.x * out.x + out.y * out.y);
  const Vec2 base = after - before;
  const double base_squared = base.x * base.x + base.y * base.y;
  const bool is_spike = in.x * out.x + in.y * out.y < 0;
  // Distance from the line: from the base's, or from the longer side's for a
  // spike, whose base may be short.
  const double line_squared = is_spike ? longer : base_squared;
  return cross * cross <= kMergeDistance * kMergeDistance * line_squared;
}

}  // namespace

void ContourTracer::begin() {
  pieces_.clear();
  ends_.clear();
  pinches_.clear();
}

std::uint32_t ContourTracer::start_piece(Vec2 point, double key,
                                         const Vec2* first_vertex,
                                         std::int8_t direction) {
  const auto number = static_cast<std::uint32_t>(pieces_.size());
  Piece piece;
  piece.left = point;
  piece.vertices_begin = first_vertex;
  piece.direction = direction;
  pieces_.push_back(piece);
  ends_.push_back({key, point, number, direction < 0});
  return number;
}

void ContourTracer::end_piece(std::uint32_t number, Vec2 point, double key,
                              const Vec2* vertices_end) {
  Piece& piece = pieces_[number];
  piece.right = point;
  piece.vertices_end = std::max(vertices_end, piece.vertices_begin);
  ends_.push_back({key, point, number, piece.direction > 0});
}

void ContourTracer::link_stop() {
  if (ends_.empty()) return;
  // Few ends, nearly sorted: insertion. Equal keys keep left ends first.
  for (std::size_t i = 1; i < ends_.size(); ++i) {
    const End end = ends_[i];
    std::size_t k = i;
    for (; k > 0 && end.key < ends_[k - 1].key; --k) ends_[k] = ends_[k - 1];
    ends_[k] = end;
  }
  // Consecutive ends are opposite; where rounding disturbed the order an end
  // waits for the next opposite one.
  const End* last_upper = nullptr;
  std::uint32_t last_arriving = kNoPiece;
  for (const End& end : ends_) {
    if (waiting_.empty() || waiting_.back().arrives == end.arrives) {
      waiting_.push_back(end);
      continue;
    }
    const End lower = waiting_.back();
    waiting_.pop_back();
    link(lower, end);
    const std::uint32_t arriving = lower.arrives ? lower.piece : end.piece;
    if (last_upper != nullptr && are_near(last_upper->point, lower.point)) {
      pinches_.push_back({last_arriving, arriving});
    }
    last_upper = &end;
    last_arriving = arriving;
  }
  unlinked_ends_ += waiting_.size();
  waiting_.clear();
  ends_.clear();
}

void ContourTracer::link(const End& a, const End& b) {
  if (a.arrives) {
    pieces_[a.piece].next = b.piece;
  } else {
    pieces_[b.piece].next = a.piece;
  }
}

void ContourTracer::trace(Contours& contours) {
  contours.clear();
  number_loops();
  split_pinches();
  // A loop is walked from its first piece; walked pieces lose their number.
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].loop == kNoPiece) continue;
    walk(i);
    close_loop(contours);
  }
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
    Piece& first = pieces_[pinch.first];
    Piece& second = pieces_[pinch.second];
    if (first.loop != second.loop) continue;
    std::swap(first.next, second.next);
    number_loop(first.next, loop_count_++);
  }
}

void ContourTracer::walk(std::uint32_t start) {
  for (std::uint32_t i = start; i != kNoPiece;) {
    Piece& piece = pieces_[i];
    if (piece.loop == kNoPiece) break;
    piece.loop = kNoPiece;
    if (piece.direction > 0) {
      add_point(piece.left);
      for (const Vec2* p = piece.vertices_begin; p < piece.vertices_end; ++p) {
        add_point(*p);
      }
      add_point(piece.right);
    } else {
      add_point(piece.right);
      for (const Vec2* p = piece.vertices_end; p > piece.vertices_begin;) {
        add_point(*--p);
      }
      add_point(piece.left);
    }
    i = piece.next;
  }
}

void ContourTracer::add_point(const Vec2& point) {
  while (loop_.size() >= 2 &&
         is_redundant(loop_[loop_.size() - 2], loop_.back(), point)) {
    loop_.pop_back();
  }
  if (!loop_.empty() && are_near(loop_.back(), point)) return;
  loop_.push_back(point);
}

// Cleans the seam between the last and the first point, then keeps the loop if
// it has any area.
void ContourTracer::close_loop(Contours& contours) {
  std::size_t begin = 0;
  std::size_t end = loop_.size();
  for (bool is_clean = false; !is_clean && end - begin >= 3;) {
    is_clean = true;
    if (are_near(loop_[end - 1], loop_[begin]) ||
        is_redundant(loop_[end - 2], loop_[end - 1], loop_[begin])) {
      --end;
      is_clean = false;
    } else if (is_redundant(loop_[end - 1], loop_[begin], loop_[begin + 1])) {
      ++begin;
      is_clean = false;
    }
  }
  const std::span<const Vec2> kept(loop_.data() + begin, end - begin);
  if (kept.size() >= 3 && std::abs(signed_area(kept)) >= kLeastArea) {
    contours.points.insert(contours.points.end(), kept.begin(), kept.end());
    contours.ends.push_back(static_cast<std::uint32_t>(contours.points.size()));
  }
  loop_.clear();
}

}  // namespace lamina::ldni::detail
