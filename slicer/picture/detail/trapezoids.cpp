#include "slicer/picture/detail/trapezoids.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

struct Edge {
  Vec2 low;
  Vec2 high;
  int winding;

  double x_at(double y) const {
    return low.x + (high.x - low.x) * (y - low.y) / (high.y - low.y);
  }
};

// A pair of edges with the solid between them, since `bottom`.
struct Strip {
  std::array<std::uint32_t, 2> sides;  // left, right
  double bottom;
};

class TrapezoidSweep {
 public:
  TrapezoidSweep(const plane::Contours& contours,
                 std::vector<Trapezoid>& trapezoids)
      : trapezoids_(trapezoids) {
    visit_edges(contours, [&](Vec2 from, Vec2 to) { add_edge(from, to); });
    std::ranges::sort(edges_, {}, [](const Edge& edge) { return edge.low.y; });
    strip_of_.assign(edges_.size(), 0);
    std::ranges::sort(heights_);
    heights_.erase(std::unique(heights_.begin(), heights_.end()),
                   heights_.end());
  }

  void run() {
    for (std::size_t i = 0; i + 1 < heights_.size(); ++i) {
      cross(heights_[i], heights_[i + 1]);
    }
    if (!heights_.empty()) replace_strips({}, heights_.back());
  }

 private:
  void add_edge(Vec2 from, Vec2 to) {
    heights_.push_back(from.y);
    if (from.y < to.y) edges_.push_back({from, to, -1});
    if (from.y > to.y) edges_.push_back({to, from, 1});
  }

  // Makes the strips of the next heights, between which nothing begins or ends.
  void cross(double bottom, double top) {
    std::erase_if(active_, [&](const Active& active) {
      return edges_[active.edge].high.y <= bottom;
    });
    const auto stay = static_cast<std::ptrdiff_t>(active_.size());
    for (; next_ < edges_.size() && edges_[next_].low.y <= bottom; ++next_) {
      active_.push_back({static_cast<std::uint32_t>(next_), 0});
    }
    const double middle = (bottom + top) / 2;
    for (Active& active : active_) active.x = edges_[active.edge].x_at(middle);
    const auto first_new = active_.begin() + stay;
    std::sort(first_new, active_.end(), is_left_of);
    std::inplace_merge(active_.begin(), first_new, active_.end(), is_left_of);
    // Contours of a file may cross.
    if (!std::ranges::is_sorted(active_, is_left_of)) {
      std::ranges::sort(active_, is_left_of);
    }

    std::vector<Strip> strips;
    int winding = 0;
    for (const Active& active : active_) {
      const bool was_outside = winding == 0;
      winding += edges_[active.edge].winding;
      if (was_outside) {
        strips.push_back({{active.edge, active.edge}, bottom});
      } else if (winding == 0) {
        strips.back().sides[1] = active.edge;
      }
    }
    replace_strips(std::move(strips), bottom);
  }

  // Ends the strips that do not go on beyond `height`.
  void replace_strips(std::vector<Strip> strips, double height) {
    for (std::uint32_t i = 0; i < strips.size(); ++i) {
      strip_of_[strips[i].sides[0]] = i;
    }
    for (const Strip& old : strips_) {
      const std::uint32_t i = strip_of_[old.sides[0]];
      if (i < strips.size() && strips[i].sides == old.sides) {
        strips[i].bottom = old.bottom;
      } else {
        finish(old, height);
      }
    }
    strips_ = std::move(strips);
  }

  void finish(const Strip& strip, double top) {
    const Edge& left = edges_[strip.sides[0]];
    const Edge& right = edges_[strip.sides[1]];
    trapezoids_.push_back({strip.bottom, top, left.x_at(strip.bottom),
                           right.x_at(strip.bottom), left.x_at(top),
                           right.x_at(top)});
  }

  struct Active {
    std::uint32_t edge;
    double x;
  };
  static bool is_left_of(const Active& a, const Active& b) { return a.x < b.x; }

  std::vector<Edge> edges_;  // by where they begin; level ones left out
  std::vector<double> heights_;
  std::size_t next_ = 0;  // of the edges
  std::vector<Active> active_;
  std::vector<Strip> strips_;
  std::vector<std::uint32_t> strip_of_;  // that each edge was the left side of
  std::vector<Trapezoid>& trapezoids_;
};

}  // namespace

void cut_into_trapezoids(const plane::Contours& contours,
                         std::vector<Trapezoid>& trapezoids) {
  trapezoids.clear();
  TrapezoidSweep(contours, trapezoids).run();
}

}  // namespace lamina::slicer
