#include "ldni/image/loop_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"

namespace lamina::ldni {
namespace {

using ldni::LayerIntervals;
using ldni::RayGrid;
using plane::Contours;

// A depth image: for every ray its ends of intervals, ascending.
using Image = std::vector<std::vector<double>>;

LayerIntervals intervals_of(const Image& image) {
  LayerIntervals layer;
  for (const std::vector<double>& depths : image) {
    for (std::size_t i = 0; i + 1 < depths.size(); i += 2) {
      ldni::Interval interval;
      interval.enter.depth = depths[i];
      interval.exit.depth = depths[i + 1];
      interval.exit.normal = glm::vec3(0, 1, 0);
      layer.intervals.push_back(interval);
    }
    layer.ends.push_back(static_cast<std::uint32_t>(layer.intervals.size()));
  }
  return layer;
}

// Rays at x = 0, 1, 2 … to rounding.
RayGrid unit_rays(std::size_t count) {
  const double first = RayGrid(0, 1, 1).ray_x(0);
  return {-first, static_cast<double>(count) - 0.5, 1};
}

plane::Contours build(const Image& image) {
  plane::Contours contours;
  LoopBuilder().build(unit_rays(image.size()), intervals_of(image), contours);
  return contours;
}

// The loop with its x rounded to whole rays, turned so that its least point (by
// x, then y) comes first.
std::vector<Vec2> canonical(std::span<const Vec2> loop) {
  std::vector<Vec2> points(loop.begin(), loop.end());
  for (Vec2& point : points) point.x = std::round(point.x);
  const auto least = std::min_element(
      points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
        return a.x != b.x ? a.x < b.x : a.y < b.y;
      });
  std::rotate(points.begin(), least, points.end());
  return points;
}

using Points = std::vector<Vec2>;

TEST(LoopBuilder, MakesNothingOfAnEmptyImage) {
  EXPECT_TRUE(build({}).is_empty());
  EXPECT_TRUE(build({{}, {}, {}}).is_empty());
}

TEST(LoopBuilder, LinksTheRaysOfARectangle) {
  const plane::Contours contours = build({{}, {1, 4}, {1, 4}, {1, 4}, {}});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(canonical(contours.loop(0)),
            (Points{{1, 1}, {3, 1}, {3, 4}, {1, 4}}));
}

TEST(LoopBuilder, CutsTheCornersOfADiamondAtItsFirstAndLastRay) {
  const plane::Contours contours =
      build({{3, 5}, {2, 6}, {1, 7}, {2, 6}, {3, 5}});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(canonical(contours.loop(0)),
            (Points{{0, 3}, {2, 1}, {4, 3}, {4, 5}, {2, 7}, {0, 5}}));
}

TEST(LoopBuilder, RunsHolesClockwise) {
  const plane::Contours contours =
      build({{0, 9}, {0, 3, 6, 9}, {0, 2, 7, 9}, {0, 3, 6, 9}, {0, 9}});
  ASSERT_EQ(contours.loop_count(), 2U);
  EXPECT_EQ(canonical(contours.loop(0)),
            (Points{{0, 0}, {4, 0}, {4, 9}, {0, 9}}));
  EXPECT_EQ(canonical(contours.loop(1)),
            (Points{{1, 3}, {1, 6}, {2, 7}, {3, 6}, {3, 3}, {2, 2}}));
}

TEST(LoopBuilder, JoinsTheTwoArmsOfAFork) {
  // The arms begin on ray 1, where the samples 4 and 5 turn.
  const plane::Contours contours = build({{0, 9}, {1, 4, 5, 8}, {1, 3, 6, 8}});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(canonical(contours.loop(0)), (Points{{0, 0},
                                                 {1, 1},
                                                 {2, 1},
                                                 {2, 3},
                                                 {1, 4},
                                                 {1, 5},
                                                 {2, 6},
                                                 {2, 8},
                                                 {1, 8},
                                                 {0, 9}}));
}

TEST(LoopBuilder, KeepsSolidsApartWhoseIntervalsOnlyTouch) {
  const plane::Contours contours = build({{0, 5}, {0, 5}, {5, 9}, {5, 9}});
  ASSERT_EQ(contours.loop_count(), 2U);
  EXPECT_EQ(canonical(contours.loop(0)),
            (Points{{0, 0}, {1, 0}, {1, 5}, {0, 5}}));
  EXPECT_EQ(canonical(contours.loop(1)),
            (Points{{2, 5}, {3, 5}, {3, 9}, {2, 9}}));
}

TEST(LoopBuilder, LosesWhatOneRayAloneHasSeen) {
  EXPECT_TRUE(build({{}, {2, 7}, {}}).is_empty());
  const plane::Contours contours = build({{0, 1}, {0, 1, 3, 4}, {0, 1}});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(contours.loop(0).size(), 4U);
}

TEST(LoopBuilder, ObliqueWallsFallApartWhereNeighbouringRaysDoNotOverlap) {
  EXPECT_TRUE(build({{0, 1}, {2, 3}, {4, 5}}).is_empty());
}

TEST(LoopBuilder, DropsThePointsOfAStraightWall) {
  const plane::Contours contours =
      build({{0, 1}, {0.1, 1.3}, {0.2, 1.6}, {0.3, 1.9}, {0.4, 2.2}});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(contours.loop(0).size(), 4U);
}

TEST(LoopBuilder, MakesOneWallOfTurnsOnBothSidesOfARay) {
  // Ray 1 bears two teeth of no width on the flank of the solid.
  const plane::Contours contours = build({{0, 9}, {0, 2, 5, 9}, {}});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(canonical(contours.loop(0)),
            (Points{{0, 0}, {1, 0}, {1, 9}, {0, 9}}));
}

// --- Against the rules as the paper states them ------------------------------

struct ImageSample {
  std::size_t ray;
  double depth;
  bool is_entry;
};

// The partner of `sample` on the ray beside it, or on its own: rules 2 and 3,
// word by word. `other` may lie outside of the image: an empty ray.
ImageSample partner(const Image& image, const ImageSample& sample,
                    std::ptrdiff_t side) {
  static const std::vector<double> no_samples;
  const std::ptrdiff_t beside = static_cast<std::ptrdiff_t>(sample.ray) + side;
  const bool is_image =
      beside >= 0 && beside < static_cast<std::ptrdiff_t>(image.size());
  const std::vector<double>& own = image[sample.ray];
  const std::vector<double>& other =
      is_image ? image[static_cast<std::size_t>(beside)] : no_samples;
  // No sample of either ray lies strictly between two depths.
  const auto is_free = [&](double a, double b) {
    const auto between = [&](double d) {
      return d > std::min(a, b) && d < std::max(a, b);
    };
    return std::none_of(own.begin(), own.end(), between) &&
           std::none_of(other.begin(), other.end(), between);
  };
  // Rule 2: the nearest of the same type beside it.
  std::optional<ImageSample> best;
  for (std::size_t i = sample.is_entry ? 0 : 1; i < other.size(); i += 2) {
    if (!is_free(sample.depth, other[i])) continue;
    if (!best || std::abs(other[i] - sample.depth) <
                     std::abs(best->depth - sample.depth)) {
      best = {static_cast<std::size_t>(beside), other[i], sample.is_entry};
    }
  }
  if (best) return *best;
  // Rule 3: its neighbour on its own ray, on the side where nothing lies
  // between.
  for (std::size_t i = sample.is_entry ? 1 : 0; i < own.size(); i += 2) {
    if (!is_free(sample.depth, own[i])) continue;
    const bool both_in_other = [&] {
      // The stretch between must be inside of exactly one of the two rays.
      const double middle = (sample.depth + own[i]) / 2;
      const auto parity = [&](const std::vector<double>& ray) {
        return (std::upper_bound(ray.begin(), ray.end(), middle) -
                ray.begin()) %
               2;
      };
      return parity(own) == parity(other);
    }();
    if (!both_in_other) return {sample.ray, own[i], !sample.is_entry};
  }
  ADD_FAILURE() << "no partner";
  return sample;
}

// Loops by walking those partners, collinear points kept; each turned to begin
// with its least point; sorted.
std::vector<Points> walk_partners(const Image& image) {
  std::vector<std::vector<bool>> visited;
  for (const auto& ray : image) visited.emplace_back(ray.size(), false);
  std::vector<Points> loops;
  for (std::size_t ray = 0; ray < image.size(); ++ray) {
    for (std::size_t i = 0; i < image[ray].size(); ++i) {
      if (visited[ray][i]) continue;
      Points loop;
      ImageSample at{ray, image[ray][i], i % 2 == 0};
      for (;;) {
        const auto& depths = image[at.ray];
        const auto index = static_cast<std::size_t>(
            std::lower_bound(depths.begin(), depths.end(), at.depth) -
            depths.begin());
        if (visited[at.ray][index]) break;
        visited[at.ray][index] = true;
        loop.emplace_back(static_cast<double>(at.ray), at.depth);
        at = partner(image, at, at.is_entry ? 1 : -1);
      }
      if (loop.size() > 2) loops.push_back(canonical(loop));
    }
  }
  return loops;
}

Image random_image(std::mt19937& random) {
  Image image(1 + random() % 12);
  std::uniform_real_distribution<double> depth(0, 10);
  for (auto& ray : image) {
    ray.resize(2 * (random() % 5));
    for (double& d : ray) d = depth(random);
    std::sort(ray.begin(), ray.end());
  }
  return image;
}

bool is_less(const Points& a, const Points& b) {
  return std::lexicographical_compare(
      a.begin(), a.end(), b.begin(), b.end(), [](const Vec2& p, const Vec2& q) {
        return p.x != q.x ? p.x < q.x : p.y < q.y;
      });
}

TEST(LoopBuilder, FollowsTheThreeRulesOfThePaperInRandomImages) {
  std::mt19937 random(1);
  for (int round = 0; round < 3000; ++round) {
    const Image image = random_image(random);
    const plane::Contours contours = build(image);
    std::vector<Points> loops;
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      loops.push_back(canonical(contours.loop(i)));
    }
    std::vector<Points> expected = walk_partners(image);
    // The builder leaves out points on a wall along a ray.
    for (Points& loop : expected) {
      Points kept;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 before = loop[(i + loop.size() - 1) % loop.size()];
        const Vec2 after = loop[(i + 1) % loop.size()];
        if (before.x == loop[i].x && after.x == loop[i].x) continue;
        kept.push_back(loop[i]);
      }
      loop = canonical(kept);
    }
    std::sort(loops.begin(), loops.end(), is_less);
    std::sort(expected.begin(), expected.end(), is_less);
    ASSERT_EQ(loops, expected) << "round " << round;
  }
}

TEST(LoopBuilder, LoopsOfRandomImagesAreSimpleDisjointAndOriented) {
  std::mt19937 random(2);
  for (int round = 0; round < 1000; ++round) {
    ASSERT_TRUE(support::are_sound(build(random_image(random))))
        << "round " << round;
  }
}

TEST(LoopBuilder, AreaIsThatOfTheTrapezoidsBetweenOverlappingIntervals) {
  // Every ray crosses the same walls, each a little elsewhere: no turn but on
  // the first and the last ray.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  for (int round = 0; round < 1000; ++round) {
    Image image(2 + random() % 10);
    const auto walls = 2 + 2 * (random() % 4);
    double area = 0;
    for (std::size_t ray = 0; ray < image.size(); ++ray) {
      const bool is_end = ray == 0 || ray + 1 == image.size();
      for (unsigned wall = 0; wall < walls; ++wall) {
        image[ray].push_back(wall + jitter(random));
        const double sign = wall % 2 == 0 ? -1 : 1;
        area += sign * image[ray].back() * (is_end ? 0.5 : 1);
      }
    }
    EXPECT_NEAR(support::total_area(build(image)), area, 1e-9);
  }
}

}  // namespace
}  // namespace lamina::ldni
