#include "slicer/casting/sprue_plan.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <set>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/text.h"

namespace lamina::slicer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A sprue ends in a ball as large as the thickest of its pool, but for this
// share: then the way between is as thick, and find_pools() lets pass more.
constexpr double kFeeding = 0.94;
// Where none such has a way out that nobody sees, one sprue ends in smaller
// balls of the thickest pool.
constexpr std::array kSmaller = {0.8, 0.65, 0.5};
// So many balls of a pool are tried, in so many directions.
constexpr std::size_t kMostEnds = 24;
constexpr std::size_t kDirections = 192;

// A rod leaves the piece by this share of the way that it goes, at least, until
// it is kClearance from it [mm]: at 45° or steeper.
constexpr double kLeastRise = 0.7;
constexpr double kClearance = 1;
// It comes out of the piece within so many radii of its ball.
constexpr double kMostInside = 2.5;
// The way is looked at in steps of this share of its radius, and once for so
// many of them where nothing is near: as far as this share of doubt lets one
// know quickly.
constexpr double kStep = 0.5;
constexpr double kStepsAhead = 6;
constexpr double kDoubt = 0.2;

// Of the box of all sprues, to count their volume. Balls of 24 or 32 sides are
// as large as round ones whose radius is this share of theirs.
constexpr double kVolumeCells = 1e6;
constexpr double kFacetShare = 0.99;

double cone_volume(double length, double d1, double d2) {
  return std::numbers::pi / 12 * length * (d1 * d1 + d1 * d2 + d2 * d2);
}

// Where a root may be: beyond the piece in a direction.
struct Side {
  Vec3 direction = Vec3(0);   // unit length
  double reach = -kInfinity;  // of the piece that way [mm]
};

Box3 box_of(const Ball& ball) {
  return {ball.centre - ball.radius, ball.centre + ball.radius};
}

// As they are written.
Ball written_ball(Vec3 middle, double diameter) {
  return {middle, kFacetShare * diameter / 2};
}
Ball gate_of(const Sprue& sprue) {
  return written_ball(sprue.gate, sprue.diameter);
}
Ball end_of(const Sprue& sprue) {
  return written_ball(sprue.end, sprue.thickness);
}

// Whether a place is in the hull of two balls: in one of those between them.
bool is_in_rod(Vec3 place, const Ball& a, const Ball& b) {
  const Vec3 between = b.centre - a.centre;
  const double length = glm::length(between);
  const double growth = (b.radius - a.radius) / length;
  if (std::abs(growth) >= 1) {  // one holds the other
    const Ball& larger = growth > 0 ? b : a;
    return glm::distance(place, larger.centre) <= larger.radius;
  }
  const Vec3 along = between / length;
  const double forward = glm::dot(place - a.centre, along);
  const double aside = glm::distance(place, a.centre + forward * along);
  // The ball that reaches farthest there.
  const double at = std::clamp(
      forward + growth * aside / std::sqrt(1 - growth * growth), 0.0, length);
  return glm::distance(place, a.centre + at * along) <= a.radius + growth * at;
}

// Directions that are spread over the sphere evenly: Vogel's spiral.
std::vector<Vec3> directions() {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> all = {{0, 0, -1}, {0, 0, 1},  {0, -1, 0},
                           {0, 1, 0},  {-1, 0, 0}, {1, 0, 0}};
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double z = 1 - (2.0 * static_cast<double>(i) + 1) / kDirections;
    const double r = std::sqrt(1 - z * z);
    const double turn = golden * static_cast<double>(i);
    all.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return all;
}

// What has to be fed, and the balls in which a sprue for it may end.
struct Target {
  Pool pool;
  std::vector<Ball> ends;
};

// A straight way out of a ball.
struct Way {
  Vec3 exit = Vec3(0);
  Vec3 gate = Vec3(0);
  std::uint32_t instance = 0;  // of the surface there
  bool is_seen = false;
};

std::vector<SurfacePoint> seen_points(
    std::span<const SurfacePoint> points,
    const std::function<bool(std::uint32_t)>& is_visible) {
  std::vector<SurfacePoint> seen;
  for (const SurfacePoint& point : points) {
    if (is_visible(point.instance)) seen.push_back(point);
  }
  return seen;
}

struct Choice {
  double cost = kInfinity;
  Vec3 root = Vec3(0);
  Vec3 direction = Vec3(0);
  std::vector<Sprue> sprues = {};
};

class SpruePlanner {
 public:
  SpruePlanner(const SolidSamples& samples, const BallFinder& balls,
               const ThicknessField& field, const SprueSizes& sizes,
               const std::function<bool(std::uint32_t)>& is_visible)
      : samples_(samples),
        balls_(balls),
        field_(field),
        sizes_(sizes),
        seen_(seen_points(samples.points, is_visible)),
        seen_balls_(seen_) {}

