// What pictures of stacks are made of: trapezoids, depths in layers, places of
// supports and colors, the camera.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/loop_area.h"
#include "slicer/picture/camera.h"
#include "slicer/picture/detail/body_places.h"
#include "slicer/picture/detail/layer_distance.h"
#include "slicer/picture/detail/trapezoids.h"

namespace lamina::slicer {
namespace {

// Stars with round holes, side by side: every angle, no two loops that touch.
plane::Contours make_stars(std::mt19937& random) {
  std::uniform_real_distribution<double> radius(3, 9);
  plane::Contours contours;
  for (int star = 0; star < 4; ++star) {
    const Vec2 center(20.0 * (star % 2), 20.0 * (star / 2));
    for (int i = 0; i < 40; ++i) {
      const double angle = 2 * std::numbers::pi * i / 40;
      contours.points.push_back(
          center + radius(random) * Vec2(std::cos(angle), std::sin(angle)));
    }
    contours.ends.push_back(static_cast<std::uint32_t>(contours.points.size()));
    for (int i = 0; i < 12; ++i) {
      const double angle = -2 * std::numbers::pi * i / 12;
      contours.points.push_back(center +
                                2.0 * Vec2(std::cos(angle), std::sin(angle)));
    }
    contours.ends.push_back(static_cast<std::uint32_t>(contours.points.size()));
  }
  return contours;
}

double area_of(const plane::Contours& contours) {
  double area = 0;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    area += signed_area(contours.loop(i));
  }
  return area;
}

// Winding number by the edges above a place.
bool is_inside(const plane::Contours& contours, Vec2 place) {
  bool inside = false;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2& a = loop[j];
      const Vec2& b = loop[(j + 1) % loop.size()];
      if ((a.x <= place.x) == (b.x <= place.x)) continue;
      const double y = a.y + (b.y - a.y) * (place.x - a.x) / (b.x - a.x);
      inside = inside != (y > place.y);
    }
  }
  return inside;
}

double distance_to(const plane::Contours& contours, Vec2 place) {
  double nearest = 1e300;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2 a = loop[j];
      const Vec2 step = loop[(j + 1) % loop.size()] - a;
      const double share =
          std::clamp(((place.x - a.x) * step.x + (place.y - a.y) * step.y) /
                         (step.x * step.x + step.y * step.y),
                     0.0, 1.0);
      const Vec2 way = place - (a + share * step);
      nearest = std::min(nearest, std::hypot(way.x, way.y));
    }
  }
  return nearest;
}

TEST(Trapezoids, CoverALayerOnce) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    const plane::Contours contours = make_stars(random);
    std::vector<Trapezoid> cut;
    cut_into_trapezoids(contours, cut);
    double area = 0;
    for (const Trapezoid& t : cut) {
      area += (t.top - t.bottom) *
              (t.bottom_right - t.bottom_left + t.top_right - t.top_left) / 2;
      const Vec2 middle(
          (t.bottom_left + t.bottom_right + t.top_left + t.top_right) / 4,
          (t.bottom + t.top) / 2);
      EXPECT_TRUE(is_inside(contours, middle));
    }
    EXPECT_NEAR(area, area_of(contours), 1e-9);
    EXPECT_LT(cut.size(), contours.points.size() + 1);
  }
}

TEST(Trapezoids, ASquareIsOne) {
  std::vector<Trapezoid> cut;
  cut_into_trapezoids({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {4}}, cut);
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_EQ(cut[0].top - cut[0].bottom, 1);
  cut_into_trapezoids({}, cut);
  EXPECT_TRUE(cut.empty());
}

TEST(Trapezoids, BarsThatBeginAndEndOneByOneAreOneEach) {
  // Minutes, if at each end all bars were looked for among all bars.
  constexpr int kBars = 10'000;
  plane::Contours contours;
  for (int i = 0; i < kBars; ++i) {
    const double x = 2.0 * i;
    const double y = 1e-3 * ((i * 7919) % kBars);
    contours.add_loop(std::array<Vec2, 4>{
        {{x, y}, {x + 1, y}, {x + 1, y + 100}, {x, y + 100}}});
  }
  std::vector<Trapezoid> cut;
  cut_into_trapezoids(contours, cut);
  ASSERT_EQ(cut.size(), std::size_t{kBars});
  double area = 0;
  for (const Trapezoid& t : cut) {
    area += (t.top - t.bottom) * (t.top_right - t.top_left);
  }
  EXPECT_NEAR(area, 100.0 * kBars, 1e-6);
}

TEST(LayerDistance, IsThatOfAllEdgesTriedOneByOne) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-12, 32);
  const plane::Contours contours = make_stars(random);
  const double reach = 2.5;
  const LayerDistance layer(contours, reach);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 place(coordinate(random), coordinate(random));
    const double distance = std::min(distance_to(contours, place), reach);
    const auto [depth, inward] = layer.at(place);
    EXPECT_NEAR(depth, is_inside(contours, place) ? distance : -distance, 1e-9);
    if (std::abs(depth) < reach - 0.01) {
      // One step along the gradient is one step deeper, but past a bisector.
      const double step = 1e-4;
      EXPECT_LE(layer.at(place + step * inward).depth, depth + step + 1e-9);
      EXPECT_NEAR(std::hypot(inward.x, inward.y), 1, 1e-9);
    }
  }
}

