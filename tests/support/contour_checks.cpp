#include "tests/support/contour_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <span>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "tests/support/edge_grid.h"

namespace lamina::support {
namespace {

using Kind = ContourDefect::Kind;
using Loop = std::span<const Vec2>;

// A broken layer can have as many defects as edges; nobody reads them all.
constexpr std::size_t kMostDefects = 300;

double length(Vec2 a) { return std::hypot(a.x, a.y); }

// Distance of `point` from the line through `from` and `to`, positive on its
// left; from the point itself where the two coincide.
double line_distance(Vec2 from, Vec2 to, Vec2 point) {
  const Vec2 along = to - from;
  const double size = length(along);
  if (size == 0) return length(point - from);
  return cross(along, point - from) / size;
}

double segment_distance(const Edge& edge, Vec2 point) {
  const Vec2 along = edge.to - edge.from;
  const Vec2 offset = point - edge.from;
  const double squared = along.x * along.x + along.y * along.y;
  double share = 0;
  if (squared > 0) {
    share = (offset.x * along.x + offset.y * along.y) / squared;
    share = std::clamp(share, 0.0, 1.0);
  }
  return length(offset - share * along);
}

enum class Meeting { kApart, kTouch, kOverlap, kCross };

// Length over which the projections of two nearly parallel edges on the first
// one overlap.
double shared_length(const Edge& a, const Edge& b) {
  const Vec2 along = a.to - a.from;
  const double size = length(along);
  const auto project = [&](Vec2 p) {
    const Vec2 offset = p - a.from;
    return (offset.x * along.x + offset.y * along.y) / size;
  };
  const double s = project(b.from);
  const double t = project(b.to);
  return std::min(size, std::max(s, t)) - std::max(0.0, std::min(s, t));
}

Meeting meeting_of(const Edge& a, const Edge& b, double touch) {
  const double b_from = line_distance(a.from, a.to, b.from);
  const double b_to = line_distance(a.from, a.to, b.to);
  const double a_from = line_distance(b.from, b.to, a.from);
  const double a_to = line_distance(b.from, b.to, a.to);
  const auto is_split = [&](double s, double t) {
    return (s > touch && t < -touch) || (s < -touch && t > touch);
  };
  if (is_split(b_from, b_to) && is_split(a_from, a_to)) return Meeting::kCross;

  const double distance = std::min(
      std::min(segment_distance(a, b.from), segment_distance(a, b.to)),
      std::min(segment_distance(b, a.from), segment_distance(b, a.to)));
  if (distance > touch) return Meeting::kApart;
  const auto is_along = [&](double s, double t) {
    return std::abs(s) <= touch && std::abs(t) <= touch;
  };
  if ((is_along(b_from, b_to) || is_along(a_from, a_to)) &&
      shared_length(a, b) > 4 * touch) {
    return Meeting::kOverlap;
  }
  return Meeting::kTouch;
}

// Where two edges meet, near enough for a message.
Vec2 meeting_place(const Edge& a, const Edge& b) {
  const Vec2 along_a = a.to - a.from;
  const Vec2 along_b = b.to - b.from;
  const double turn = cross(along_a, along_b);
  if (turn != 0) {
    const double share = cross(b.from - a.from, along_b) / turn;
    return a.from + std::clamp(share, 0.0, 1.0) * along_a;
  }
  return segment_distance(a, b.from) < segment_distance(a, b.to) ? b.from
                                                                 : b.to;
}

// Collects defects of one layer.
class Inspection {
 public:
  Inspection(const plane::Contours& contours, const ContourRules& rules)
      : contours_(contours), rules_(rules) {}

  std::vector<ContourDefect> run() {
    for (std::size_t l = 0; l < contours_.loop_count(); ++l) check_loop(l);
    const auto fatal = [](const ContourDefect& defect) {
      return defect.kind == Kind::kNotFinite ||
             defect.kind == Kind::kTooFewPoints;
    };
    if (std::none_of(defects_.begin(), defects_.end(), fatal)) check_edges();
    return std::move(defects_);
  }

 private:
  bool is_full() const { return defects_.size() >= kMostDefects; }

  void add(Kind kind, std::size_t loop, Vec2 place, const std::string& what) {
    if (is_full()) return;
    const Loop points = contours_.loop(loop);
    defects_.push_back(
        {kind, loop, place,
         fmt::format(
             "loop {} ({} points, area {:.9g}) {} at ({:.12g}, {:.12g})", loop,
             points.size(), signed_area(points), what, place.x, place.y)});
  }

