#include "csg/lower/detail/split_contours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <queue>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csg/degrees.h"
#include "csg/limits.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using plane::Region;

// An edge, and into how many parts it falls.
struct SplitEdge {
  std::size_t index = 0;
  double length = 0;
  double parts = 1;

  // Between the length of its parts now and with one more.
  double weight() const { return length / (parts + 0.5); }
  bool operator<(const SplitEdge& other) const {
    return weight() < other.weight();
  }
};

bool are_alike(const SplitEdge& longer, const SplitEdge& shorter) {
  constexpr double kAlike = 0.999;
  return shorter.weight() >= kAlike * longer.weight();
}

class ContourSplitter {
 public:
  ContourSplitter(const LinearExtrudeParams& params, int slices)
      : params_(params), slices_(slices) {}

  // The longest edges are split until there are `count` points, all that are
  // as long together: a symmetric contour stays so.
  Contour split_longest(const Contour& contour, double count) const {
    if (static_cast<double>(contour.size()) >= count) return contour;
    require_fragments(count);
    std::vector<double> parts(contour.size(), 1);
    std::priority_queue<SplitEdge> edges;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      edges.push({i, greatest_length(contour, i)});
    }
    auto total = static_cast<double>(contour.size());
    std::vector<SplitEdge> longest;
    while (total < count) {
      longest.clear();
      while (!edges.empty() &&
             (longest.empty() || are_alike(longest.front(), edges.top()))) {
        longest.push_back(edges.top());
        edges.pop();
      }
      total += static_cast<double>(longest.size());
      if (total > count) break;
      for (SplitEdge& edge : longest) {
        parts[edge.index] = ++edge.parts;
        edges.push(edge);
      }
    }
    return split(contour, parts);
  }

  // No part is longer than $fs, but for more points than $fa asks for.
  Contour split_by_size(const Contour& contour) const {
    const double most = std::ceil(360 / params_.facets.fa);
    if (static_cast<double>(contour.size()) >= most) return contour;
    std::vector<double> parts(contour.size());
    for (std::size_t i = 0; i < contour.size(); ++i) {
      parts[i] = std::max(
          std::ceil(greatest_length(contour, i) / params_.facets.fs), 1.0);
    }
    const double total = std::accumulate(parts.begin(), parts.end(), 0.0);
    return total >= most ? split_longest(contour, most) : split(contour, parts);
  }

 private:
  // Returns the greatest length of the edge behind a point.
  double greatest_length(const Contour& contour, std::size_t i) const {
    const Vec2 edge = contour[(i + 1) % contour.size()] - contour[i];
    if (params_.scale.x == params_.scale.y) {
      return glm::length(edge) * std::max(params_.scale.x, 1.0);
    }
    double greatest = 0;
    for (int k = 0; k <= slices_; ++k) {
      const double t = static_cast<double>(k) / slices_;
      const double s = sin_deg(-params_.twist_deg * t);
      const double c = cos_deg(-params_.twist_deg * t);
      const Vec2 turned(c * edge.x - s * edge.y, s * edge.x + c * edge.y);
      const Vec2 scale = glm::mix(Vec2(1), params_.scale, t);
      greatest = std::max(greatest, glm::length(scale * turned));
    }
    return greatest;
  }

  static Contour split(const Contour& contour,
                       const std::vector<double>& parts) {
    Contour points;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 end = contour[(i + 1) % contour.size()];
      // Whole numbers. NOLINTNEXTLINE(clang-analyzer-security.FloatLoopCounter)
      for (double k = 0; k < parts[i]; ++k) {
        points.push_back(glm::mix(contour[i], end, k / parts[i]));
      }
    }
    return points;
  }

  const LinearExtrudeParams& params_;
  const int slices_;
};

}  // namespace

Region split_contours(const Region& region, const LinearExtrudeParams& params,
                      int slices, Language language) {
  if (!params.segments && language == Language::k2021) return region;
  const double fn = params.facets.fn;
  const ContourSplitter splitter(params, slices);
  Region result;
  for (const Contour& contour : region.contours) {
    if (params.segments) {
      result.contours.push_back(
          splitter.split_longest(contour, *params.segments));
    } else if (fn > 0) {
      result.contours.push_back(
          splitter.split_longest(contour, std::floor(std::max(fn, 3.0))));
    } else {
      result.contours.push_back(splitter.split_by_size(contour));
    }
  }
  return result;
}

}  // namespace lamina::csg
