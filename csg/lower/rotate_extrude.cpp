// rotate_extrude: the outline of the lofts is the circle, the region's
// contours are the profiles.
//
// A contour apart from the axis gives a torus-like loft with a closed
// profile. One that touches the axis falls into runs between points on the
// axis; the edges along the axis sweep nothing. Each run is an open profile
// with an apex at both ends, a solid of its own or, where the run has the
// region on its other side, a cavity in one.

#include <algorithm>
#include <cmath>
#include <memory>

#include "csg/degrees.h"
#include "csg/limits.h"
#include "csg/lower/detail/extrude.h"
#include "plane/loop_area.h"
#include "plane/region/triangulate.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using plane::Region;

// The direction of the point (1, 0) of the profile, turned from +x by an angle
// and then back by another. OpenSCAD 2021.01 counts from +y clockwise; its bits
// come from that.
Vec2 direction(double angle_deg, double back_deg) {
  const double clockwise = 90 - angle_deg + back_deg;
  return {sin_deg(clockwise), cos_deg(clockwise)};
}

// side  +1 for profiles at x ≥ 0, -1 for those at x ≤ 0
std::shared_ptr<const std::vector<Vec2>> full_turn(double start_deg,
                                                   int fragments, double side) {
  std::vector<Vec2> circle;
  for (int i = 0; i < fragments; ++i) {
    // Counter-clockwise: OpenSCAD's order reversed.
    const int j = (fragments - i) % fragments;
    circle.push_back(side * direction(start_deg, j * 360.0 / fragments));
  }
  return std::make_shared<const std::vector<Vec2>>(std::move(circle));
}

// The contour with x ≥ 0, what lies on the axis exactly on it, direction kept
// as a region's (outer contours counter-clockwise).
std::vector<Vec2> to_profile(const Contour& contour, double side) {
  std::vector<Vec2> profile;
  for (const Vec2 point : contour) {
    profile.push_back({std::max(side * point.x, 0.0), point.y});
  }
  if (side < 0) std::reverse(profile.begin(), profile.end());
  return profile;
}

class FullTurn {
 public:
  FullTurn(double start_deg, int fragments, double side)
      : circle_(full_turn(start_deg, fragments, side)) {}

  void add(const std::vector<Vec2>& profile) {
    const auto on_axis = [](Vec2 point) { return point.x == 0; };
    const auto first = std::find_if(profile.begin(), profile.end(), on_axis);
    if (first == profile.end()) return add_loft(profile, true);

    // Begin on the axis and cut at every further point on it.
    std::vector<Vec2> turned(first, profile.end());
    turned.insert(turned.end(), profile.begin(), first);
    turned.push_back(turned.front());
    std::size_t begin = 0;
    for (std::size_t end = 1; end < turned.size(); ++end) {
      if (!on_axis(turned[end])) continue;
      if (end > begin + 1) {
        add_loft({turned.begin() + static_cast<std::ptrdiff_t>(begin),
                  turned.begin() + static_cast<std::ptrdiff_t>(end) + 1},
                 false);
      }
      begin = end;
    }
  }

  Leaf take() { return std::move(leaf_); }

 private:
  void add_loft(std::vector<Vec2> profile, bool is_closed) {
    const bool is_cavity = sliver_area(profile) < 0;
    if (is_cavity) std::reverse(profile.begin(), profile.end());
    leaf_.lofts.push_back({circle_, std::move(profile), is_closed, is_cavity});
  }

  std::shared_ptr<const std::vector<Vec2>> circle_;
  Leaf leaf_;
};

class PartTurn {
 public:
  PartTurn(const Region& region, double start_deg, double angle_deg,
           int fragments)
      : region_(region),
        start_deg_(start_deg),
        angle_deg_(angle_deg),
        fragments_(fragments) {}

  // is_mirrored  the profile is turned so that surfaces come out inside out
  Mesh extrude(bool is_mirrored) {
    for (const Contour& contour : region_.contours) add_sides(contour);
    add_ends();
    if (is_mirrored) {
      for (auto& t : mesh_.triangles) std::swap(t[1], t[2]);
    }
    return std::move(mesh_);
  }

 private:
  // Vertices of one contour: ring by ring, but once for a point on the axis.
  void add_sides(const Contour& contour) {
    std::vector<std::vector<std::uint32_t>> columns;
    for (const Vec2 point : contour) columns.push_back(add_column(point));
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const auto& here = columns[i];
      const auto& next = columns[(i + 1) % contour.size()];
      for (std::size_t j = 0; j + 1 < here.size(); ++j) {
        add_triangle(here[j], next[j + 1], next[j]);
        add_triangle(here[j], here[j + 1], next[j + 1]);
      }
    }
  }

  std::vector<std::uint32_t> add_column(Vec2 point) {
    std::vector<std::uint32_t> column;
    for (int j = 0; j <= fragments_; ++j) {
      if (j == 0 || point.x != 0) {
        const Vec2 d = direction(start_deg_, -(j * angle_deg_ / fragments_));
        mesh_.vertices.push_back({point.x * d.x, point.x * d.y, point.y});
      }
      column.push_back(static_cast<std::uint32_t>(mesh_.vertices.size() - 1));
    }
    first_ring_.push_back(column.front());
    last_ring_.push_back(column.back());
    return column;
  }

  void add_ends() {
    for (const auto& t : plane::triangulate(region_)) {
      add_triangle(first_ring_[t[0]], first_ring_[t[1]], first_ring_[t[2]]);
      add_triangle(last_ring_[t[0]], last_ring_[t[2]], last_ring_[t[1]]);
    }
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }

  const Region& region_;
  const double start_deg_;
  const double angle_deg_;
  const int fragments_;
  Mesh mesh_;
  std::vector<std::uint32_t> first_ring_;
  std::vector<std::uint32_t> last_ring_;
};

}  // namespace

Region put_on_axis(Region region) {
  constexpr double kAxisDistance = 1e-8;
  for (Contour& contour : region.contours) {
    for (Vec2& point : contour) {
      if (std::abs(point.x) < kAxisDistance) point.x = 0;
    }
  }
  return region;
}

bool ProfileRange::crosses_axis() const {
  // What is lost when the other side is added does not count, as in OpenSCAD.
  return high - low > high && high - low > std::abs(low);
}

ProfileRange profile_range(const Region& region) {
  ProfileRange range;
  for (const Contour& contour : region.contours) {
    for (const Vec2 point : contour) {
      range.low = std::min(range.low, point.x);
      range.high = std::max(range.high, point.x);
    }
  }
  return range;
}

Leaf extrude_around(const Region& region, double start_deg, double angle_deg,
                    int fragments) {
  const ProfileRange range = profile_range(region);
  const double side = range.high >= -range.low ? 1 : -1;
  if (angle_deg == 360) {
    FullTurn turn(start_deg, fragments, side);
    for (const Contour& contour : region.contours) {
      turn.add(to_profile(contour, side));
    }
    return turn.take();
  }
  const auto points = static_cast<double>(plane::corner_count(region));
  require_triangles(2 * points * fragments);
  Leaf leaf;
  leaf.meshes.push_back(PartTurn(region, start_deg, angle_deg, fragments)
                            .extrude((angle_deg < 0) != (side < 0)));
  // One facet for half a turn or more reaches beyond the axis.
  leaf.may_overlap_itself = std::abs(angle_deg) / fragments >= 180;
  return leaf;
}

}  // namespace lamina::csg
