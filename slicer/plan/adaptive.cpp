#include "slicer/plan/adaptive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "base/diagnostic.h"
#include "csg/boundary/boundary_faces.h"
#include "csg/mesh/box_tree.h"
#include "csg/mesh/vertex_table.h"
#include "plane/tie_distance.h"
#include "slicer/plan/detail/stacking.h"
#include "slicer/plan/orientation.h"

namespace lamina::slicer {
namespace {

// A face that comes into a ply by no more than this does not count [mm].
constexpr double kReach = kTieDistance;

// Plies times plies of the thickest layer: 300 MB and a minute.
constexpr double kMostStates = 3e7;

// Whether a face goes on from a corner upwards, and downwards.
struct Ways {
  bool up = false;
  bool down = false;
};

// previous, next  corners of the contour, which has the face on its left, seen
//                 against the normal
Ways ways_from(const Vec3& corner, const Vec3& previous, const Vec3& next,
               const Vec3& normal) {
  const double before = previous.z - corner.z;
  const double after = next.z - corner.z;
  if (std::abs(before) <= kReach && std::abs(after) <= kReach) {
    const bool is_above = glm::cross(normal, next - corner).z > 0;
    return {is_above, !is_above};
  }
  // Between the edges, on the side where they make less than 180°, nothing is
  // higher or lower than both.
  const bool is_convex =
      glm::dot(glm::cross(corner - previous, next - corner), normal) > 0;
  return {std::max(before, after) > kReach || !is_convex,
          std::min(before, after) < -kReach || !is_convex};
}

// Finds the corners where no face goes on upwards (peaks) or downwards (pits).
//
// Faces are not joined, so corners that are one may differ by rounding.
// Space is cut into cubes; a corner counts in its own cube and in those that it
// nearly touches, so that corners that are one count in the same cubes.
class Corners {
 public:
  void add(const Vec3& corner, Ways ways) {
    const auto bits = static_cast<std::uint8_t>((ways.up ? kUp : 0) |
                                                (ways.down ? kDown : 0));
    const Vec3 first = glm::floor((corner - kReach) / kCube);
    const glm::ivec3 steps(glm::floor((corner + kReach) / kCube) - first);
    for (int x = 0; x <= steps.x; ++x) {
      for (int y = 0; y <= steps.y; ++y) {
        for (int z = 0; z <= steps.z; ++z) note(first + Vec3(x, y, z), bits);
      }
    }
    note(glm::floor(corner / kCube), kHome);
  }

  // Middles of the cubes of peaks and pits, as far as faces are known.
  std::vector<Vec3> ends() const {
    std::vector<Vec3> ends;
    const std::vector<Vec3>& cubes = cubes_.points();
    for (std::size_t i = 0; i < cubes.size(); ++i) {
      const std::uint8_t bits = bits_[i];
      if ((bits & kHome) != 0 && bits != (kUp | kDown | kHome)) {
        ends.push_back((cubes[i] + 0.5) * kCube);
      }
    }
    return ends;
  }

  static constexpr double kCube = 4 * kReach;  // edge length [mm]

 private:
  static constexpr std::uint8_t kUp = 1;
  static constexpr std::uint8_t kDown = 2;
  static constexpr std::uint8_t kHome = 4;  // the cube of a corner itself

  void note(const Vec3& cube, std::uint8_t bits) {
    const std::uint32_t name = cubes_.name(cube);
    if (name == bits_.size()) bits_.push_back(0);
    bits_[name] |= bits;
  }

  csg::VertexTable cubes_;
  std::vector<std::uint8_t> bits_;  // by name
};

// Learns from the faces of the surface how thick layers may be at each ply.
class PlyLimits {
 public:
  PlyLimits(const SurfaceHeights& heights, double unit, double cusp,
            std::uint16_t greatest, std::uint32_t count)
      : bottom_(heights.low),
        unit_(unit),
        cusp_(cusp),
        greatest_(greatest),
        free_plies_(greatest > 1 ? count : 0) {
    plies_.limits.assign(count, greatest);
    plies_.must_part.assign(count + 1, false);
  }

  // Whether a face in the box can change a limit.
  bool is_wanted(const Box3& box) const {
    if (free_plies_ == 0) return false;
    const PlySpan plies = plies_near(box.low.z, box.high.z);
    if (box.high.z - box.low.z <= kReach && plies.end - plies.begin == 2 &&
        plies_.must_part[plies.begin + 1]) {
      return false;
    }
    return is_free(plies);
  }