  // Points and area of one loop.
  void check_loop(std::size_t l) {
    const Loop loop = contours_.loop(l);
    for (const Vec2& point : loop) {
      if (std::isfinite(point.x) && std::isfinite(point.y)) continue;
      return add(Kind::kNotFinite, l, point, "has no finite coordinate");
    }
    if (loop.size() < 3) {
      const Vec2 place = loop.empty() ? Vec2(0) : loop[0];
      return add(Kind::kTooFewPoints, l, place, "is no polygon");
    }
    for (std::size_t i = 0; i < loop.size(); ++i) check_point(l, i);
    if (std::abs(signed_area(loop)) < rules_.least_area) {
      add(Kind::kZeroArea, l, loop[0], "has no area");
    }
  }

  void check_point(std::size_t l, std::size_t i) {
    const Loop loop = contours_.loop(l);
    const Vec2 point = loop[i];
    const Vec2 previous = loop[(i + loop.size() - 1) % loop.size()];
    const Vec2 next = loop[(i + 1) % loop.size()];
    if (length(next - point) < rules_.repeat_distance) {
      add(Kind::kRepeatedPoint, l, point, "repeats a point");
    } else if (std::abs(line_distance(previous, next, point)) <
               rules_.collinear_distance) {
      add(Kind::kCollinearPoint, l, point, "has a point on a straight line");
    }
  }

  // Pairs of edges, then nesting.
  void check_edges() {
    edges_ = edges_of(contours_);
    const EdgeGrid grid(edges_, rules_.touch_distance);
    bool is_disjoint = true;
    for (std::size_t c = 0; c < grid.cell_count() && !is_full(); ++c) {
      const auto members = grid.cell(c);
      for (std::size_t i = 0; i < members.size(); ++i) {
        for (std::size_t j = i + 1; j < members.size(); ++j) {
          if (!check_pair(members[i], members[j])) is_disjoint = false;
        }
      }
    }
    if (is_disjoint) check_nesting(grid);
  }

  // False where the two cross or overlap.
  bool check_pair(std::uint32_t i, std::uint32_t j) {
    const Edge& a = edges_[i];
    const Edge& b = edges_[j];
    if (a.next == j || b.next == i) return true;
    if (std::max(a.from.x, a.to.x) + rules_.touch_distance <
            std::min(b.from.x, b.to.x) ||
        std::max(b.from.x, b.to.x) + rules_.touch_distance <
            std::min(a.from.x, a.to.x) ||
        std::max(a.from.y, a.to.y) + rules_.touch_distance <
            std::min(b.from.y, b.to.y) ||
        std::max(b.from.y, b.to.y) + rules_.touch_distance <
            std::min(a.from.y, a.to.y)) {
      return true;
    }
    const Meeting meeting = meeting_of(a, b, rules_.touch_distance);
    const bool is_allowed = meeting == Meeting::kApart ||
                            (meeting == Meeting::kTouch && a.loop != b.loop);
    // A pair shares several cells: report it once.
    if (is_allowed || is_full()) return true;
    const std::uint64_t key =
        (std::uint64_t{std::min(i, j)} << 32) | std::max(i, j);
    if (reported_.insert(key).second) report_meeting(a, b, meeting);
    return meeting == Meeting::kTouch;
  }

  void report_meeting(const Edge& a, const Edge& b, Meeting meeting) {
    const std::string other =
        a.loop == b.loop ? "itself" : fmt::format("loop {}", b.loop);
    const Vec2 place = meeting_place(a, b);
    if (meeting == Meeting::kCross) {
      add(Kind::kCrossing, a.loop, place, "crosses " + other);
    } else if (meeting == Meeting::kOverlap) {
      add(Kind::kOverlap, a.loop, place, "runs along " + other);
    } else {
      add(Kind::kTouchesItself, a.loop, place, "touches itself");
    }
  }

