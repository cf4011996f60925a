#include "plane/order/certificate.h"

#include <algorithm>
#include <cmath>

#include "plane/chains.h"

namespace lamina::plane {
namespace {

// Two chains between successive vertices of either.
class PairCursor {
 public:
  PairCursor(const ChainCursor& lower, const ChainCursor& upper,
             double tie_distance)
      : lower_(lower), upper_(upper), tie_distance_(tie_distance) {
    left_ = std::max(lower.left_x(), upper.left_x());
    left_distance_ = distance_at(left_);
    find_right();
  }

  double left() const { return left_; }
  double right() const { return right_; }

  // False where one of the chains ends.
  bool step() {
    const bool ends_lower = lower_.right_x() == right_;
    const bool ends_upper = upper_.right_x() == right_;
    if (ends_lower && lower_.is_last_segment()) return false;
    if (ends_upper && upper_.is_last_segment()) return false;
    if (ends_lower) lower_.step();
    if (ends_upper) upper_.step();
    left_ = right_;
    left_distance_ = right_distance_;
    find_right();
    return true;
  }

  // By more than the tie distance, up to right().
  bool is_apart() const {
    return std::min(left_distance_, right_distance_) > tie_distance_;
  }
  bool crosses() const {
    return std::min(left_distance_, right_distance_) < -tie_distance_ &&
           std::max(left_distance_, right_distance_) > tie_distance_;
  }
  bool touches_at_left() const { return left_distance_ < kClusterWidth; }
  double crossing() const {
    const double t = left_distance_ / (left_distance_ - right_distance_);
    return std::clamp(left_ + t * (right_ - left_), left_, right_);
  }
  int relation_at_left() const {
    if (std::abs(left_distance_) <= tie_distance_ &&
        std::abs(right_distance_) <= tie_distance_) {
      return 0;
    }
    if (crosses()) return left_distance_ > 0 ? 1 : -1;
    return left_distance_ + right_distance_ >= 0 ? 1 : -1;
  }

 private:
  double distance_at(double x) const { return upper_.y_at(x) - lower_.y_at(x); }
  void find_right() {
    right_ = std::min(lower_.right_x(), upper_.right_x());
    right_distance_ = distance_at(right_);
  }

  ChainCursor lower_;
  ChainCursor upper_;
  double tie_distance_ = 0;
  double left_ = 0;
  double right_ = 0;
  double left_distance_ = 0;
  double right_distance_ = 0;
};

}  // namespace

Certificate certify(const ChainCursor& lower, const ChainCursor& upper,
                    double x, double limit, double tie_distance) {
  PairCursor pair(lower, upper, tie_distance);
  Certificate certificate;
  certificate.relation = pair.relation_at_left();
  if (pair.crosses()) {
    const double crossing = pair.crossing();
    if (x < crossing) {
      certificate.failure = crossing;
      return certificate;
    }
    certificate.relation = -certificate.relation;  // the crossing is passed
  }
  if (certificate.relation < 0) return certificate;
  for (;;) {
    if (pair.right() > limit) {
      certificate.valid_until = pair.right();
      return certificate;
    }
    if (!pair.step()) return certificate;
    if (certificate.relation > 0 && pair.is_apart()) continue;
    if (pair.relation_at_left() != certificate.relation ||
        (certificate.relation > 0 && pair.touches_at_left())) {
      certificate.failure = pair.left();
      return certificate;
    }
    if (pair.crosses()) {
      certificate.failure = pair.crossing();
      return certificate;
    }
  }
}

}  // namespace lamina::plane