  // Takes a part of the surface without its corners.
  void take_slope(const Vec3& normal, const Box3& box) {
    const double low = box.low.z;
    const double high = box.high.z;
    if (high - low <= kReach) {
      take_end((low + high) / 2, kReach);
    } else {
      limit(plies_near(low + 2 * kReach, high - 2 * kReach),
            plies_for(std::abs(normal.z)));
    }
  }

  void take(const csg::BoundaryFace& face) {
    const Box3 box = csg::box_of(face);
    if (box.high.z - box.low.z > kReach) {
      for (const auto& contour : face.contours) {
        add_corners(contour, face.normal);
      }
    }
    take_slope(face.normal, box);
  }

  // The most plies of a layer that a facet with this |n_z| comes into.
  std::uint16_t plies_for(double steepness) const {
    // A cusp that is met but for rounding is met.
    constexpr double kRounding = 1e-9;
    const double plies = cusp_ / (steepness * unit_) + kRounding;
    if (!(plies < greatest_)) return greatest_;
    return static_cast<std::uint16_t>(std::max(plies, 1.0));
  }

  // Whether a peak or a pit at this height changes a limit.
  bool is_end_wanted(double z) const { return is_wanted({Vec3(z), Vec3(z)}); }

  const Corners& corners() const { return corners_; }

  Plies finish() {
    for (const Vec3& end : corners_.ends()) take_end(end.z, Corners::kCube);
    return std::move(plies_);
  }

 private:
  struct PlySpan {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };

  void add_corners(const std::vector<Vec3>& contour, const Vec3& normal) {
    const std::size_t count = contour.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3& corner = contour[i];
      if (!is_free(plies_near(corner.z, corner.z))) continue;
      // Booleans leave edges that are too short to have a direction.
      const auto is_apart = [&](std::size_t other) {
        return glm::distance(contour[other % count], corner) > 4 * kReach;
      };
      std::size_t next = i + 1;
      while (next < i + count && !is_apart(next)) ++next;
      std::size_t previous = i + count - 1;
      while (previous > i && !is_apart(previous)) --previous;
      corners_.add(corner, ways_from(corner, contour[previous % count],
                                     contour[next % count], normal));
    }
  }

  // Plies that these heights, extended by kReach at both ends, come into.
  PlySpan plies_near(double low, double high) const {
    const auto count = static_cast<double>(plies_.limits.size());
    const double begin = std::floor((low - kReach - bottom_) / unit_);
    const double end = std::ceil((high + kReach - bottom_) / unit_);
    return {static_cast<std::uint32_t>(std::clamp(begin, 0.0, count)),
            static_cast<std::uint32_t>(std::clamp(end, 0.0, count))};
  }

  bool is_free(PlySpan plies) const {
    return std::any_of(plies_.limits.begin() + plies.begin,
                       plies_.limits.begin() + plies.end,
                       [](std::uint16_t limit) { return limit > 1; });
  }

  void limit(PlySpan plies, std::uint16_t most) {
    for (std::uint32_t i = plies.begin; i < plies.end; ++i) {
      std::uint16_t& limit = plies_.limits[i];
      if (limit <= most) continue;
      limit = most;
      free_plies_ -= most == 1 ? 1 : 0;
    }
  }

  // A flat face, a peak or a pit.
  void take_end(double z, double tolerance) {
    const double place = (z - bottom_) / unit_;
    const double border = std::round(place);
    if (border < 0 || border >= static_cast<double>(plies_.must_part.size())) {
      return;
    }
    if (std::abs(place - border) * unit_ <= tolerance) {
      plies_.must_part[static_cast<std::uint32_t>(border)] = true;
      return;
    }
    const auto ply = static_cast<std::uint32_t>(std::max(place, 0.0));
    if (ply < plies_.limits.size()) limit({ply, ply + 1}, 1);
  }

  const double bottom_;
  const double unit_;
  const double cusp_;
  const std::uint16_t greatest_;
  std::uint32_t free_plies_;  // those whose layers may have more plies
  Plies plies_;
  Corners corners_;
};

// Lets the faces of a surface limit plies, at least cost: those that boxes
// settle, then those that limit most, and upright walls where they matter.
class SurfaceReader {
 public:
  SurfaceReader(csg::BoundaryFinder& finder, PlyLimits& limits)
      : finder_(finder), limits_(limits) {}

