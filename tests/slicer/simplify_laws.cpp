#include "tests/slicer/simplify_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "slicer/defects.h"
#include "slicer/simplify.h"
#include "tests/support/contour_checks.h"
#include "tests/support/edge_grid.h"

namespace lamina::slicer {
namespace {

using ldni::Contours;
using support::are_sound;
using support::count_loops;

double distance_to_edge(Vec2 point, const support::Edge& edge) {
  const Vec2 along = edge.to - edge.from;
  const Vec2 to = point - edge.from;
  const double share = std::clamp((to.x * along.x + to.y * along.y) /
                                      (along.x * along.x + along.y * along.y),
                                  0.0, 1.0);
  const Vec2 away = to - share * along;
  return std::hypot(away.x, away.y);
}

// Greatest distance from one contour to the other, measured at vertices and at
// eight points of each edge; infinite where it is far above the tolerance.
double one_sided_distance(const Contours& from, const Contours& to,
                          double tolerance) {
  const std::vector<support::Edge> edges = support::edges_of(to);
  const support::EdgeGrid grid(edges, 2 * tolerance);
  const auto columns = grid.column_at(std::numeric_limits<double>::max()) + 1;
  double greatest = 0;
  for (std::size_t i = 0; i < from.loop_count(); ++i) {
    const auto loop = from.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2 step = loop[(j + 1) % loop.size()] - loop[j];
      for (int k = 0; k < 8; ++k) {
        const Vec2 point = loop[j] + (k / 8.0) * step;
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t edge : grid.cell(
                 grid.row_at(point.y) * columns + grid.column_at(point.x))) {
          nearest = std::min(nearest, distance_to_edge(point, edges[edge]));
        }
        greatest = std::max(greatest, nearest);
      }
    }
  }
  return greatest;
}

// The loops as a file holds them, for the exact check.
SlcLayer rounded(const Contours& contours) {
  SlcLayer layer;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    SlcBoundary boundary;
    for (const Vec2& point : contours.loop(i)) {
      const Vec2 place(static_cast<float>(point.x),
                       static_cast<float>(point.y));
      if (boundary.points.empty() || boundary.points.back() != place) {
        boundary.points.push_back(place);
      }
    }
    if (boundary.points.back() != boundary.points.front()) {
      boundary.points.push_back(boundary.points.front());
    }
    layer.boundaries.push_back(std::move(boundary));
  }
  return layer;
}

// For each loop, which others enclose its lowest of the leftmost points.
std::vector<std::vector<std::size_t>> nesting(const Contours& contours) {
  std::vector<std::vector<std::size_t>> result(contours.loop_count());
  std::vector<Contours> alone(contours.loop_count());
  std::vector<Vec2> low(contours.loop_count());
  std::vector<Vec2> high(contours.loop_count());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const auto loop = contours.loop(i);
    support::add_loop(alone[i], {loop.begin(), loop.end()});
    low[i] = high[i] = loop[0];
    for (const Vec2& p : loop) {
      low[i] = {std::min(low[i].x, p.x), std::min(low[i].y, p.y)};
      high[i] = {std::max(high[i].x, p.x), std::max(high[i].y, p.y)};
    }
  }
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const auto loop = contours.loop(i);
    const Vec2 p = *std::min_element(
        loop.begin(), loop.end(), [](const Vec2& a, const Vec2& b) {
          return a.x < b.x || (a.x == b.x && a.y < b.y);
        });
    for (std::size_t j = 0; j < alone.size(); ++j) {
      if (j != i && p.x > low[j].x && p.x < high[j].x && p.y > low[j].y &&
          p.y < high[j].y && support::contains(alone[j], p)) {
        result[i].push_back(j);
      }
    }
  }
  return result;
}

}  // namespace

Contours simplified(Contours contours, double tolerance) {
  Simplifier(tolerance).simplify(contours);
  return contours;
}

void expect_lawful(const Contours& before, double tolerance,
                   const std::string& what) {
  const Contours after = simplified(before, tolerance);
  support::ContourRules rules;
  rules.collinear_distance = 0;  // random shapes may have such points before
  rules.least_area = 0;
  ASSERT_TRUE(are_sound(before, rules)) << what;
  EXPECT_TRUE(are_sound(after, rules)) << what;
  EXPECT_EQ(count_loops(before), count_loops(after)) << what;
  EXPECT_EQ(nesting(before), nesting(after)) << what;
  if (find_defects(rounded(before)).empty()) {
    EXPECT_TRUE(find_defects(rounded(after)).empty()) << what;
  }
  EXPECT_LE(one_sided_distance(after, before, tolerance), tolerance + 1e-12)
      << what;
  EXPECT_LE(one_sided_distance(before, after, tolerance), tolerance + 1e-12)
      << what;
  EXPECT_LE(after.points.size(), before.points.size()) << what;
}

}  // namespace lamina::slicer
