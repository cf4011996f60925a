#pragma once
// Random footprints, and the definition of what a packer promises: distances of
// outlines, edge by edge.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/vec.h"
#include "plane/predicates.h"
#include "plane/region/region.h"
#include "slicer/plate/footprint.h"
#include "slicer/plate/packer.h"

namespace lamina::slicer {

// A number from 0 to count - 1.
inline int number(std::mt19937& random, int count) {
  return static_cast<int>(random() % static_cast<unsigned>(count));
}

// A number from 0 to 1.
inline double share(std::mt19937& random) {
  return number(random, 1000) / 999.0;
}

inline plane::Region rectangle(double width, double depth) {
  return {{{{0, 0}, {width, 0}, {width, depth}, {0, depth}}}};
}

// An annulus of that many corners, around a place that is not the origin.
inline plane::Region annulus(double outer, double inner, int corners) {
  plane::Region region;
  region.contours.resize(2);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const Vec2 direction(std::cos(angle), std::sin(angle));
    region.contours[0].push_back(Vec2(3, -5) + outer * direction);
    region.contours[1].insert(region.contours[1].begin(),
                              Vec2(3, -5) + inner * direction);
  }
  return region;
}

// A star-shaped outline whose radius changes from corner to corner.
inline plane::Region random_star(std::mt19937& random, double radius) {
  const int corners = 3 + number(random, 30);
  plane::Region region;
  region.contours.resize(1);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    region.contours[0].push_back(radius * (0.3 + 0.7 * share(random)) *
                                 Vec2(std::cos(angle), std::sin(angle)));
  }
  return region;
}

// Whether each edge has its ends on both sides of the other, more than rounding
// away from it.
inline bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto divides = [](Vec2 from, Vec2 to, Vec2 p, Vec2 q) {
    const Vec2 along = (to - from) / std::sqrt(dot(to - from, to - from));
    const double left = cross(along, p - from);
    const double right = cross(along, q - from);
    return std::min(left, right) < -1e-5 && std::max(left, right) > 1e-5;
  };
  return divides(a, b, c, d) && divides(c, d, a, b);
}

// The distance of two outlines by its definition; less than 0 by the greatest
// depth of a vertex where one is inside the other region, or where edges cross.
inline double brute_distance(const plane::Region& a, const plane::Region& b) {
  double least = 1e300;
  double depth = 0;
  const auto compare = [&](const plane::Region& one, const plane::Region& two) {
    for (const plane::Contour& contour : one.contours) {
      for (const Vec2 p : contour) {
        double nearest = 1e300;
        int windings = 0;
        for (const plane::Contour& other : two.contours) {
          windings += winding_number(other, p);
          for (std::size_t i = 0; i < other.size(); ++i) {
            nearest = std::min(
                nearest, distance_to_segment(p, other[i],
                                             other[(i + 1) % other.size()]));
          }
        }
        least = std::min(least, nearest);
        if (windings != 0) depth = std::max(depth, nearest);
      }
      for (std::size_t i = 0; i < contour.size(); ++i) {
        for (const plane::Contour& other : two.contours) {
          for (std::size_t k = 0; k < other.size(); ++k) {
            if (cross_each_other(contour[i], contour[(i + 1) % contour.size()],
                                 other[k], other[(k + 1) % other.size()])) {
              depth = std::max(depth, 1e-4);
            }
          }
        }
      }
    }
  };
  compare(a, b);
  compare(b, a);
  return depth > 0 ? -depth : least;
}

// What a plan breaks of its promises; empty where it keeps them all.
inline std::string faults_of(std::span<const Piece> pieces, const Plate& plate,
                             const PlatePlan& plan) {
  constexpr double kTie = 1e-5;
  std::vector<std::size_t> copies = plan.left_over;
  if (copies.size() != pieces.size()) return "left_over has another size";
  for (const std::size_t i : plan.too_large) copies[i] += pieces[i].quantity;
  std::vector<plane::Region> placed;
  for (const Placement& one : plan.placements) {
    ++copies[one.piece];
    placed.push_back(
        place(pieces[one.piece].footprint, one.turn_deg, one.shift));
    for (const plane::Contour& contour : placed.back().contours) {
      for (const Vec2 p : contour) {
        const Vec2 low = p - plate.margin;
        const Vec2 high = plate.size - plate.margin - p;
        if (std::min({low.x, low.y, high.x, high.y}) < -kTie) {
          return fmt::format("piece {} leaves the plate", one.piece);
        }
      }
    }
    if (one.plate >= plan.plates) return "a plate is not counted";
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (copies[i] != pieces[i].quantity) {
      return fmt::format("piece {}: {} copies of {}", i, copies[i],
                         pieces[i].quantity);
    }
  }
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (plan.placements[i].plate != plan.placements[k].plate) continue;
      const double distance = brute_distance(placed[i], placed[k]);
      if (distance < plate.gap - kTie) {
        return fmt::format("pieces {} and {} are {} mm apart",
                           plan.placements[i].piece, plan.placements[k].piece,
                           distance);
      }
    }
  }
  return {};
}

}  // namespace lamina::slicer
