#include "plane/edge_tree.h"

#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace lamina::plane {
namespace {

// More than rounding can add to a square.
constexpr double kRoundedUp = 1 + 1e-12;

// The square of what distance_to_segment() returns, before its root is rounded.
double squared_distance(Vec2 point, Vec2 from, Vec2 to) {
  const double share = nearest_share(point, from, to);
  const Vec2 away = point - (from + share * (to - from));
  return dot(away, away);
}

}  // namespace

void EdgeTree::fill(const Contours& contours, Bundles bundles) {
  own_points_.clear();
  own_ends_.clear();
  own_points_.reserve(contours.points.size() + contours.loop_count());
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    if (loop.empty()) continue;
    own_points_.insert(own_points_.end(), loop.begin(), loop.end());
    own_points_.push_back(loop.front());
    own_ends_.push_back(static_cast<std::uint32_t>(own_points_.size()));
  }
  // Vertex k is point k, whatever they are of.
  for (std::size_t k = own_vertices_.size(); k < own_points_.size(); ++k) {
    own_vertices_.push_back(static_cast<std::uint32_t>(k));
  }
  points_ = own_points_;
  vertices_ = std::span(own_vertices_).first(own_points_.size());
  ends_ = own_ends_;
  fill(bundles);
}

void EdgeTree::Node::add(const Node& other) {
  low = least(low, other.low);
  high = greatest(high, other.high);
  if (loop == other.loop && loop != kNone) {
    least_step = least(least_step, other.least_step);
    greatest_step = greatest(greatest_step, other.greatest_step);
  } else {
    // The edges do not follow each other: they advance nowhere.
    least_step = both_lanes(-1e300);
    greatest_step = both_lanes(1e300);
    loop = kNone;
  }
}

bool EdgeTree::follow_apart(const Node& a, const Node& b, double reach) const {
  if (a.loop != b.loop || a.loop == kNone) return false;
  Node both = a;
  both.add(b);
  return both.advances(reach);
}

// False where the node's box is apart from it in x, in y or across the segment.
bool EdgeTree::Strip::meets(const Node& node) const {
  if (holds_for_any((node.low > high) | (node.high < low))) return false;
  const Lanes centre = (node.low + node.high) * 0.5 - middle;
  const Lanes half = (node.high - node.low) * 0.5;
  const double across = along.x * centre[1] - along.y * centre[0];
  return std::abs(across) <=
         reach + std::abs(along.x) * half[1] + std::abs(along.y) * half[0];
}

void EdgeTree::fill(std::span<const Vec2> points,
                    std::span<const std::uint32_t> vertices,
                    std::span<const std::uint32_t> ends) {
  points_ = points;
  vertices_ = vertices;
  ends_ = ends;
  fill(Bundles::kShort);
}

void EdgeTree::fill(Bundles bundles) {
  bundles_.clear();
  nodes_.clear();
  bundle_of_.resize(vertices_.size());
  sort_loops();
  for (const auto& [place, loop] : order_) {
    if (bundles == Bundles::kShort) {
      add_bundles(loop);
    } else {
      add_runs(loop);
    }
  }
  build_levels();
}

// Sorts loops by place: into strips in x, and in a strip by y, so that loops
// near each other are mostly neighbours.
void EdgeTree::sort_loops() {
  order_.clear();
  Box2 box;
  for (std::uint32_t l = 0; l < ends_.size(); ++l) {
    order_.push_back({0, l});
    box.add(points_[vertices_[loop_begin(l)]]);
  }
  const Vec2 size = glm::max(box.size(), Vec2(1e-9));
  // Beyond the numbers' range no strip has a width.
  if (order_.size() < 3 || !std::isfinite(size.x + size.y)) return;
  const double strips = std::sqrt(static_cast<double>(order_.size()));
  for (auto& [place, l] : order_) {
    const Vec2 at = (points_[vertices_[loop_begin(l)]] - box.low) / size;
    const auto strip = static_cast<std::uint64_t>(at.x * strips);
    place = strip << 32 | static_cast<std::uint32_t>(at.y * 0x1p31);
  }
  std::ranges::sort(order_);
}

