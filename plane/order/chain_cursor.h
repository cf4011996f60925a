#pragma once
// A place on a chain as the ray passes over it.

#include "base/vec.h"

namespace lamina::plane {

// A segment of a chain, and the way on along the chain.
class ChainCursor {
 public:
  ChainCursor() = default;
  // On the segment from `left`; `last` is the chain's last point.
  ChainCursor(const Vec2* left, const Vec2* last) : left_(left), last_(last) {
    set_slope();
  }

  const Vec2* left() const { return left_; }
  const Vec2* last() const { return last_; }
  double left_x() const { return left_->x; }
  double right_x() const { return left_[1].x; }
  double slope() const { return slope_; }
  bool is_last_segment() const { return left_ + 1 == last_; }

  void step() {
    ++left_;
    set_slope();
  }
  // Moves on until the segment holds x or what lies right of it; stays on the
  // last segment.
  void advance(double x) {
    if (left_[1].x > x || is_last_segment()) return;
    do {
      ++left_;
    } while (left_[1].x <= x && !is_last_segment());
    set_slope();
  }

  // y of the segment's line at x; vertices give their own y exactly.
  double y_at(double x) const {
    if (x == left_[1].x) return left_[1].y;
    return left_->y + (x - left_->x) * slope_;
  }

 private:
  void set_slope() {
    slope_ = (left_[1].y - left_->y) / (left_[1].x - left_->x);
  }

  const Vec2* left_ = nullptr;
  const Vec2* last_ = nullptr;
  double slope_ = 0;
};

}  // namespace lamina::plane
