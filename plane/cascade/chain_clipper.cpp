#include "plane/cascade/chain_clipper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace lamina::plane {
namespace {

// Sides keep this distance [mm] from the zone: ten ties and more.
constexpr double kMargin = 1.5e-5;

// The zone's width and height are so many steps, or up to twice as many.
constexpr double kSteps = 16;

// Sides lie at whole steps and this part of one.
constexpr double kSkew = 0.3819660112501051;

// What is nearer to the left or right side than this [mm] counts as beyond, so
// that edges stay wider than a cluster. A chain's end moves by that at most.
constexpr double kLeastWidth = 2 * kClusterWidth;

Box2 rectangle_around(const Box2& zone) {
  Box2 rectangle;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = zone.low[axis] - kMargin;
    const double high = zone.high[axis] + kMargin;
    const double step = std::exp2(std::floor(std::log2((high - low) / kSteps)));
    rectangle.low[axis] = (std::floor(low / step - kSkew) + kSkew) * step;
    rectangle.high[axis] = (std::ceil(high / step - kSkew) + kSkew) * step;
  }
  return rectangle;
}

double width_of(std::span<const Chain> chains, std::span<const Vec2> points) {
  double width = 0;
  for (const Chain& chain : chains) {
    const auto own = chain.points_in(points);
    width += own.back().x - own.front().x;
  }
  return width;
}

// The share of a box that lies in a rectangle.
double share_of(const Box2& box, const Box2& rectangle) {
  double share = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double size = box.high[axis] - box.low[axis];
    const double common = std::min(box.high[axis], rectangle.high[axis]) -
                          std::max(box.low[axis], rectangle.low[axis]);
    if (common < 0) return 0;
    if (common < size) share *= common / size;
  }
  return share;
}

// The point of an edge at an x between its ends or next to one.
Vec2 point_at(double x, const Vec2& from, const Vec2& to) {
  const double t = std::clamp((x - from.x) / (to.x - from.x), 0.0, 1.0);
  return {x, from.y + t * (to.y - from.y)};
}

}  // namespace

void ChainClipper::begin(const LayerChains& layer) {
  old_points_ = layer.points;
  sections_.clear();
  for (const LeafPart& part : leaf_parts(layer))
    sections_.push_back({part, {}});
  std::vector<Box2> boxes(program_.operands.size());
  for (const Section& section : sections_) {
    boxes[section.operand] = section.box;
  }
  const std::vector<Box2> zones = active_zones(program_, boxes);
  double all = 0;
  double within = 0;
  for (Section& section : sections_) {
    const Box2& zone = zones[program_.operands[section.operand].parent];
    section.rectangle = zone.is_empty() ? zone : rectangle_around(zone);
    const double width = width_of(section.chains, old_points_);
    all += width;
    within += width * share_of(section.box, section.rectangle);
  }
  share_within_ = all > 0 ? within / all : 1;
}

LayerChains ChainClipper::clip() {
  points_.clear();
  chains_.clear();
  loops_.clear();
  for (const Section& section : sections_) {
    if (section.rectangle.holds(section.box)) {
      add_chains(section.chains);
      loops_.insert(loops_.end(), section.loops.begin(), section.loops.end());
    } else if (!section.rectangle.is_empty()) {
      clip_section(section);
    }
  }
  return {points_, chains_, loops_};
}

void ChainClipper::clip_section(const Section& section) {
  const Box2& rectangle = section.rectangle;
  // First the loops that stay as they are.
  const auto visit_loops = [&](bool is_inside, const auto& visit) {
    std::size_t first = 0;
    for (const ChainLoop& loop : section.loops) {
      const auto chains = section.chains.subspan(first, loop.chain_count);
      first += loop.chain_count;
      if (rectangle.holds(box_of(chains, old_points_)) == is_inside) {
        visit(loop, chains);
      }
    }
  };
  visit_loops(true, [this](const ChainLoop& loop, const auto& chains) {
    add_chains(chains);
    loops_.push_back(loop);
  });
  // Then all others.
  const std::size_t count_before = chains_.size();
  lower_side_.clear();
  upper_side_.clear();
  visit_loops(false, [&](const ChainLoop&, const auto& chains) {
    for (const Chain& chain : chains) {
      if (!cut_chain(chain.points_in(old_points_), rectangle)) continue;
      const bool is_side = run_.size() == 2 && run_[0].y == run_[1].y;
      const bool is_lower = is_side && run_[0].y == rectangle.low.y;
      if (is_lower || (is_side && run_[0].y == rectangle.high.y)) {
        std::vector<SideChain>& side = is_lower ? lower_side_ : upper_side_;
        side.push_back({run_[0].x, run_[1].x, chain.winding});
      } else {
        add_chain(run_, chain);
      }
    }
  });
  add_side(lower_side_, rectangle.low.y, section.operand);
  add_side(upper_side_, rectangle.high.y, section.operand);
  const std::size_t count = chains_.size() - count_before;
  if (count > 0) loops_.push_back({static_cast<std::uint32_t>(count), 1});
}