TEST(LayerDistance, OnAnEdgeItsLeftSideIsTheInside) {
  const LayerDistance layer({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {4}}, 1);
  const auto [depth, inward] = layer.at({1, 0});
  EXPECT_NEAR(depth, 0, 1e-9);
  EXPECT_NEAR(inward.x, 0, 1e-9);
  EXPECT_NEAR(inward.y, 1, 1e-9);
  EXPECT_EQ(LayerDistance({}, 1).at({0, 0}).depth, -1);
}

plane::Contours rectangle(Vec2 low, Vec2 high) {
  return {{low, {high.x, low.y}, high, {low.x, high.y}}, {4}};
}

// A bar that is half in the part, and a post beside both.
TEST(BodyPlaces, OfSupportsAreNotOfThePart) {
  Layer layer;
  layer.part = rectangle({0, 0}, {6, 6});
  layer.supports = rectangle({5, 2}, {7, 4});
  layer.supports.add_loop(rectangle({9, 9}, {10, 10}).points);
  const BodyPlaces places({{}, layer, {}});
  for (const Vec2 place :
       {Vec2(6.5, 3), Vec2(7, 3), Vec2(6.1, 2), Vec2(9.5, 9.5), Vec2(9, 9),
        Vec2(10.001, 9.5), Vec2(7, 4.001)}) {
    EXPECT_TRUE(places.is_of_support(1, place)) << place.x << ' ' << place.y;
  }
  for (const Vec2 place :
       {Vec2(3, 3), Vec2(5.5, 3), Vec2(5, 2), Vec2(6, 5), Vec2(6, 0),
        Vec2(6.001, 1), Vec2(0, -0.02), Vec2(5.95, 3)}) {
    EXPECT_FALSE(places.is_of_support(1, place)) << place.x << ' ' << place.y;
  }
  EXPECT_FALSE(places.is_of_support(0, {6.5, 3}));
  EXPECT_FALSE(places.is_of_support(2, {6.5, 3}));
}

TEST(BodyPlaces, AreOfNothingWhereLayersKnowOfNone) {
  Layer layer;
  layer.contours = rectangle({0, 0}, {6, 6});
  const BodyPlaces places({layer});
  EXPECT_FALSE(places.is_of_support(0, {3, 3}));
  EXPECT_FALSE(places.color_at(0, {3, 3}));
}

// A red square and a blue one that overlap, and a bare one.
TEST(BodyPlaces, HaveTheColorThatTheyLieDeepestIn) {
  Layer layer;
  layer.colored = {{0xff0000, rectangle({0, 0}, {6, 6})},
                   {0x0000ff, rectangle({5.9, 2}, {9, 4})}};
  const BodyPlaces places({layer, {}});
  for (const auto& [place, color] :
       {std::pair(Vec2(3, 3), 0xff0000), std::pair(Vec2(6, 5), 0xff0000),
        std::pair(Vec2(5.92, 3), 0xff0000), std::pair(Vec2(5.98, 3), 0x0000ff),
        std::pair(Vec2(7, 2), 0x0000ff), std::pair(Vec2(7, 1.999), 0x0000ff)}) {
    EXPECT_EQ(places.color_at(0, place), color) << place.x << ' ' << place.y;
  }
  EXPECT_FALSE(places.color_at(0, {12, 3}));
  EXPECT_FALSE(places.color_at(0, {7, 1.99}));
  EXPECT_FALSE(places.color_at(1, {3, 3}));
}

TEST(Camera, AnEyeIsAtTheOriginOfTheView) {
  for (const std::array<double, 6>& numbers :
       {std::array<double, 6>{40, -30, 25, 8, 10, 4},
        {0, 0, 9, 0, 0, 1},
        {0, 0, -9, 0, 0, 1},
        {-3, 2, -8, 5, 5, 5}}) {
    const Camera camera = Camera::from_numbers(numbers);
    const Mat4 view = camera.view_from_world();
    const Vec4 eye = view * Vec4(numbers[0], numbers[1], numbers[2], 1);
    const Vec4 center = view * Vec4(numbers[3], numbers[4], numbers[5], 1);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(eye[i], 0, 1e-9);
      EXPECT_NEAR(center[i], i == 2 ? -camera.distance : 0, 1e-9);
    }
    // Up is up: +z has no part to the right, and none downwards.
    const Vec4 up = view * Vec4(0, 0, 1, 0);
    EXPECT_NEAR(up.x, 0, 1e-9);
    EXPECT_GE(up.y, -1e-9);
  }
}

TEST(Camera, EverythingIsWithinThePicture) {
  const Box3 box = {{-3, 5, 1}, {9, 6, 30}};
  for (const auto projection :
       {Camera::Projection::kPerspective, Camera::Projection::kOrthogonal}) {
    for (double turn = 0; turn < 360; turn += 50) {
      Camera camera;
      camera.projection = projection;
      camera.turn_deg = {turn, 10, 2 * turn};
      camera.show_all(box);
      const Mat4 clip =
          camera.clip_from_view(1, box) * camera.view_from_world();
      for (int corner = 0; corner < 8; ++corner) {
        const Vec4 at =
            clip * Vec4((corner & 1) != 0 ? box.low.x : box.high.x,
                        (corner & 2) != 0 ? box.low.y : box.high.y,
                        (corner & 4) != 0 ? box.low.z : box.high.z, 1);
        for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(at[i] / at.w), 1);
      }
    }
  }
}

}  // namespace
}  // namespace lamina::slicer