  std::optional<SpruePlan> plan() {
    const std::vector<Pool> pools = pools_to_feed();
    if (pools.empty()) return std::nullopt;
    find_sides();
    if (auto plan = feed(pools)) return plan;
    // A smaller place that nobody sees does not feed, but is what goldsmiths
    // choose then.
    for (const double share : kSmaller) {
      if (auto plan = try_pools({pools.data(), 1}, share)) return plan;
    }
    allows_seen_ = true;
    return feed(pools);
  }

 private:
  void find_sides() {
    for (const Vec3 direction : directions()) sides_.push_back({direction});
    for_each_index(sides_.size(), [&](std::size_t i) {
      Side& side = sides_[i];
      for (const SurfacePoint& point : samples_.points) {
        side.reach =
            std::max(side.reach, glm::dot(point.place, side.direction));
      }
    });
  }

  // The thickest first, then by volume.
  std::vector<Pool> pools_to_feed() const {
    std::vector<Pool> pools = find_pools(samples_, balls_, field_, {});
    // The thickest is the one that is fed without a gate.
    std::ranges::stable_partition(pools,
                                  [](const Pool& pool) { return pool.is_fed; });
    double whole = 0;
    for (const Pool& pool : pools) whole += pool.volume;
    std::vector<Pool> wanted;
    for (const Pool& pool : pools) {
      const bool counts =
          wanted.empty() || pool.volume >= kLeastFedShare * whole;
      if (counts && wanted.size() < kMostSprues) wanted.push_back(pool);
    }
    return wanted;
  }

  // Of pools that cannot be fed together the smallest are left.
  std::optional<SpruePlan> feed(std::span<const Pool> pools) {
    for (std::size_t count = pools.size(); count > 0; --count) {
      if (auto plan = try_pools(pools.first(count), kFeeding)) return plan;
    }
    return std::nullopt;
  }

  // share  of a pool's thickness that the place where a sprue ends has at least
  std::optional<SpruePlan> try_pools(std::span<const Pool> pools,
                                     double share) {
    targets_.clear();
    double widest = 0;
    for (const Pool& pool : pools) {
      targets_.push_back({pool, ends_of(pool, share)});
      for (const Ball& end : targets_.back().ends) {
        widest = std::max(widest, 2 * kGateShare * end.radius);
      }
    }
    root_diameter_ = sizes_.root > 0 ? sizes_.root : kRootShare * widest;
    const Choice choice = choose();
    if (choice.cost == kInfinity) return std::nullopt;
    return finish(choice);
  }

  // Balls about as large as that of the pool, which one can reach from there
  // without coming through a thinner place.
  std::vector<Ball> ends_of(const Pool& pool, double share) const {
    const SolidCells& cells = samples_.cells;
    const double least = share * pool.thickness / 2;
    std::vector<SolidCells::Index> found;
    std::set<std::uint32_t> seen;
    std::queue<SolidCells::Index> next;
    const auto visit = [&](const SolidCells::Index& index) {
      const auto cell = cells.find(index);
      if (!cell || field_.radii[*cell] < least) return;
      if (!seen.insert(*cell).second) return;
      next.push(index);
      found.push_back(index);
    };
    visit(cells.index_at(pool.place));
    while (!next.empty()) {
      const SolidCells::Index at = next.front();
      next.pop();
      for (int i = 0; i < 27; ++i) {
        visit({at.x + i / 9 - 1, at.y + i / 3 % 3 - 1, at.z + i % 3 - 1});
      }
    }
    std::vector<Ball> ends = {balls_.climb(pool.place, 2 * cells.pitch())};
    const std::size_t step = std::max<std::size_t>(1, found.size() / kMostEnds);
    for (std::size_t i = 0; i < found.size(); i += step) {
      const Ball ball =
          balls_.climb(cells.middle_of(found[i]), 2 * cells.pitch());
      if (ball.radius >= least) ends.push_back(ball);
    }
    return ends;
  }

  bool is_inside(Vec3 place) const {
    return samples_.cells.find(samples_.cells.index_at(place)).has_value();
  }

  // The straight way from a ball to the root, if it gets out at once, where it
  // may, and stays away from the piece then.
  std::optional<Way> way_out(const Ball& end, Vec3 root) const {
    const double length = glm::distance(end.centre, root);
    const Vec3 along = (root - end.centre) / length;
    double out = end.radius;
    while (is_inside(end.centre + out * along)) {
      out += samples_.pitch;
      if (out > kMostInside * end.radius + samples_.pitch) return std::nullopt;
    }
    const double ball = kGateShare * end.radius;
    Way way;
    way.exit = end.centre + out * along;
    way.is_seen = seen_balls_.nearest(way.exit, ball).has_value();
    if (way.is_seen && !allows_seen_) return std::nullopt;
    if (!is_clear(end, root, out)) return std::nullopt;
    way.gate = way.exit + (1 - kGateDepth) * ball * along;
    if (is_met_ahead(way.gate, ball, along)) return std::nullopt;
    if (const auto nearest = balls_.nearest(way.exit, kInfinity)) {
      way.instance = samples_.points[nearest->point].instance;
    }
    return way;
  }