void EdgeTree::add_bundles(std::uint32_t loop) {
  const std::uint32_t last = ends_[loop] - 1;  // the copy of the first vertex
  for (std::uint32_t k = loop_begin(loop); k < last; k += kEdgesPerBundle) {
    const Bundle bundle = {k, std::min(k + kEdgesPerBundle, last), loop};
    nodes_.push_back(measure(bundle));
    add_bundle(bundle);
  }
}

// Upright edges go along with either direction.
void EdgeTree::add_runs(std::uint32_t loop) {
  const std::uint32_t last = ends_[loop] - 1;
  for (std::uint32_t k = loop_begin(loop); k < last;) {
    const Vec2& first = from(k);
    const bool leads_right = to(k).x >= first.x;
    const std::uint32_t farthest = std::min(k + kEdgesPerRun, last);
    double low = first.y;
    double high = first.y;
    std::uint32_t end = k;
    do {
      const double y = to(end++).y;
      low = std::min(low, y);
      high = std::max(high, y);
    } while (end < farthest && (leads_right ? to(end).x >= from(end).x
                                            : to(end).x <= from(end).x));
    Node node;
    node.low = Lanes{std::min(first.x, from(end).x), low};
    node.high = Lanes{std::max(first.x, from(end).x), high};
    node.least_step = both_lanes(-1e300);
    node.greatest_step = both_lanes(1e300);
    node.loop = loop;
    nodes_.push_back(node);
    add_bundle({k, end, loop});
    k = end;
  }
}

void EdgeTree::add_bundle(const Bundle& bundle) {
  std::fill(bundle_of_.begin() + bundle.begin, bundle_of_.begin() + bundle.end,
            static_cast<std::uint32_t>(bundles_.size()));
  bundles_.push_back(bundle);
}

EdgeTree::Node EdgeTree::measure(const Bundle& bundle) const {
  Node node;
  node.loop = bundle.loop;
  const Vec2* point = &points_[vertices_[bundle.begin]];
  const Vec2* last = &points_[vertices_[bundle.end]];
  Lanes before = lanes_of(*point);
  node.low = node.high = before;
  while (point != last) {
    const Lanes here = lanes_of(*++point);
    const Lanes step = here - before;
    node.low = least(node.low, here);
    node.high = greatest(node.high, here);
    node.least_step = least(node.least_step, step);
    node.greatest_step = greatest(node.greatest_step, step);
    before = here;
  }
  return node;
}

void EdgeTree::build_levels() {
  level_begins_.assign(1, 0);
  level_begins_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  while (node_count(top()) > 1) {
    const std::uint32_t begin = level_begins_[top()];
    const std::uint32_t end = level_begins_.back();
    for (std::uint32_t i = begin; i < end; i += 2) {
      Node parent = nodes_[i];
      if (i + 1 < end) parent.add(nodes_[i + 1]);
      nodes_.push_back(parent);
    }
    level_begins_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  }
}

std::size_t EdgeTree::nearest(Vec2 point, std::size_t guess,
                              double enough) const {
  double best = distance(guess, point);
  follow(point, enough, guess, best);
  if (best > enough) lower(point, enough, best, guess);
  return guess;
}

// Follows the loop of the edge, to both sides, as long as it comes nearer.
void EdgeTree::follow(Vec2 point, double enough, std::size_t& edge,
                      double& its_distance) const {
  const std::uint32_t loop = bundles_[bundle_of_[edge]].loop;
  const std::size_t first = loop_begin(loop);
  const std::size_t last = ends_[loop] - 2;
  for (const bool is_forward : {true, false}) {
    while (its_distance > enough) {
      const std::size_t next = is_forward ? (edge == last ? first : edge + 1)
                                          : (edge == first ? last : edge - 1);
      const double there = distance(next, point);
      if (!(there < its_distance)) break;
      its_distance = there;
      edge = next;
    }
  }
}