// Makes run_ from the part of a chain in the rectangle; false where there is
// none.
bool ChainClipper::cut_chain(std::span<const Vec2> chain,
                             const Box2& rectangle) {
  const double low = rectangle.low.x + kLeastWidth;
  const double high = rectangle.high.x - kLeastWidth;
  if (chain.front().x >= high || chain.back().x <= low) return false;
  const auto is_left = [low](const Vec2& point) { return point.x <= low; };
  const auto is_not_right = [high](const Vec2& point) {
    return point.x < high;
  };
  const auto begin = std::ranges::partition_point(chain, is_left);
  const auto end = std::ranges::partition_point(chain, is_not_right);
  run_.clear();
  if (begin != chain.begin()) {
    run_.push_back(point_at(rectangle.low.x, *std::prev(begin), *begin));
  }
  run_.insert(run_.end(), begin, end);
  if (end != chain.end()) {
    run_.push_back(point_at(rectangle.high.x, *std::prev(end), *end));
  }
  straighten_beyond(rectangle.low.y, -1);
  straighten_beyond(rectangle.high.y, 1);
  return true;
}

// Replaces each part of run_ above (direction 1) or below (-1) the limit.
void ChainClipper::straighten_beyond(double limit, double direction) {
  const auto is_beyond = [&](const Vec2& point) {
    return direction * (point.y - limit) > 0;
  };
  if (std::ranges::none_of(run_, is_beyond)) return;
  // Where an edge passes the limit, if both parts of it are wide enough; else
  // its end beyond.
  const auto pass = [limit](const Vec2& within, const Vec2& beyond) {
    const double t = (limit - within.y) / (beyond.y - within.y);
    const double x = within.x + t * (beyond.x - within.x);
    const bool is_wide = std::abs(x - within.x) > kLeastWidth &&
                         std::abs(beyond.x - x) > kLeastWidth;
    return is_wide ? Vec2(x, limit) : beyond;
  };
  straightened_.clear();
  for (auto it = run_.begin(); it != run_.end();) {
    if (!is_beyond(*it)) {
      straightened_.push_back(*it++);
      continue;
    }
    const auto end = std::find_if_not(it, run_.end(), is_beyond);
    const Vec2 from =
        it == run_.begin() ? Vec2(it->x, limit) : pass(*std::prev(it), *it);
    const Vec2 to = end == run_.end() ? Vec2(std::prev(end)->x, limit)
                                      : pass(*end, *std::prev(end));
    if (to.x - from.x > kLeastWidth) {
      straightened_.push_back(from);
      straightened_.push_back(to);
    } else {
      straightened_.insert(straightened_.end(), it, end);
    }
    it = end;
  }
  run_.swap(straightened_);
}

void ChainClipper::add_chain(std::span<const Vec2> points, const Chain& like) {
  Chain chain = like;
  chain.first_point = static_cast<std::uint32_t>(points_.size());
  chain.point_count = static_cast<std::uint32_t>(points.size());
  points_.insert(points_.end(), points.begin(), points.end());
  chains_.push_back(chain);
}

void ChainClipper::add_chains(std::span<const Chain> chains) {
  for (const Chain& chain : chains) {
    add_chain(chain.points_in(old_points_), chain);
  }
}

// Adds the sum of the chains along a side, or the chains themselves where parts
// of the sum are too narrow for edges.
void ChainClipper::add_side(std::span<const SideChain> side, double y,
                            std::uint32_t operand) {
  side_ends_.clear();
  for (const SideChain& chain : side) {
    side_ends_.push_back({chain.low, chain.winding});
    side_ends_.push_back({chain.high, -chain.winding});
  }
  std::ranges::sort(side_ends_, {}, &SideEnd::x);
  sum_.clear();
  std::int32_t winding = 0;
  for (auto it = side_ends_.begin(); it != side_ends_.end();) {
    const double x = it->x;
    const std::int32_t before = winding;
    for (; it != side_ends_.end() && it->x == x; ++it) winding += it->change;
    if (winding == before) continue;
    if (!sum_.empty() && before != 0) sum_.back().high = x;
    if (winding != 0) sum_.push_back({x, x, winding});
  }
  if (std::ranges::any_of(sum_, [](const SideChain& part) {
        return part.high - part.low <= kLeastWidth;
      })) {
    sum_.assign(side.begin(), side.end());
  }
  for (const SideChain& part : sum_) {
    const Vec2 points[] = {{part.low, y}, {part.high, y}};
    Chain chain;
    chain.operand = operand;
    chain.winding = part.winding > 0 ? 1 : -1;
    for (std::int32_t i = 0; i < std::abs(part.winding); ++i) {
      add_chain(points, chain);
    }
  }
}

}  // namespace lamina::plane