  // Whether a rod from a ball to the root stays away from the piece that it
  // leaves where it is `out` long.
  bool is_clear(const Ball& end, Vec3 root, double out) const {
    const double length = glm::distance(end.centre, root);
    const Vec3 along = (root - end.centre) / length;
    const double step = kStep * std::max(end.radius, samples_.pitch);
    const double slack = 2 * samples_.pitch;
    double empty = 0;  // no point is nearer to where the rod is
    for (double s = out + step; s < length; s += step) {
      const Vec3 place = end.centre + s * along;
      empty -= step;
      const double radius =
          glm::mix(kGateShare * end.radius, root_diameter_ / 2, s / length);
      const double wanted =
          std::min(kLeastRise * (s - out) - slack, radius + kClearance);
      if (wanted <= 0) continue;
      if (is_inside(place)) return false;
      if (wanted <= empty) continue;
      const double ahead = wanted + kStepsAhead * step;
      const auto nearest = balls_.nearest(place, ahead, kDoubt);
      empty = nearest ? nearest->distance / (1 + kDoubt) : ahead;
      if (empty < wanted && balls_.nearest(place, wanted)) return false;
    }
    return true;
  }

  // Whether a ball meets the piece with its half that looks away from it.
  bool is_met_ahead(Vec3 middle, double radius, Vec3 along) const {
    return std::ranges::any_of(
        balls_.points_within(middle, radius), [&](std::uint32_t point) {
          return glm::dot(samples_.points[point].place - middle, along) > 0;
        });
  }

  double volume_to(Vec3 root, const Ball& end) const {
    return cone_volume(glm::distance(end.centre, root),
                       2 * kGateShare * end.radius, root_diameter_);
  }

  // The cheapest sprue from a target to the root, if it costs less than
  // `limit`; `cost` grows by what it costs.
  std::optional<Sprue> sprue_to(const Target& target, Vec3 root, double limit,
                                double& cost) const {
    std::vector<std::pair<double, std::size_t>> by_volume;
    for (std::size_t i = 0; i < target.ends.size(); ++i) {
      const double volume = volume_to(root, target.ends[i]);
      if (cost + volume < limit) by_volume.emplace_back(volume, i);
    }
    std::ranges::sort(by_volume);
    for (const auto& [volume, i] : by_volume) {
      const Ball& end = target.ends[i];
      const auto way = way_out(end, root);
      if (!way) continue;
      cost += volume;
      return Sprue{.end = end.centre,
                   .thickness = 2 * end.radius,
                   .exit = way->exit,
                   .gate = way->gate,
                   .diameter = 2 * kGateShare * end.radius,
                   .feeds = target.pool.volume,
                   .instance = way->instance,
                   .is_seen = way->is_seen};
    }
    return std::nullopt;
  }

  // What costs less than `limit`, if anything does.
  Choice try_root(Vec3 root, Vec3 direction, double limit) const {
    Choice choice{.cost = 0, .root = root, .direction = direction};
    for (const Target& target : targets_) {
      const auto sprue = sprue_to(target, root, limit, choice.cost);
      if (!sprue) return {};
      choice.sprues.push_back(*sprue);
    }
    return choice;
  }

  // The cheapest towards a side, if it costs no more than the cheapest so far
  // of all, which it lowers.
  Choice choose_at(const Side& side, std::atomic<double>& least) const {
    const Vec3 direction = side.direction;
    const double height = side.reach + sizes_.length + root_diameter_ / 2;
    std::vector<Vec3> middles;
    for (const Ball& end : targets_.front().ends) {
      middles.push_back(end.centre);
    }
    if (targets_.size() > 1) {
      Vec3 sum(0);
      for (const Target& target : targets_) sum += target.pool.place;
      middles.push_back(sum / static_cast<double>(targets_.size()));
    }
    Choice best;
    for (const Vec3 middle : middles) {
      const Vec3 root =
          middle + (height - glm::dot(middle, direction)) * direction;
      // Of equal ones that of the first side counts.
      const double limit =
          std::min(best.cost, std::nextafter(least.load(), kInfinity));
      Choice choice = try_root(root, direction, limit);
      if (choice.cost < best.cost) best = std::move(choice);
      double known = least;
      while (best.cost < known &&
             !least.compare_exchange_weak(known, best.cost)) {
      }
    }
    return best;
  }

