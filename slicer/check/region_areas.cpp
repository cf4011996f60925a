#include "slicer/check/region_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "plane/cell_grid.h"
#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

// Edges for each band, at least, and pieces of each edge, at most, on the
// average.
constexpr double kEdgesPerBand = 8;
constexpr double kPiecesPerEdge = 4;

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

// Where an edge crosses the lower side of a band.
struct Cut {
  double x = 0;
  int winding = 0;  // added to the right of it
  bool is_of_b = false;
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

  // Ends a strip of this width at the upper side of the band.
  void end(double height, double width) {
    areas_[static_cast<std::size_t>(kind())] += height * width;
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

// The sweep over one band, `height` high. y counts from its lower side: sums
// are of small numbers.
class BandSweep {
 public:
  explicit BandSweep(double height) : height_(height) {}

  void clear() {
    edges_.clear();
    cuts_.clear();
    crossed_.clear();
  }
  void add(const Edge& edge) { edges_.push_back(edge); }
  void add(const Cut& cut) { cuts_.push_back(cut); }

  void run() {
    std::ranges::sort(edges_, {}, [](const Edge& edge) { return edge.left.x; });
    std::ranges::sort(cuts_, {}, &Cut::x);
    list_event_points();
    std::array<int, 2> winding = {0, 0};  // below the strip in hand
    std::size_t next = 0;                 // of edges_
    std::size_t next_cut = 0;
    for (std::size_t i = 0; i + 1 < event_points_.size(); ++i) {
      const double left = event_points_[i];
      const double right = event_points_[i + 1];
      std::erase_if(crossed_, [&](const Crossed& crossed) {
        return edges_[crossed.edge].right.x <= left;
      });
      for (; next < edges_.size() && edges_[next].left.x <= left; ++next) {
        crossed_.push_back({static_cast<std::uint32_t>(next)});
      }
      for (; next_cut < cuts_.size() && cuts_[next_cut].x <= left; ++next_cut) {
        winding[cuts_[next_cut].is_of_b ? 1 : 0] += cuts_[next_cut].winding;
      }
      areas_.set_winding(winding);
      sweep_strip(left, right);
      areas_.end(height_, right - left);
    }
  }

  RegionAreas areas() const { return areas_.areas(); }

 private:
  // x of all ends, ascending.
  void list_event_points() {
    event_points_.clear();
    for (const Edge& edge : edges_) {
      event_points_.push_back(edge.left.x);
      event_points_.push_back(edge.right.x);
    }
    for (const Cut& cut : cuts_) event_points_.push_back(cut.x);
    std::ranges::sort(event_points_);
    event_points_.erase(std::unique(event_points_.begin(), event_points_.end()),
                        event_points_.end());
  }

  void sweep_strip(double left, double right) {
    for (Crossed& crossed : crossed_) {
      crossed.left_y = edges_[crossed.edge].y_at(left);
      crossed.right_y = edges_[crossed.edge].y_at(right);
    }
    sort_by_insertion(std::span(crossed_), is_below_at_left,
                      [](const Crossed&, const Crossed&) {});
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

  double height_;
  std::vector<Edge> edges_;  // by their left ends
  std::vector<Cut> cuts_;    // from the left
  std::vector<double> event_points_;
  std::vector<Crossed> crossed_;  // in the strip, from below at its left side
  Areas areas_;
  std::uint64_t steps_ = 0;
  // Scratch.
  std::vector<std::uint32_t> order_;
  std::vector<Crossed> sorted_;
  std::vector<double> crossings_;
  std::vector<std::pair<double, std::uint32_t>> heights_;
};

// Cuts the edges into bands.
class Bands {
 public:
  void add(const plane::Contours& contours, bool is_of_b) {
    visit_edges(contours, [&](Vec2 from, Vec2 to) {
      if (from != to) edges_.push_back({from, to, is_of_b});
    });
  }

  RegionAreas measure() {
    if (edges_.empty()) return {};
    choose_bands();
    members_.fill(count_, [this](const auto& list) {
      for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        const auto [low, high] = std::minmax(edges_[i].from.y, edges_[i].to.y);
        for (std::size_t band = band_of(low); band <= band_of(high); ++band) {
          list(band, i);
        }
      }
    });
    BandSweep sweep(height_);
    for (std::size_t band = 0; band < count_; ++band) {
      sweep.clear();
      for (const std::uint32_t i : members_[band]) {
        add_cut(edges_[i], band, sweep);
        add_piece(edges_[i], band, sweep);
      }
      sweep.run();
    }
    return sweep.areas();
  }

 private:
  struct FullEdge {
    Vec2 from;
    Vec2 to;
    bool is_of_b = false;
  };

  void choose_bands() {
    double low = edges_.front().from.y;
    double high = low;
    double climb = 0;
    for (const FullEdge& edge : edges_) {
      low = std::min(low, edge.from.y);
      high = std::max(high, edge.from.y);
      climb += std::abs(edge.to.y - edge.from.y);
    }
    const auto edges = static_cast<double>(edges_.size());
    // Sizes near the ends of the numbers cannot be divided: one band.
    if (high - low > kLeastSize && std::isfinite(climb)) {
      count_ = static_cast<std::size_t>(std::max(
          1.0, std::min(edges / kEdgesPerBand,
                        kPiecesPerEdge * edges * (high - low) / climb)));
    }
    // y counts from the lowest point, so that bands keep their digits.
    for (FullEdge& edge : edges_) {
      edge.from.y -= low;
      edge.to.y -= low;
    }
    height_ = (high - low) / static_cast<double>(count_);
  }

  double lower_side(std::size_t band) const {
    return height_ * static_cast<double>(band);
  }

  // The last band whose lower side is not above y.
  std::size_t band_of(double y) const {
    if (count_ == 1) return 0;
    auto band = static_cast<std::size_t>(
        std::clamp(y / height_, 0.0, static_cast<double>(count_ - 1)));
    while (band > 0 && lower_side(band) > y) --band;
    while (band + 1 < count_ && lower_side(band + 1) <= y) ++band;
    return band;
  }

  static bool crosses(const FullEdge& edge, double y) {
    return (edge.from.y < y) != (edge.to.y < y);
  }

  // Of an edge from below y to it or beyond, or the other way.
  static double x_at(const FullEdge& edge, double y) {
    const Vec2 lower = edge.from.y < edge.to.y ? edge.from : edge.to;
    const Vec2 upper = edge.from.y < edge.to.y ? edge.to : edge.from;
    if (y == upper.y) return upper.x;
    const double x =
        lower.x + (y - lower.y) * (upper.x - lower.x) / (upper.y - lower.y);
    return std::clamp(x, std::min(lower.x, upper.x),
                      std::max(lower.x, upper.x));
  }

  void add_cut(const FullEdge& edge, std::size_t band, BandSweep& sweep) const {
    const double y = lower_side(band);
    if (!crosses(edge, y)) return;
    // To the left of an edge that runs upwards there is more.
    sweep.add(Cut{x_at(edge, y), edge.from.y < y ? -1 : 1, edge.is_of_b});
  }

  void add_piece(const FullEdge& edge, std::size_t band,
                 BandSweep& sweep) const {
    const double low = lower_side(band);
    const bool is_last = band + 1 == count_;
    const auto end = [&](Vec2 point) {
      if (point.y < low) return Vec2(x_at(edge, low), 0);
      if (!is_last && point.y >= lower_side(band + 1)) {
        return Vec2(x_at(edge, lower_side(band + 1)), height_);
      }
      return point - Vec2(0, low);
    };
    const Vec2 from = end(edge.from);
    const Vec2 to = end(edge.to);
    if (from.x == to.x) return;
    const bool runs_right = from.x < to.x;
    sweep.add(Edge{runs_right ? from : to, runs_right ? to : from,
                   (to.y - from.y) / (to.x - from.x), runs_right ? 1 : -1,
                   edge.is_of_b});
  }

  static constexpr double kLeastSize = 1e-100;  // of a layer with bands [mm]

  std::vector<FullEdge> edges_;
  double height_ = 0;  // of a band
  std::size_t count_ = 1;
  CellLists<std::uint32_t> members_;  // edges of each band
};

}  // namespace

RegionAreas measure_regions(const plane::Contours& a,
                            const plane::Contours& b) {
  Bands bands;
  bands.add(a, false);
  bands.add(b, true);
  return bands.measure();
}

}  // namespace lamina::slicer
