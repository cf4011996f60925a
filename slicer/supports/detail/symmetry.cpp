#include "slicer/supports/detail/symmetry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace lamina::slicer::detail {
namespace {

// A curve's facets may fall differently on its two sides [mm].
constexpr double kTolerance = 0.03;

// So many layers are asked, and so many places in each.
constexpr std::size_t kLayers = 24;
constexpr std::size_t kPlaces = 64;

constexpr int kMostTurns = 12;
constexpr double kPi = std::numbers::pi;

Isometry about(Vec2 center, Vec2 x, Vec2 y) {
  return {x, y, center - x * center.x - y * center.y};
}

Isometry turn_by(double angle, Vec2 center) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return about(center, {c, s}, {-s, c});
}

// Reflects in the line through the center with this direction.
Isometry mirror_in(double angle, Vec2 center) {
  const double c = std::cos(2 * angle);
  const double s = std::sin(2 * angle);
  return about(center, {c, s}, {s, -c});
}

// First `b`, then `a`.
Isometry product(const Isometry& a, const Isometry& b) {
  return {a * Vec3(b[0], 0), a * Vec3(b[1], 0), a * Vec3(b[2], 1)};
}

class SymmetryFinder {
 public:
  SymmetryFinder(const LayerSolids& solids,
                 std::span<const MarkedPlaces> marked)
      : solids_(solids) {
    find_center();
    const std::size_t step = (solids.count() + kLayers - 1) / kLayers;
    for (std::size_t i = step / 2; i < solids.count(); i += step) {
      add_places(solids, i);
      for (const MarkedPlaces& one : marked) add_places(one.solids, i);
    }
    // What is far from the center shows a wrong guess first.
    std::ranges::stable_sort(places_, std::greater<>(), [&](const auto& place) {
      return std::round(1e3 * glm::distance(place.at, center_));
    });
  }

  std::vector<Isometry> find() const {
    std::vector<Isometry> group = {turn_by(0, center_)};
    if (places_.empty()) return group;
    int turns = find_turns();
    // What is the same turned by a seventh and by an eleventh is round.
    if (holds(turn_by(2 * kPi / 7, center_)) &&
        holds(turn_by(2 * kPi / 11, center_))) {
      turns = 4;
    }
    for (int k = 1; k < turns; ++k) {
      group.push_back(turn_by(2 * kPi * k / turns, center_));
    }
    if (const auto mirror = find_mirror(turns)) {
      for (int k = 0; k < turns; ++k) {
        group.push_back(
            product(turn_by(2 * kPi * k / turns, center_), *mirror));
      }
    }
    return group;
  }

 private:
  // Vertices, and the middles of edges, which can show an asymmetry that
  // vertices miss.
  void add_places(const LayerSolids& solids, std::size_t i) {
    const plane::Contours& contours = solids.layer(i).contours;
    const std::size_t stride = (contours.points.size() + kPlaces - 1) / kPlaces;
    std::size_t number = 0;
    for (std::size_t l = 0; l < contours.loop_count(); ++l) {
      const auto loop = contours.loop(l);
      Vec2 from = loop.back();
      for (const Vec2& to : loop) {
        if (number++ % stride == 0) {
          places_.push_back({&solids, i, to});
          places_.push_back({&solids, i, (from + to) / 2.0});
        }
        from = to;
      }
    }
  }

  // The center of mass.
  void find_center() {
    Vec2 moment(0);
    double mass = 0;
    for (std::size_t i = 0; i < solids_.count(); ++i) {
      const Layer& layer = solids_.layer(i);
      const double thickness = layer.top - layer.bottom;
      for (std::size_t l = 0; l < layer.contours.loop_count(); ++l) {
        const auto loop = layer.contours.loop(l);
        Vec2 from = loop.back();
        for (const Vec2& to : loop) {
          const double area = thickness * (from.x * to.y - from.y * to.x);
          mass += area;
          moment += area / 3 * (from + to);
          from = to;
        }
      }
    }
    if (mass > 0) center_ = moment / mass;
  }

  bool holds(const Isometry& isometry) const {
    return std::ranges::all_of(places_, [&](const Place& place) {
      const Vec2 image = moved(isometry, place.at);
      return std::abs(place.solids->depth(place.layer, image)) <= kTolerance;
    });
  }

  // The greatest number of equal steps of a full turn.
  int find_turns() const {
    for (int n = kMostTurns; n > 1; --n) {
      if (holds(turn_by(2 * kPi / n, center_))) return n;
    }
    return 1;
  }

  // Mirrors along the axes and through the farthest places are tried, and those
  // halfway between two of them.
  std::optional<Isometry> find_mirror(int turns) const {
    const double step = kPi / turns;
    std::vector<double> angles;
    for (int k = 0; k < 4; ++k) angles.push_back(k * kPi / 4);
    constexpr std::size_t kFarthest = 6;
    for (std::size_t i = 0; i < std::min(kFarthest, places_.size()); ++i) {
      const Vec2 arm = places_[i].at - center_;
      const double angle = std::atan2(arm.y, arm.x);
      angles.push_back(angle);
      angles.push_back(angle + step / 2);
      const Vec2 first = places_[0].at - center_;
      angles.push_back((angle + std::atan2(first.y, first.x)) / 2);
    }
    for (const double angle : angles) {
      const Isometry mirror = mirror_in(angle, center_);
      if (holds(mirror)) return mirror;
    }
    return std::nullopt;
  }

  // On the contours of a layer.
  struct Place {
    const LayerSolids* solids = nullptr;
    std::size_t layer = 0;
    Vec2 at = Vec2(0);
  };

  const LayerSolids& solids_;
  Vec2 center_ = Vec2(0);
  std::vector<Place> places_;
};

}  // namespace

std::vector<Isometry> find_symmetries(const LayerSolids& solids,
                                      std::span<const MarkedPlaces> marked) {
  return SymmetryFinder(solids, marked).find();
}

}  // namespace lamina::slicer::detail