  // Just outside a loop there is solid if and only if it is a hole. Asked on
  // its longest edge, at a share of it where hardly ever another loop touches.
  void check_nesting(const EdgeGrid& grid) {
    std::size_t first = 0;
    for (std::uint32_t l = 0; l < contours_.loop_count(); ++l) {
      const std::size_t end = contours_.ends[l];
      std::size_t longest = first;
      for (std::size_t e = first; e < end; ++e) {
        if (length(edges_[e].to - edges_[e].from) >
            length(edges_[longest].to - edges_[longest].from)) {
          longest = e;
        }
      }
      constexpr double kShare = 0.41421356237309515;
      const Edge& edge = edges_[longest];
      const Vec2 place = edge.from + kShare * (edge.to - edge.from);
      const int around = grid.winding_number(place, l);
      const bool is_outer = signed_area(contours_.loop(l)) > 0;
      if (around != (is_outer ? 0 : 1)) {
        add(Kind::kWrongOrientation, l, place,
            fmt::format("runs {}clockwise where the other loops wind {} times",
                        is_outer ? "counter-" : "", around));
      }
      first = end;
    }
  }

  const plane::Contours& contours_;
  const ContourRules& rules_;
  std::vector<Edge> edges_;
  std::unordered_set<std::uint64_t> reported_;
  std::vector<ContourDefect> defects_;
};

}  // namespace

std::vector<ContourDefect> find_defects(const plane::Contours& contours,
                                        const ContourRules& rules) {
  return Inspection(contours, rules).run();
}

::testing::AssertionResult are_sound(const plane::Contours& contours,
                                     const ContourRules& rules) {
  const auto defects = find_defects(contours, rules);
  if (defects.empty()) return ::testing::AssertionSuccess();
  auto failure = ::testing::AssertionFailure();
  failure << defects.size() << (defects.size() < kMostDefects ? "" : " or more")
          << " defects";
  constexpr std::size_t kShown = 5;
  for (std::size_t i = 0; i < std::min(kShown, defects.size()); ++i) {
    failure << "\n  " << defects[i].message;
  }
  return failure;
}

LoopCounts count_loops(const plane::Contours& contours) {
  LoopCounts counts;
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    ++(signed_area(contours.loop(l)) > 0 ? counts.outer : counts.holes);
  }
  return counts;
}

std::ostream& operator<<(std::ostream& out, const LoopCounts& counts) {
  return out << counts.outer << " outer, " << counts.holes << " holes";
}

int winding_number(const plane::Contours& contours, Vec2 point) {
  int winding = 0;
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    const Loop loop = contours.loop(l);
    Vec2 from = loop.empty() ? Vec2(0) : loop.back();
    for (const Vec2& to : loop) {
      const bool from_above = from.y > point.y;
      if (from_above != (to.y > point.y)) {
        // The edge crosses the point's height: does it do so left of it?
        const double side = cross(to - from, point - from);
        if (from_above ? side > 0 : side < 0) winding += from_above ? 1 : -1;
      }
      from = to;
    }
  }
  return winding;
}

bool contains(const plane::Contours& contours, Vec2 point) {
  return winding_number(contours, point) != 0;
}

double total_area(const plane::Contours& contours) {
  double area = 0;
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    area += signed_area(contours.loop(l));
  }
  return area;
}

double total_perimeter(const plane::Contours& contours) {
  double sum = 0;
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    sum += perimeter(contours.loop(l));
  }
  return sum;
}

namespace {

double distance_to(std::span<const Edge> edges, Vec2 point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges) {
    nearest = std::min(nearest, segment_distance(edge, point));
  }
  return nearest;
}

}  // namespace

double distance_to_edges(const plane::Contours& contours, Vec2 point) {
  return distance_to(edges_of(contours), point);
}

double greatest_distance(const plane::Contours& a, const plane::Contours& b) {
  const auto edges_a = edges_of(a);
  const auto edges_b = edges_of(b);
  double greatest = 0;
  for (const auto& [from, to] :
       {std::pair(&edges_a, &edges_b), std::pair(&edges_b, &edges_a)}) {
    for (const Edge& edge : *from) {
      const Vec2 middle = (edge.from + edge.to) * 0.5;
      greatest = std::max(
          {greatest, distance_to(*to, edge.from), distance_to(*to, middle)});
    }
  }
  return greatest;
}

void add_loop(plane::Contours& contours, const std::vector<Vec2>& points) {
  contours.points.insert(contours.points.end(), points.begin(), points.end());
  contours.ends.push_back(static_cast<std::uint32_t>(contours.points.size()));
}

}  // namespace lamina::support
