#include "slicer/pixels/coverage.h"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

// Rows of shares, top to bottom.
std::vector<std::vector<float>> shares_of(const Coverage& coverage) {
  std::vector<std::vector<float>> rows(coverage.height());
  for (unsigned y = 0; y < coverage.height(); ++y) {
    coverage.resolve_row(y, rows[y]);
  }
  return rows;
}

double sum_of(const Coverage& coverage) {
  double sum = 0;
  for (const auto& row : shares_of(coverage)) {
    sum += std::accumulate(row.begin(), row.end(), 0.0);
  }
  return sum;
}

void add_polygon(Coverage& coverage, const std::vector<Vec2>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    coverage.add_edge(corners[i], corners[(i + 1) % corners.size()]);
  }
}

TEST(Coverage, ARectangleCoversPixelsByTheirShare) {
  Coverage coverage(4, 3);
  add_polygon(coverage, {{0.5, 0.25}, {3, 0.25}, {3, 2}, {0.5, 2}});
  const std::vector<std::vector<float>> expected = {
      {0.375F, 0.75F, 0.75F, 0}, {0.5F, 1, 1, 0}, {0, 0, 0, 0}};
  EXPECT_EQ(shares_of(coverage), expected);
}

TEST(Coverage, ATriangleCoversHalfOfThePixelsOnItsSlope) {
  Coverage coverage(3, 3);
  add_polygon(coverage, {{0, 0}, {3, 3}, {0, 3}});
  const std::vector<std::vector<float>> expected = {
      {0.5F, 0, 0}, {1, 0.5F, 0}, {1, 1, 0.5F}};
  EXPECT_EQ(shares_of(coverage), expected);
}

TEST(Coverage, EitherWayAroundIsTheSame) {
  Coverage one(5, 5);
  Coverage other(5, 5);
  add_polygon(one, {{1.2, 0.7}, {4.4, 2.1}, {2.3, 4.9}});
  add_polygon(other, {{2.3, 4.9}, {4.4, 2.1}, {1.2, 0.7}});
  EXPECT_EQ(shares_of(one), shares_of(other));
}

TEST(Coverage, TheSumOfSharesIsTheArea) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 40);
  for (int run = 0; run < 200; ++run) {
    const Vec2 a(place(random), place(random));
    const Vec2 b(place(random), place(random));
    const Vec2 c(place(random), place(random));
    Coverage coverage(40, 40);
    add_polygon(coverage, {a, b, c});
    const double area =
        std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
    EXPECT_NEAR(sum_of(coverage), area, 1e-4);
  }
}

TEST(Coverage, WhatLiesOutsideIsCutOff) {
  Coverage coverage(4, 4);
  add_polygon(coverage, {{-7, -3}, {9, -3}, {9, 11}, {-7, 11}});
  EXPECT_NEAR(sum_of(coverage), 16, 1e-6);
  // A slope that runs through the left side inside a pixel row.
  Coverage slope(2, 2);
  add_polygon(slope, {{-1, 0}, {1, 2}, {-1, 2}});
  EXPECT_NEAR(sum_of(slope), 0.5, 1e-6);
  Coverage right(2, 2);
  add_polygon(right, {{3, 0}, {3, 2}, {1, 2}});
  EXPECT_NEAR(sum_of(right), 0.5, 1e-6);
}

TEST(Coverage, StretchesTellTheSameAsPixels) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-5, 35);
  for (int run = 0; run < 100; ++run) {
    Coverage coverage(30, 20);
    add_polygon(coverage, {{place(random), place(random)},
                           {place(random), place(random)},
                           {place(random), place(random)}});
    std::vector<float> shares;
    std::vector<GreyRun> runs;
    for (unsigned y = 0; y < coverage.height(); ++y) {
      coverage.resolve_row(y, shares);
      coverage.resolve_row(y, runs);
      std::vector<float> greys;
      for (const GreyRun& stretch : runs) {
        greys.insert(greys.end(), stretch.count, stretch.grey);
      }
      ASSERT_EQ(greys.size(), shares.size());
      for (std::size_t x = 0; x < shares.size(); ++x) {
        EXPECT_NEAR(greys[x], 255 * shares[x], 0.501);
      }
    }
  }
}

TEST(Coverage, HolesAreLeftOut) {
  plane::Contours contours;
  support::add_loop(contours, {{0, 0}, {3, 0}, {3, 3}, {0, 3}});
  support::add_loop(contours, {{1, 1}, {1, 2}, {2, 2}, {2, 1}});
  Coverage coverage(30, 30);
  add_contours(coverage, contours, {Vec2(0, 30), {10, 0}, {0, -10}});
  EXPECT_NEAR(sum_of(coverage), 800, 1e-3);
  EXPECT_EQ(shares_of(coverage)[15][15], 0);
}

TEST(Coverage, StrokesHaveTheirThickness) {
  Coverage coverage(60, 60);
  coverage.add_stroke({10, 10}, {40, 50}, 4);
  // A rectangle of 50 by 4 and two half discs of twelve corners in all.
  EXPECT_NEAR(sum_of(coverage), 200 + 12 * std::sin(M_PI / 6) / 2 * 4, 1e-3);
}

TEST(Coverage, ClearsWhatWasDrawn) {
  const auto draw = [](Coverage& coverage, double shift) {
    for (int i = 0; i < 5; ++i) {
      coverage.add_stroke({3.3 * i + shift, -2}, {190 - 20 * i + shift, 44.5},
                          2.5);
    }
  };
  Coverage used(200, 40);
  draw(used, 0);
  used.clear();
  draw(used, 7.25);
  Coverage fresh(200, 40);
  draw(fresh, 7.25);
  std::vector<float> expected;
  std::vector<float> shares;
  std::vector<GreyRun> runs;
  for (unsigned y = 0; y < 40; ++y) {
    fresh.resolve_row(y, expected);
    used.resolve_row(y, shares);
    EXPECT_EQ(shares, expected);
    // The runs are these shares.
    used.resolve_row(y, runs);
    std::size_t x = 0;
    for (const GreyRun& run : runs) {
      for (unsigned i = 0; i < run.count; ++i, ++x) {
        EXPECT_NEAR(run.grey, 255 * double{expected.at(x)}, 0.501);
      }
    }
    EXPECT_EQ(x, 200U);
  }
}

}  // namespace
}  // namespace lamina::slicer