void EdgeTree::lower(Vec2 point, double enough, double& best,
                     std::size_t& guess) const {
  if (bundles_.empty()) return;
  struct Place {
    double square;  // of the box's distance
    std::size_t level;
    std::uint32_t index;
  };
  const Lanes at = lanes_of(point);
  // Of each level the farther of two is left for later.
  std::array<Place, kMostLevels> open;
  std::size_t count = 0;
  open[count++] = {0, top(), 0};
  while (count > 0) {
    auto [square, level, index] = open[--count];
    for (; level > 0 && square < best * best; --level) {
      index *= 2;
      const Node* const children = &node(level - 1, index);
      square = children[0].squared_distance(at);
      if (index + 1 == node_count(level - 1)) continue;
      double other = children[1].squared_distance(at);
      if (other < square) {
        std::swap(square, other);
        open[count++] = {other, level - 1, index++};
      } else {
        open[count++] = {other, level - 1, index + 1};
      }
    }
    if (!(square < best * best)) continue;
    lower(bundles_[index], point, best, guess);
    if (best <= enough) return;
  }
}

void EdgeTree::lower(const Bundle& bundle, Vec2 point, double& best,
                     std::size_t& guess) const {
  const auto look = [&](std::size_t k) {
    const double here = squared_distance(point, from(k), to(k));
    if (here > kRoundedUp * best * best || std::sqrt(here) >= best) return;
    best = std::sqrt(here);
    guess = k;
  };
  if (bundle.end - bundle.begin <= kEdgesPerBundle) {
    for (std::size_t k = bundle.begin; k < bundle.end; ++k) look(k);
    return;
  }
  // A run: from the edge above or below the point to both sides.
  const bool leads_right = from(bundle.begin).x <= from(bundle.end).x;
  std::size_t middle = bundle.begin;
  for (std::size_t count = bundle.end - bundle.begin; count > 1;) {
    const std::size_t half = count / 2;
    if ((from(middle + half).x <= point.x) == leads_right) middle += half;
    count -= half;
  }
  const auto is_near = [&](std::size_t vertex) {
    return std::abs(from(vertex).x - point.x) < best;
  };
  look(middle);
  for (std::size_t k = middle + 1; k < bundle.end && is_near(k); ++k) look(k);
  for (std::size_t k = middle; k > bundle.begin && is_near(k); --k) look(k - 1);
}

int EdgeTree::winding_number(Vec2 point) const {
  return bundles_.empty() ? 0 : crossings_of(top(), 0, point);
}

// The sum of crossing() over the edges of a node.
int EdgeTree::crossings_of(std::size_t level, std::uint32_t i,
                           Vec2 point) const {
  const Node& node = this->node(level, i);
  if (node.high[0] < point.x || node.low[1] > point.y ||
      node.high[1] <= point.y) {
    return 0;
  }
  const std::uint32_t end = std::min((i + 1) << level, node_count(0));
  const std::uint32_t first = bundles_[i << level].begin;
  const std::uint32_t last = bundles_[end - 1].end;
  if (node.loop != kNone && node.low[0] > point.x) {
    return static_cast<int>(from(first).y <= point.y) -
           static_cast<int>(from(last).y <= point.y);
  }
  int winding = 0;
  if (level == 0) {
    for (std::uint32_t k = first; k < last; ++k) {
      winding += crossing(from(k), to(k), point);
    }
    return winding;
  }
  const std::uint32_t end_child = std::min(2 * i + 2, node_count(level - 1));
  for (std::uint32_t child = 2 * i; child < end_child; ++child) {
    winding += crossings_of(level - 1, child, point);
  }
  return winding;
}

}  // namespace lamina::plane
