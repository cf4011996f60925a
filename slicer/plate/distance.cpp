#include "slicer/plate/distance.h"

#include <algorithm>
#include <cstdint>

#include "plane/cell_grid.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "plane/region/region.h"
#include "plane/tie_distance.h"

namespace lamina::slicer {
namespace {

// What two regions have in common that is narrower is rounding [mm].
constexpr double kLeastOverlap = 1e-5;

struct Edge {
  Vec2 from;
  Vec2 to;
  std::uint32_t region;
};

// Whether the ends of each edge are on both sides of the other.
bool cross_each_other(const Edge& a, const Edge& b) {
  const auto divides = [](const Edge& one, const Edge& other) {
    return orientation(one.from, one.to, other.from) *
               orientation(one.from, one.to, other.to) <
           0;
  };
  return divides(a, b) && divides(b, a);
}

double distance_between(const Edge& a, const Edge& b) {
  const double between_ends = std::min({
      distance_to_segment(a.from, b.from, b.to),
      distance_to_segment(a.to, b.from, b.to),
      distance_to_segment(b.from, a.from, a.to),
      distance_to_segment(b.to, a.from, a.to),
  });
  return cross_each_other(a, b) ? 0 : between_ends;
}

std::vector<Edge> edges_of(std::span<const plane::Region> regions) {
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    for (const plane::Contour& contour : regions[i].contours) {
      for (std::size_t k = 0; k < contour.size(); ++k) {
        edges.push_back({contour[k], contour[(k + 1) % contour.size()], i});
      }
    }
  }
  return edges;
}

bool meet(Box2 a, const Box2& b) {
  a.intersect(b);
  return !a.is_empty();
}

// The pairs of regions with edges no farther than `reach` from each other.
std::vector<NearPair> find_near_edges(std::span<const plane::Region> regions,
                                      double reach) {
  const std::vector<Edge> edges = edges_of(regions);
  Box2 box;
  for (const Edge& edge : edges) box.add(edge.from);
  if (edges.empty()) return {};
  const CellGrid grid(static_cast<double>(edges.size()), box,
                      std::max(reach / 4, kTieDistance));
  CellLists<std::uint32_t> by_cell;
  by_cell.fill(grid.size(), [&](const auto& add) {
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      grid.visit_cells(edges[i].from, edges[i].to, Vec2(kTieDistance),
                       [&](std::size_t cell) { add(cell, i); });
    }
  });
  std::vector<NearPair> pairs;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const Edge& edge = edges[i];
    const auto compare = [&](std::size_t first, std::size_t last) {
      for (const std::uint32_t k : by_cell.between(first, last)) {
        const Edge& other = edges[k];
        if (other.region <= edge.region) continue;
        const NearPair pair(edge.region, other.region);
        if (!pairs.empty() && pairs.back() == pair) continue;
        if (distance_between(edge, other) <= reach) pairs.push_back(pair);
      }
      return false;
    };
    grid.visit_rows(edge.from, edge.to, Vec2(reach + kTieDistance), compare);
  }
  return pairs;
}

// Whether a part of `inner` lies in `outer`; no edges of the two meet.
bool lies_in(const plane::Region& inner, const plane::Region& outer) {
  return std::any_of(inner.contours.begin(), inner.contours.end(),
                     [&](const plane::Contour& contour) {
                       int windings = 0;
                       for (const plane::Contour& around : outer.contours) {
                         windings += winding_number(around, contour.front());
                       }
                       return windings != 0;
                     });
}

void add_nested(std::span<const plane::Region> regions,
                std::vector<NearPair>& pairs) {
  std::vector<Box2> boxes;
  for (const plane::Region& region : regions) {
    boxes.push_back(plane::box_of(region.contours));
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (std::size_t k = i + 1; k < regions.size(); ++k) {
      if (!meet(boxes[i], boxes[k])) continue;
      if (lies_in(regions[i], regions[k]) || lies_in(regions[k], regions[i])) {
        pairs.emplace_back(i, k);
      }
    }
  }
}

bool overlap(const plane::Region& a, const plane::Region& b) {
  plane::Region common = plane::intersect(std::vector<plane::Region>{a, b});
  plane::drop_hairlines(common, kLeastOverlap);
  return !common.is_empty();
}

}  // namespace

std::vector<NearPair> find_too_near(std::span<const plane::Region> regions,
                                    double gap) {
  plane::require_near(regions);
  const double reach = gap - kTieDistance;
  std::vector<NearPair> pairs = find_near_edges(regions, std::max(reach, 0.0));
  add_nested(regions, pairs);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (reach <= 0) {
    std::erase_if(pairs, [&](const NearPair& pair) {
      return !overlap(regions[pair.first], regions[pair.second]);
    });
  }
  return pairs;
}

}  // namespace lamina::slicer