  Choice choose() const {
    std::vector<Choice> choices(sides_.size());
    std::atomic<double> least = kInfinity;
    for_each_index(sides_.size(), [&](std::size_t i) {
      choices[i] = choose_at(sides_[i], least);
    });
    return *std::ranges::min_element(choices, {}, &Choice::cost);
  }

  SpruePlan finish(const Choice& choice) const {
    SpruePlan plan;
    plan.root = choice.root;
    plan.root_diameter = root_diameter_;
    plan.direction = choice.direction;
    plan.has_disc = sizes_.has_disc;
    plan.sprues = choice.sprues;
    std::vector<Gate> gates;
    for (const Sprue& sprue : plan.sprues) gates.push_back({sprue.end, 0});
    plan.unfed = unfed_of(find_pools(samples_, balls_, field_, gates));
    plan.volume = volume_outside(plan);
    return plan;
  }

  // What the written sprues add to the piece.
  double volume_outside(const SpruePlan& plan) const {
    const Ball root = written_ball(plan.root, plan.root_diameter);
    Box3 box = box_of(root);
    for (const Sprue& sprue : plan.sprues) {
      box.add(box_of(gate_of(sprue)));
      box.add(box_of(end_of(sprue)));
    }
    const double disc = kDiscShare * plan.root_diameter / 2;
    if (plan.has_disc) box.add(box_of({plan.root, disc}));
    const auto holds = [&](Vec3 place) {
      if (plan.has_disc) {
        const Vec3 offset = place - plan.root;
        const double down = glm::dot(offset, plan.direction);
        const double below = plan.root_diameter / 2 - down;
        if (below >= 0 && below <= kDiscThickness &&
            glm::length(offset - down * plan.direction) <= disc) {
          return true;
        }
      }
      return std::ranges::any_of(plan.sprues, [&](const Sprue& sprue) {
        return is_in_rod(place, root, gate_of(sprue)) ||
               is_in_rod(place, gate_of(sprue), end_of(sprue));
      });
    };
    const Vec3 size = box.size();
    const double pitch = std::cbrt(size.x * size.y * size.z / kVolumeCells);
    std::size_t count = 0;
    for (double x = box.low.x + pitch / 2; x < box.high.x; x += pitch) {
      for (double y = box.low.y + pitch / 2; y < box.high.y; y += pitch) {
        for (double z = box.low.z + pitch / 2; z < box.high.z; z += pitch) {
          const Vec3 place(x, y, z);
          if (holds(place) && !is_inside(place)) ++count;
        }
      }
    }
    return static_cast<double>(count) * pitch * pitch * pitch;
  }

  const SolidSamples& samples_;
  const BallFinder& balls_;
  const ThicknessField& field_;
  const SprueSizes sizes_;
  const std::vector<SurfacePoint> seen_;  // of the surface that is visible
  const BallFinder seen_balls_;
  std::vector<Side> sides_;
  std::vector<Target> targets_;  // the thickest first, then by volume
  double root_diameter_ = 0;     // [mm]
  bool allows_seen_ = false;
};

}  // namespace

std::vector<Pool> unfed_of(std::vector<Pool> pools) {
  double whole = 0;
  for (const Pool& pool : pools) whole += pool.volume;
  std::erase_if(pools, [&](const Pool& pool) {
    return pool.is_fed || pool.volume < kLeastUnfedShare * whole;
  });
  return pools;
}

std::string unfed_text(std::span<const Pool> pools) {
  if (pools.empty()) return {};
  double volume = 0;
  for (const Pool& pool : pools) volume += pool.volume;
  const Pool& most = pools.front();
  return fmt::format(
      "not fed but through thinner places: {} of {:.3g} mm³ in all, the "
      "largest {:.2f} mm thick at {} by way of {:.2f} mm",
      counted(pools.size(), "place"), volume, most.thickness,
      place_text(most.place), most.neck_thickness);
}

std::string size_text(const SpruePlan& plan) {
  std::string text = fmt::format("{}, root {:.2f} mm wide, {:.3g} mm³",
                                 counted(plan.sprues.size(), "sprue"),
                                 plan.root_diameter, plan.volume);
  const std::string unfed = unfed_text(plan.unfed);
  return unfed.empty() ? text : text + "; " + unfed;
}

std::optional<SpruePlan> plan_sprues(
    const SolidSamples& samples, const BallFinder& balls,
    const ThicknessField& field, const SprueSizes& sizes,
    const std::function<bool(std::uint32_t instance)>& is_visible) {
  return SpruePlanner(samples, balls, field, sizes, is_visible).plan();
}

}  // namespace lamina::slicer
