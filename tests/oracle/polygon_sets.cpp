#include "tests/oracle/polygon_sets.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include "tests/oracle/exact_edge.h"

namespace lamina::oracle {
namespace {

using Point = ExactKernel::Point_2;
using Polygon = CGAL::Polygon_2<ExactKernel>;
using PolygonWithHoles = CGAL::Polygon_with_holes_2<ExactKernel>;
using PolygonSet = CGAL::Polygon_set_2<ExactKernel>;

struct PointLess {
  bool operator()(const Point& a, const Point& b) const {
    return CGAL::compare_xy(a, b) == CGAL::SMALLER;
  }
};

// Simple polygons from boundary edges: a walk that comes back to a point that
// it has passed has closed a loop.
std::vector<Polygon> loops_of(const ExactRegion& region) {
  std::multimap<Point, Point, PointLess> ways;
  for (const ExactEdge& edge : region.edges().all) {
    ways.emplace(edge.from, edge.to);
  }
  std::vector<Polygon> loops;
  while (!ways.empty()) {
    std::vector<Point> walk = {ways.begin()->first};
    do {
      const auto way = ways.find(walk.back());
      const Point next = way->second;
      ways.erase(way);
      const auto seen = std::find(walk.begin(), walk.end(), next);
      if (seen == walk.end()) {
        walk.push_back(next);
        continue;
      }
      loops.emplace_back(seen, walk.end());
      walk.erase(std::next(seen), walk.end());
    } while (walk.size() > 1);
  }
  return loops;
}

PolygonSet set_of(const ExactRegion& region) {
  PolygonSet result;
  for (Polygon& loop : loops_of(region)) {
    if (loop.is_clockwise_oriented()) loop.reverse_orientation();
    result.symmetric_difference(loop);
  }
  return result;
}

PolygonSet unite(std::vector<PolygonSet> sets) {
  // In pairs, so that no large set is passed over for each small one.
  if (sets.empty()) return {};
  for (std::size_t step = 1; step < sets.size(); step *= 2) {
    for (std::size_t i = 0; i + step < sets.size(); i += 2 * step) {
      sets[i].join(sets[i + step]);
      sets[i + step].clear();
    }
  }
  PolygonSet all = std::move(sets.front());
  return all;
}

// Evaluates the program from its leaves up.
class Evaluation {
 public:
  Evaluation(const WorldScene& scene, double z)
      : minuends_(scene.program.size()), others_(scene.program.size()) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
      WorldScene leaf;
      leaf.meshes = {scene.meshes[i]};
      leaf.parent = {0};
      leaf.is_minuend = {false};
      leaf.program = {{plane::BooleanOp::kUnion, 0, false, 1}};
      hand(scene.parent[i], scene.is_minuend[i],
           set_of(exact_section(leaf, z)));
    }
    // Children stand behind their parents.
    for (std::size_t n = scene.program.size(); n-- > 1;) {
      const plane::BooleanNode& node = scene.program[n];
      hand(node.parent, node.is_minuend, evaluate(n, node.op));
    }
    result_ = evaluate(0, scene.program[0].op);
  }

  const PolygonSet& result() const { return result_; }

 private:
  void hand(std::size_t parent, bool is_minuend, PolygonSet set) {
    if (is_minuend) {
      minuends_[parent] = std::move(set);
    } else {
      others_[parent].push_back(std::move(set));
    }
  }

  PolygonSet evaluate(std::size_t n, plane::BooleanOp op) {
    std::vector<PolygonSet> others = std::move(others_[n]);
    if (op == plane::BooleanOp::kDifference) {
      PolygonSet set = minuends_[n].value_or(PolygonSet());
      set.difference(unite(std::move(others)));
      return set;
    }
    if (minuends_[n].has_value()) others.push_back(*minuends_[n]);
    if (op == plane::BooleanOp::kUnion) return unite(std::move(others));
    PolygonSet set = others.empty() ? PolygonSet() : others.front();
    for (const PolygonSet& other : others) set.intersection(other);
    return set;
  }

  std::vector<std::optional<PolygonSet>> minuends_;
  std::vector<std::vector<PolygonSet>> others_;
  PolygonSet result_;
};

}  // namespace

SetSection section_by_sets(const WorldScene& scene, double z) {
  const Evaluation evaluation(scene, z);
  std::vector<PolygonWithHoles> polygons;
  evaluation.result().polygons_with_holes(std::back_inserter(polygons));
  SetSection section;
  ExactKernel::FT area = 0;
  section.counts.regions = polygons.size();
  for (const PolygonWithHoles& polygon : polygons) {
    section.counts.holes += polygon.number_of_holes();
    area += polygon.outer_boundary().area();
    for (auto hole = polygon.holes_begin(); hole != polygon.holes_end();
         ++hole) {
      area += hole->area();  // negative: holes run clockwise
    }
  }
  std::ostringstream text;
  text << CGAL::exact(area);
  section.area = text.str();
  return section;
}

}  // namespace lamina::oracle
