#include "slicer/check/region_areas.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

// Steps through crossings, at most, for a layer.
constexpr std::uint64_t kMostSteps = 3'000'000'000;

struct Edge {
  Vec2 left;
  Vec2 right;
  double slope = 0;
  int winding = 0;  // added above the edge
  bool is_of_b = false;

  double y_at(double x) const {
    if (x <= left.x) return left.y;
    if (x >= right.x) return right.y;
    return left.y + (x - left.x) * slope;
  }
};

// An edge across the strip in hand.
struct Crossed {
  std::uint32_t edge = 0;
  double left_y = 0;
  double right_y = 0;
  std::uint32_t rank = 0;  // from below, at the right side

  double middle_y() const { return (left_y + right_y) / 2; }
};

bool is_below_at_left(const Crossed& p, const Crossed& q) {
  return p.left_y != q.left_y ? p.left_y < q.left_y : p.right_y < q.right_y;
}

bool is_below_at_right(const Crossed& p, const Crossed& q) {
  return p.right_y != q.right_y ? p.right_y < q.right_y : p.left_y < q.left_y;
}

// Sorts what is nearly sorted; calls passed(p, q) where p comes below q, which
// was below p so far.
template <typename Value, typename IsBelow, typename Passed>
void sort_by_insertion(std::span<Value> values, const IsBelow& is_below,
                       const Passed& passed) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    const Value value = values[i];
    std::size_t j = i;
    for (; j > 0 && is_below(value, values[j - 1]); --j) {
      passed(value, values[j - 1]);
      values[j] = values[j - 1];
    }
    values[j] = value;
  }
}

// The winding numbers of both sets, going upwards, and the areas so far.
class Areas {
 public:
  // Passes an edge that is at `y` in the middle of a strip of this width.
  void pass(const Edge& edge, double y, double width) {
    const int before = kind();
    winding_[edge.is_of_b ? 1 : 0] += edge.winding;
    const int after = kind();
    if (before == after) return;
    areas_[static_cast<std::size_t>(before)] += y * width;
    areas_[static_cast<std::size_t>(after)] -= y * width;
  }

  std::array<int, 2> winding() const { return winding_; }
  void set_winding(std::array<int, 2> winding) { winding_ = winding; }

  RegionAreas areas() const { return {areas_[3], areas_[1], areas_[2]}; }

 private:
  // Bit 0: inside of a; bit 1: inside of b.
  int kind() const {
    return (winding_[0] != 0 ? 1 : 0) + (winding_[1] != 0 ? 2 : 0);
  }

  std::array<int, 2> winding_ = {0, 0};
  std::array<double, 4> areas_ = {0, 0, 0, 0};  // by kind()
};

class Sweep {
 public:
  void add(const ldni::Contours& contours, bool is_of_b) {
    visit_edges(contours, [&](Vec2 from, Vec2 to) {
      if (from.x == to.x) return;
      const bool runs_right = from.x < to.x;
      edges_.push_back({runs_right ? from : to, runs_right ? to : from,
                        (to.y - from.y) / (to.x - from.x), runs_right ? 1 : -1,
                        is_of_b});
    });
  }

  RegionAreas run() {
    // Sum up small numbers: y counts from the middle.
    shift_to_middle();
    std::ranges::sort(edges_, {}, [](const Edge& edge) { return edge.left.x; });
    const std::vector<double> event_points = list_event_points();
    std::size_t next = 0;  // of edges_
    for (std::size_t i = 0; i + 1 < event_points.size(); ++i) {
      const double left = event_points[i];
      const double right = event_points[i + 1];
      std::erase_if(crossed_, [&](const Crossed& crossed) {
        return edges_[crossed.edge].right.x <= left;
      });
      for (; next < edges_.size() && edges_[next].left.x <= left; ++next) {
        crossed_.push_back({static_cast<std::uint32_t>(next)});
      }
      sweep_strip(left, right);
    }
    return areas_.areas();
  }