  void read() {
    std::vector<csg::OpenFace> open = finder_.take_settled(
        [&](const Box3& box) { return limits_.is_wanted(box); },
        [&](const csg::BoundaryFace& face) { limits_.take(face); });
    const auto upright = std::ranges::stable_partition(
        open, [](const csg::OpenFace& face) { return !is_upright(face); });
    const std::span slopes(open.begin(), upright.begin());
    // In one limit the outermost come first, as the finder found them.
    std::ranges::stable_sort(slopes, {}, [&](const csg::OpenFace& face) {
      return limits_.plies_for(std::abs(face.normal.z));
    });
    for (const csg::OpenFace& face : slopes) read_slope(face);
    read_upright(upright);
  }

 private:
  void read_slope(const csg::OpenFace& face) {
    if (!limits_.is_wanted(face.box)) return;
    const csg::MeasuredFace measured =
        finder_.measure(face, csg::kManyScanLines);
    if (measured.is_exact) {
      for (const csg::BoundaryPart& part : measured.parts) {
        limits_.take_slope(part.normal, part.box);
      }
      const bool has_corners = std::ranges::any_of(
          measured.parts, [&](const csg::BoundaryPart& part) {
            return limits_.is_wanted(part.box);
          });
      if (!has_corners) return;
    }
    solve(face);
  }

  // An upright wall limits nothing, and no peak or pit is of upright walls
  // alone. But where it goes on from a corner of other faces, upwards and
  // downwards, none is there.
  void read_upright(std::span<const csg::OpenFace> walls) {
    std::vector<Box3> ends;
    for (const Vec3& end : limits_.corners().ends()) {
      if (!limits_.is_end_wanted(end.z)) continue;
      ends.push_back({end - Corners::kCube, end + Corners::kCube});
    }
    const csg::BoxTree tree(ends);
    for (const csg::OpenFace& wall : walls) {
      bool is_met = false;
      tree.visit(
          [&](const Box3& end) {
            return !is_met && csg::do_meet(end, wall.box);
          },
          [&](std::uint32_t) { is_met = true; });
      if (!is_met) continue;
      const csg::MeasuredFace measured =
          finder_.measure(wall, csg::kManyScanLines);
      if (measured.is_exact && measured.parts.empty()) continue;
      solve(wall);
    }
  }

  void solve(const csg::OpenFace& face) {
    finder_.solve(face,
                  [&](const csg::BoundaryFace& part) { limits_.take(part); });
  }

  csg::BoundaryFinder& finder_;
  PlyLimits& limits_;
};

// The number of plies of the thickest layer, where there are `count` of them.
std::uint16_t greatest_multiple(const AdaptiveThickness& thickness,
                                double count) {
  constexpr double kUsual = 4;
  constexpr double kRounding = 1e-9;
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  const double multiple =
      thickness.thickest > 0
          ? thickness.thickest / thickness.thinnest + kRounding
          : kUsual;
  return static_cast<std::uint16_t>(
      std::clamp(std::min(multiple, count), 1.0, kMost));
}

[[noreturn]] void refuse(const SurfaceHeights& heights, double unit) {
  throw GeometryError(
      fmt::format("{} mm are too high for adaptive layers of {} mm or more",
                  heights.high - heights.low, unit));
}

}  // namespace

ldni::LayerGrid adaptive_grid(const csg::Scene& scene,
                              const AdaptiveThickness& thickness) {
  const double unit = thickness.thinnest;
  csg::BoundaryFinder finder(scene);
  const SurfaceHeights heights = surface_heights(scene, finder);
  if (heights.is_empty()) return ldni::LayerGrid::at_heights({});
  // As many as uniform layers.
  const double count =
      std::max(0.0, std::ceil((heights.high - heights.low) / unit - 0.5));
  const std::uint16_t greatest = greatest_multiple(thickness, count);
  if (count * greatest > kMostStates) refuse(heights, unit);
  PlyLimits limits(heights, unit, thickness.cusp, greatest,
                   static_cast<std::uint32_t>(count));
  SurfaceReader(finder, limits).read();
  return ldni::LayerGrid::stacked(
      heights.low, unit,
      stack_layers(limits.finish(), greatest, thickness.most_runs));
}

}  // namespace lamina::slicer
