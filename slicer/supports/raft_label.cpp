#include "slicer/supports/raft_label.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "plane/predicates.h"
#include "plane/region/region.h"

namespace lamina::slicer {
namespace {

// Between letters and the raft's edge, and between them and feet [mm].
constexpr double kRim = 0.4;

// Places for a label are this far from each other [mm].
constexpr double kStep = 0.5;

// How far from the middle of a foot the raft's top reaches.
double raft_radius(const SupportSizes& sizes) {
  return sizes.foot / 2 + sizes.foot_height - kLabelDepth;
}

// How thick a foot is where letters begin.
double foot_radius(const SupportSizes& sizes) {
  const double share = (sizes.foot_height - kLabelDepth) / sizes.foot_height;
  return (sizes.foot + share * (sizes.pillar - sizes.foot)) / 2;
}

Vec2 turned(Vec2 p, bool is_upright) {
  return is_upright ? Vec2(-p.y, p.x) : p;
}

class Finder {
 public:
  Finder(std::vector<Vec2> feet, const SupportSizes& sizes, Vec2 extent)
      : feet_(std::move(feet)), sizes_(sizes), half_(extent / 2.0) {
    const plane::Region hull = plane::convex_hull(feet_);
    if (!hull.contours.empty()) hull_ = hull.contours.front();
    for (const Vec2 foot : feet_) {
      low_ = glm::min(low_, foot);
      high_ = glm::max(high_, foot);
    }
  }

  // The middle of a text of that size among the feet, lying or upright.
  std::optional<Vec2> find(bool is_upright) const {
    const Vec2 half = glm::abs(turned(half_, is_upright));
    for (double y = low_.y; y <= high_.y; y += kStep) {
      for (double x = low_.x; x <= high_.x; x += kStep) {
        if (is_free({x, y}, half)) return Vec2(x, y);
      }
    }
    return std::nullopt;
  }

  // The foot with the least y.
  Vec2 lowest() const { return *std::ranges::min_element(feet_, {}, &Vec2::y); }

 private:
  bool is_free(Vec2 middle, Vec2 half) const {
    for (const Vec2 sign :
         {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
      if (distance_to_hull(middle + sign * half) > raft_radius(sizes_) - kRim) {
        return false;
      }
    }
    const double apart = foot_radius(sizes_) + kRim;
    return std::ranges::none_of(feet_, [&](Vec2 foot) {
      const Vec2 outside = glm::max(glm::abs(foot - middle) - half, Vec2(0));
      return glm::length(outside) < apart;
    });
  }

  // 0 inside. The feet may be few, or in a row: then they have no hull.
  double distance_to_hull(Vec2 p) const {
    if (hull_.empty()) return distance_to_edges(p, feet_);
    bool is_inside = true;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const Vec2 a = hull_[i];
      const Vec2 edge = hull_[(i + 1) % hull_.size()] - a;
      if (edge.x * (p.y - a.y) - edge.y * (p.x - a.x) < 0) is_inside = false;
    }
    return is_inside ? 0 : distance_to_edges(p, hull_);
  }

  static double distance_to_edges(Vec2 p, const std::vector<Vec2>& points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      least = std::min(
          least,
          distance_to_segment(p, points[i], points[(i + 1) % points.size()]));
    }
    return least;
  }

  std::vector<Vec2> feet_;
  const SupportSizes& sizes_;
  Vec2 half_;
  std::vector<Vec2> hull_;
  Vec2 low_ = Vec2(std::numeric_limits<double>::infinity());
  Vec2 high_ = Vec2(-std::numeric_limits<double>::infinity());
};

}  // namespace

bool add_label(const std::string& text, const Box2& box, SupportPlan& plan) {
  std::vector<Vec2> feet;
  for (const Support& support : plan.supports) {
    if (support.end == SupportEnd::kFoot) {
      feet.emplace_back(support.path.back());
    }
  }
  if (feet.empty()) return false;
  const Vec2 extent = box.high - box.low;
  const Finder finder(std::move(feet), plan.sizes, extent);
  RaftLabel label;
  label.text = text;
  label.is_upright = false;
  std::optional<Vec2> middle = finder.find(false);
  if (!middle) {
    middle = finder.find(true);
    label.is_upright = middle.has_value();
  }
  if (!middle) {
    // In front of the foremost foot.
    const Vec2 foot = finder.lowest();
    const double depth = foot_radius(plan.sizes) + 2 * kRim + extent.y;
    const double width = std::max(extent.x + 2 * kRim, 2 * kRim);
    middle = foot - Vec2(0, depth - kRim - extent.y / 2);
    label.tab = {foot - Vec2(width / 2, depth), foot + Vec2(width / 2, 0)};
  }
  label.origin = *middle - turned((box.low + box.high) / 2.0, label.is_upright);
  plan.label = label;
  return true;
}

}  // namespace lamina::slicer
