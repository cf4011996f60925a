#include "slicer/thickness/ball_finder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <nanoflann.hpp>

namespace lamina::slicer {
namespace {

// A ball has stopped where it would shrink by less than this share of its
// radius: rounding may go so far.
constexpr double kSameRadius = 1e-9;

// How exactly climbing finds the centre of a ball, as a share of its reach.
constexpr double kClimbed = 0.01;

// What nanoflann asks of points.
struct Cloud {
  std::span<const SurfacePoint> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points[point].place[static_cast<int>(axis)];
  }
  template <typename Bounds>
  bool kdtree_get_bbox(Bounds& /*bounds*/) const {
    return false;
  }
};

// The nearest point within a distance. Of several the least index, so that the
// order in which the tree is walked does not matter.
class NearestOne {
 public:
  using DistanceType = double;

  explicit NearestOne(double within) : squared_(within * within) {}

  bool addPoint(double squared, std::uint32_t point) {
    if (squared < squared_ || (squared == squared_ && point < point_)) {
      squared_ = squared;
      point_ = point;
    }
    return true;
  }
  double worstDist() const { return squared_; }
  bool full() const { return true; }
  std::size_t size() const { return point_ == kNone ? 0 : 1; }

  std::optional<BallFinder::Nearest> result() const {
    if (point_ == kNone) return std::nullopt;
    return BallFinder::Nearest{point_, std::sqrt(squared_)};
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  double squared_;
  std::uint32_t point_ = kNone;
};

}  // namespace

struct BallFinder::Tree {
  using Index = nanoflann::KDTreeSingleIndexAdaptor<
      nanoflann::L2_Simple_Adaptor<double, Cloud, double, std::uint32_t>, Cloud,
      3, std::uint32_t>;

  explicit Tree(std::span<const SurfacePoint> points)
      : cloud{points}, index(3, cloud, {}) {}

  Cloud cloud;
  Index index;
};

BallFinder::BallFinder(std::span<const SurfacePoint> points)
    : points_(points), tree_(std::make_unique<Tree>(points)) {}

BallFinder::~BallFinder() = default;

std::optional<BallFinder::Nearest> BallFinder::nearest(Vec3 place,
                                                       double within,
                                                       double doubt) const {
  if (points_.empty()) return std::nullopt;
  NearestOne nearest(within);
  // nanoflann's share is of squares.
  const nanoflann::SearchParams search(0,
                                       static_cast<float>(doubt * (2 + doubt)));
  tree_->index.findNeighbors(nearest, &place.x, search);
  return nearest.result();
}

std::vector<std::uint32_t> BallFinder::points_within(Vec3 place,
                                                     double distance) const {
  std::vector<std::pair<std::uint32_t, double>> found;
  if (!points_.empty()) {
    tree_->index.radiusSearch(&place.x, distance * distance, found,
                              {0, 0, false});
  }
  std::vector<std::uint32_t> points;
  for (const auto& [point, squared] : found) points.push_back(point);
  return points;
}

Ball BallFinder::grow(Vec3 touch, Vec3 direction, double most) const {
  Ball ball = {touch + most * direction, most};
  while (const auto inside =
             nearest(ball.centre, ball.radius * (1 - kSameRadius))) {
    // The ball through both has its centre where both are equally near.
    const Vec3 chord = points_[inside->point].place - touch;
    const double along = glm::dot(chord, direction);
    if (!(along > 0)) break;  // by rounding: it lies beside the touched place
    const double radius = glm::dot(chord, chord) / (2 * along);
    if (!(radius < ball.radius)) break;
    ball.radius = radius;
    ball.centre = touch + radius * direction;
    ball.stop = inside->point;
  }
  return ball;
}

Ball BallFinder::climb(Vec3 place, double reach) const {
  Ball ball = {place};
  const auto try_centre = [&](Vec3 centre) {
    const auto touched = nearest(centre, std::numeric_limits<double>::max());
    if (!touched || touched->distance <= ball.radius) return false;
    ball.centre = centre;
    ball.radius = touched->distance;
    return true;
  };
  try_centre(place);
  reach = std::min(reach, ball.radius / 2);
  double step = reach / 2;
  while (step > kClimbed * reach) {
    const Vec3 here = ball.centre;
    bool has_grown = false;
    for (int i = 0; i < 27; ++i) {
      const Vec3 centre =
          here + step * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (glm::length(centre - place) > reach) continue;
      has_grown |= try_centre(centre);
    }
    if (!has_grown) step /= 2;
  }
  return ball;
}

}  // namespace lamina::slicer
