#include "tests/slicer/contour/simplify_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "slicer/check/defects/defects.h"
#include "slicer/contour/simplify.h"
#include "tests/support/contour_checks.h"
#include "tests/support/edge_grid.h"

namespace lamina::slicer {
namespace {

using plane::Contours;
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
std::vector<WrittenLoop> rounded(const Contours& contours) {
  std::vector<WrittenLoop> loops(contours.loop_count());
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    std::vector<Vec2>& points = loops[i].points;
    for (const Vec2& point : contours.loop(i)) {
      const Vec2 place(static_cast<float>(point.x),
                       static_cast<float>(point.y));
      if (points.empty() || points.back() != place) {
        points.push_back(place);
      }
    }
    if (points.back() != points.front()) {
      points.push_back(points.front());
    }
  }
  return loops;
}

// Each loop by itself.
std::vector<Contours> split(const Contours& contours) {
  std::vector<Contours> loops(contours.loop_count());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto loop = contours.loop(i);
    support::add_loop(loops[i], {loop.begin(), loop.end()});
  }
  return loops;
}

// A vertex of each loop that no other loop touches, if there is one.
std::vector<std::optional<Vec2>> free_vertices(
    const std::vector<Contours>& loops) {
  std::vector<std::optional<Vec2>> result(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto is_free = [&](Vec2 point) {
      for (std::size_t j = 0; j < loops.size(); ++j) {
        if (j != i && support::distance_to_edges(loops[j], point) < 1e-6) {
          return false;
        }
      }
      return true;
    };
    const std::vector<Vec2>& points = loops[i].points;
    const auto found = std::find_if(points.begin(), points.end(), is_free);
    if (found != points.end()) result[i] = *found;
  }
  return result;
}

// For each of the points, one of each loop, which other loops enclose it.
std::vector<std::vector<std::size_t>> nesting(
    const std::vector<Contours>& loops,
    const std::vector<std::optional<Vec2>>& points) {
  std::vector<std::vector<std::size_t>> result(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (std::size_t j = 0; j < loops.size(); ++j) {
      if (j != i && points[i] && support::contains(loops[j], *points[i])) {
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
  const std::vector<Contours> loops = split(after);
  const std::vector<std::optional<Vec2>> points = free_vertices(loops);
  EXPECT_EQ(nesting(split(before), points), nesting(loops, points)) << what;
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
