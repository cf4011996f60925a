#include "plane/sweep/loop_pen.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "plane/loop_area.h"
#include "plane/predicates.h"

namespace lamina::plane {
void LoopPen::begin(Contours& contours) {
  contours_ = &contours;
  loop_begin_ = loop_end_ = contours.points.size();
  last_step_ = Vec2(0);
}

void LoopPen::lift() { contours_->points.resize(loop_end_); }

void LoopPen::draw(const Vec2& head, const Vec2* from, std::ptrdiff_t count,
                   std::ptrdiff_t stride, const Vec2& tail) {
  std::vector<Vec2>& points = contours_->points;
  const std::size_t needed = loop_end_ + static_cast<std::size_t>(count) + 2;
  if (points.size() < needed) points.resize(needed);
  Vec2* end = add(points.data() + loop_end_, head);
  if (count > 0) end = add_run(end, from, count, stride);
  end = add(end, tail);
  loop_end_ = static_cast<std::size_t>(end - points.data());
}

// Both return the loop's new end. Successive points are never near each other.

Vec2* LoopPen::add(Vec2* end, const Vec2& point) {
  const Vec2* begin = contours_->points.data() + loop_begin_;
  Vec2 step(0);
  while (end != begin) {
    step = point - end[-1];
    if (end - begin == 1 || !is_straight(last_step_, step)) {
      if (are_near(point, end[-1])) return end;
      break;
    }
    --end;
    if (end - begin > 1) last_step_ = end[-1] - end[-2];
  }
  *end++ = point;
  last_step_ = step;
  return end;
}

// Adds points to a loop that has begun.
Vec2* LoopPen::add_run(Vec2* end, const Vec2* from, std::ptrdiff_t count,
                       std::ptrdiff_t stride) {
  Vec2 in = last_step_;
  double in_squared = dot(in, in);
  for (; count > 0; --count, from += stride) {
    const Vec2 out = *from - end[-1];
    const double out_squared = dot(out, out);
    const double turn = cross(in, out);
    // Beyond what is_straight() and are_near() ask for, at any angle.
    if (turn * turn > 2 * merge_squared_ * (in_squared + out_squared)) {
      *end++ = *from;
      in = out;
      in_squared = out_squared;
      continue;
    }
    last_step_ = in;
    end = add(end, *from);
    in = last_step_;
    in_squared = dot(in, in);
  }
  last_step_ = in;
  return end;
}

// Whether a point, come to by one step and left by another, lies on the line
// between its neighbours or is the tip of a spike without width.
bool LoopPen::is_straight(const Vec2& in, const Vec2& out) const {
  const double turn = cross(in, out);
  const double ahead = dot(in, out);
  const double in_squared = dot(in, in);
  const double out_squared = dot(out, out);
  // Distance from the line: from the base's, or from the longer side's for a
  // spike, whose base may be short.
  const double line_squared = ahead < 0 ? std::max(in_squared, out_squared)
                                        : in_squared + out_squared + 2 * ahead;
  return turn * turn <= merge_squared_ * line_squared;
}

bool LoopPen::are_near(const Vec2& a, const Vec2& b) const {
  return std::abs(a.x - b.x) < merge_distance_ &&
         std::abs(a.y - b.y) < merge_distance_;
}

// Whether leaving out `point` changes nothing: it repeats a neighbour, or what
// is_straight() says.
bool LoopPen::is_redundant(const Vec2& before, const Vec2& point,
                           const Vec2& after) const {
  return are_near(before, point) || is_straight(point - before, after - point);
}

// Cleans the seam between the last and the first point, then keeps the loop if
// it has area enough.
void LoopPen::close_loop() {
  Vec2* const first = contours_->points.data() + loop_begin_;
  Vec2* begin = first;
  Vec2* end = contours_->points.data() + loop_end_;
  for (bool is_clean = false; !is_clean && end - begin >= 3;) {
    is_clean = true;
    if (are_near(end[-1], begin[0]) ||
        is_redundant(end[-2], end[-1], begin[0])) {
      --end;
      is_clean = false;
    } else if (is_redundant(end[-1], begin[0], begin[1])) {
      ++begin;
      is_clean = false;
    }
  }
  const std::span<const Vec2> kept(begin, end);
  if (kept.size() >= 3 && std::abs(signed_area(kept)) >= least_area_) {
    if (begin != first) std::copy(begin, end, first);
    loop_begin_ += kept.size();
    contours_->ends.push_back(static_cast<std::uint32_t>(loop_begin_));
  }
  loop_end_ = loop_begin_;
  last_step_ = Vec2(0);
}

}  // namespace lamina::plane