 private:
  // x of all ends, ascending.
  std::vector<double> list_event_points() const {
    std::vector<double> points;
    for (const Edge& edge : edges_) {
      points.push_back(edge.left.x);
      points.push_back(edge.right.x);
    }
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  void shift_to_middle() {
    if (edges_.empty()) return;
    double low = edges_.front().left.y;
    double high = low;
    for (const Edge& edge : edges_) {
      low = std::min({low, edge.left.y, edge.right.y});
      high = std::max({high, edge.left.y, edge.right.y});
    }
    for (Edge& edge : edges_) {
      edge.left.y -= (low + high) / 2;
      edge.right.y -= (low + high) / 2;
    }
  }

  void sweep_strip(double left, double right) {
    for (Crossed& crossed : crossed_) {
      crossed.left_y = edges_[crossed.edge].y_at(left);
      crossed.right_y = edges_[crossed.edge].y_at(right);
    }
    sort_by_insertion(std::span(crossed_), is_below_at_left,
                      [](const Crossed&, const Crossed&) {});
    areas_.set_winding({0, 0});
    const double width = right - left;
    if (std::ranges::is_sorted(crossed_, is_below_at_right)) {
      for (const Crossed& crossed : crossed_) {
        areas_.pass(edges_[crossed.edge], crossed.middle_y(), width);
      }
      return;
    }
    rank_at_right();
    // Edges that change places with each other alone are a cluster.
    std::size_t begin = 0;
    std::uint32_t greatest = 0;
    for (std::size_t i = 0; i < crossed_.size(); ++i) {
      greatest = std::max(greatest, crossed_[i].rank);
      if (greatest != i) continue;
      sweep_cluster(std::span(crossed_).subspan(begin, i + 1 - begin), width);
      begin = i + 1;
    }
  }

  void rank_at_right() {
    order_.resize(crossed_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::stable_sort(
        order_, is_below_at_right,
        [this](std::uint32_t i) -> const Crossed& { return crossed_[i]; });
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      crossed_[order_[i]].rank = i;
    }
  }

  void sweep_cluster(std::span<const Crossed> cluster, double width) {
    if (cluster.size() == 1) {
      areas_.pass(edges_[cluster[0].edge], cluster[0].middle_y(), width);
      return;
    }
    find_crossings(cluster);
    const std::array<int, 2> winding = areas_.winding();
    double from = 0;
    for (const double to : crossings_) {
      areas_.set_winding(winding);
      sweep_between_crossings(cluster, from, to, width);
      from = to;
    }
  }

  // Finds crossings as shares of the strip, ascending, its end among them.
  void find_crossings(std::span<const Crossed> cluster) {
    crossings_.assign(1, 1.0);
    sorted_.assign(cluster.begin(), cluster.end());
    sort_by_insertion(std::span(sorted_), is_below_at_right,
                      [this](const Crossed& p, const Crossed& q) {
                        const double at_left = p.left_y - q.left_y;
                        const double at_right = q.right_y - p.right_y;
                        if (at_left <= 0 || at_right <= 0)
                          return;  // they meet at a side
                        crossings_.push_back(at_left / (at_left + at_right));
                      });
    steps_ += cluster.size() * crossings_.size();
    if (steps_ > kMostSteps) {
      throw GeometryError("contours cross each other too often to be compared");
    }
    std::ranges::sort(crossings_);
  }

  void sweep_between_crossings(std::span<const Crossed> cluster, double from,
                               double to, double width) {
    const double middle = (from + to) / 2;
    heights_.clear();
    for (const Crossed& crossed : cluster) {
      heights_.emplace_back(
          crossed.left_y + middle * (crossed.right_y - crossed.left_y),
          crossed.edge);
    }
    std::ranges::sort(heights_);
    for (const auto& [y, edge] : heights_) {
      areas_.pass(edges_[edge], y, (to - from) * width);
    }
  }

  std::vector<Edge> edges_;       // by their left ends
  std::vector<Crossed> crossed_;  // in the strip, from below at its left side
  Areas areas_;
  std::uint64_t steps_ = 0;
  // Scratch.
  std::vector<std::uint32_t> order_;
  std::vector<Crossed> sorted_;
  std::vector<double> crossings_;
  std::vector<std::pair<double, std::uint32_t>> heights_;
};

}  // namespace

RegionAreas measure_regions(const ldni::Contours& a, const ldni::Contours& b) {
  Sweep sweep;
  sweep.add(a, false);
  sweep.add(b, true);
  return sweep.run();
}

}  // namespace lamina::slicer
