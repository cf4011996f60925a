#include "slicer/plan/orientation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "csg/boundary/move_scene.h"
#include "csg/degrees.h"
#include "slicer/plan/detail/surface_sample.h"

namespace lamina::slicer {
namespace {

// Edges that a choice may cut: about 30 ms. Small faces beyond are sampled.
constexpr std::size_t kMostEdges = 150'000;

// What looks down by more than 45° wants supports; 45° but for rounding does
// not.
constexpr double kOverhang = std::numbers::sqrt2 / 2 + 1e-6;

// Sums over the surface for both directions along a coordinate.
struct Sums {
  double steps = 0;  // area · |n| of all faces but flat ones
  double size = 0;   // [mm]
  // Surface that looks down, or up, by more than 45°; and how much is flat and
  // lies as low, or as high, as anything.
  double looks_down = 0;
  double looks_up = 0;
  double lies_low = 0;
  double lies_high = 0;
};

Sums sums_along(int axis, const SurfaceSample& surface) {
  Sums sums;
  const double low = surface.box.low[axis] + kSameLength;
  const double high = surface.box.high[axis] - kSameLength;
  sums.size = surface.box.size()[axis];
  for (const SurfacePart& part : surface.parts) {
    const double normal = part.normal[axis];
    const double area = part.area;
    const bool is_flat = part.box.size()[axis] <= kSameLength;
    if (!is_flat) sums.steps += area * std::abs(normal);
    if (normal < -kOverhang) sums.looks_down += area;
    if (normal > kOverhang) sums.looks_up += area;
    if (!is_flat) continue;
    if (normal < 0 && part.box.low[axis] <= low) sums.lies_low += area;
    if (normal > 0 && part.box.high[axis] >= high) sums.lies_high += area;
  }
  return sums;
}

bool fits(Vec3 size, Vec3 volume) {
  return glm::all(glm::lessThanEqual(size, volume + kSameLength));
}

// The part as it stands, turned by a quarter where it fits only so.
void fit(Orientation& orientation, Vec3 size, Vec3 volume) {
  const Affine turn = turn_to_axis(orientation.axis);
  for (int i = 0; i < 3; ++i) orientation.size += glm::abs(turn[i]) * size[i];
  if (fits(orientation.size, volume)) return;
  std::swap(orientation.size.x, orientation.size.y);
  orientation.fits = fits(orientation.size, volume);
  if (orientation.fits) {
    orientation.turn = 90;
  } else {
    std::swap(orientation.size.x, orientation.size.y);
  }
}

Orientation orientation_along(std::string_view axis,
                              const std::array<Sums, 3>& along,
                              double thickness, Vec3 volume) {
  const bool is_reversed = axis.front() == '-';
  const Sums& sums = along[static_cast<std::size_t>(axis.back() - 'x')];
  Orientation orientation;
  orientation.axis = axis;
  orientation.cusp_error = sums.steps * thickness;
  fit(orientation, {along[0].size, along[1].size, along[2].size}, volume);
  orientation.footing = is_reversed ? sums.lies_high : sums.lies_low;
  const double looks_down = is_reversed ? sums.looks_up : sums.looks_down;
  orientation.overhang = std::max(looks_down - orientation.footing, 0.0);
  return orientation;
}

}  // namespace

Affine turn_to_axis(std::string_view axis, double degrees) {
  const double cosine = csg::cos_deg(degrees);
  const double sine = csg::sin_deg(degrees);
  const Vec3 x(cosine, sine, 0);
  const Vec3 y(-sine, cosine, 0);
  const Vec3 z(0, 0, 1);
  const Vec3 no_shift(0);
  // Columns: where x, y and z of the design go.
  if (axis == "x") return Affine(z, x, y, no_shift);
  if (axis == "y") return Affine(y, z, x, no_shift);
  if (axis == "-x") return Affine(-z, y, x, no_shift);
  if (axis == "-y") return Affine(x, -z, y, no_shift);
  if (axis == "-z") return Affine(x, -y, -z, no_shift);
  return Affine(x, y, z, no_shift);
}

OrientationChoice choose_orientation(const csg::Scene& scene, double thickness,
                                     Vec3 volume) {
  const SurfaceSample surface = sample_surface(scene, kMostEdges);
  std::array<Sums, 3> along;
  if (surface.area > 0) {
    for (int i = 0; i < 3; ++i) {
      along[static_cast<std::size_t>(i)] = sums_along(i, surface);
    }
  }
  OrientationChoice choice;
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    choice.all[i] = orientation_along(kAxes[i], along, thickness, volume);
  }
  std::vector<std::size_t> left = {0, 1, 2, 3, 4, 5};
  const auto keep_best = [&](std::string_view name, double tolerance,
                             const auto& badness) {
    double least = 1e300;
    for (const std::size_t i : left) {
      least = std::min(least, badness(choice.all[i]));
    }
    const std::size_t dropped = std::erase_if(left, [&](std::size_t i) {
      return badness(choice.all[i]) > least + tolerance;
    });
    if (dropped == 0) return;
    choice.reason += choice.reason.empty() ? "" : ", then ";
    choice.reason += name;
  };
  using O = Orientation;
  const double same_area = kSameLength * surface.area + surface.doubt;
  keep_best("what fits", 0, [](const O& o) { return o.fits ? 0. : 1.; });
  keep_best("the least cusp error", same_area * thickness,
            [](const O& o) { return o.cusp_error; });
  keep_best("the least height", kSameLength,
            [](const O& o) { return o.size.z; });
  keep_best("the least overhang", same_area,
            [](const O& o) { return o.overhang; });
  keep_best("the most on the bed", same_area,
            [](const O& o) { return -o.footing; });
  if (choice.reason.empty()) choice.reason = "no other is better";
  choice.best = left.front();
  return choice;
}

Affine turn_upwards(Vec3 up) {
  const Vec3 to = glm::normalize(up);
  const Vec3 axis = glm::cross(to, Vec3(0, 0, 1));
  const double sine = glm::length(axis);
  // Straight up, or straight down: then about x.
  if (sine < 1e-12) return turn_to_axis(to.z > 0 ? "z" : "-z");
  const Vec3 about = axis / sine;
  Affine turn(1.0);
  for (int i = 0; i < 3; ++i) {
    Vec3 unit(0);
    unit[i] = 1;
    // Rodrigues' formula.
    turn[i] = unit * to.z + glm::cross(about, unit) * sine +
              about * (about[i] * (1 - to.z));
  }
  return turn;
}

std::string orientation_table(const OrientationChoice& choice) {
  std::string text = fmt::format("building direction {}: {}\n",
                                 choice.all[choice.best].axis, choice.reason);
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out, "  axis  cusp error mm³  height mm  overhang mm²  on the bed mm²\n");
  for (std::size_t i = 0; i < choice.all.size(); ++i) {
    const Orientation& row = choice.all[i];
    fmt::format_to(out, "{} {:>4} {:>15.4f} {:>10.4f} {:>13.4f} {:>15.4f}",
                   i == choice.best ? '*' : ' ', row.axis, row.cusp_error,
                   row.size.z, row.overhang, row.footing);
    if (!row.fits) text += "  too large";
    if (row.turn != 0) fmt::format_to(out, "  turned by {:g}°", row.turn);
    if (!row.problems.empty())
      fmt::format_to(out, "\n{:7}{}", "", row.problems);
    text += '\n';
  }
  text.pop_back();
  return text;
}

SurfaceHeights surface_heights(const csg::Scene& scene,
                               csg::BoundaryFinder& finder) {
  // Leaves reach beyond the scene's box, the surface does not.
  constexpr double kRounding = 1e-9;  // [mm]
  const double lowest = scene.box.low.z + kRounding;
  const double highest = scene.box.high.z - kRounding;
  SurfaceHeights heights;
  const auto may_be_lowest = [&](const Box3& box) {
    return box.low.z < heights.low && heights.low > lowest;
  };
  const auto may_be_highest = [&](const Box3& box) {
    return box.high.z > heights.high && heights.high < highest;
  };
  const auto take = [&](const Box3& box) {
    heights.low = std::min(heights.low, box.low.z);
    heights.high = std::max(heights.high, box.high.z);
  };
  std::vector<csg::OpenFace> open = finder.take_settled(
      [&](const Box3& box) {
        return may_be_lowest(box) || may_be_highest(box);
      },
      [&](const csg::BoundaryFace& face) { take(csg::box_of(face)); });
  // At the lowest and at the highest point there is a face that is not upright.
  std::erase_if(open, csg::is_upright);
  for (const double sign : {1.0, -1.0}) {
    // The farthest first, and flat faces before others.
    std::ranges::sort(open, {}, [&](const csg::OpenFace& face) {
      const double far = sign > 0 ? face.box.low.z : -face.box.high.z;
      return std::pair(std::max(far, sign > 0 ? lowest : -highest),
                       face.box.size().z);
    });
    for (const csg::OpenFace& face : open) {
      if (sign > 0 ? !may_be_lowest(face.box) : !may_be_highest(face.box)) {
        break;
      }
      const csg::MeasuredFace measured =
          finder.measure(face, csg::kManyScanLines);
      if (measured.is_exact) {
        for (const csg::BoundaryPart& part : measured.parts) take(part.box);
      } else {
        finder.solve(face, [&](const csg::BoundaryFace& part) {
          take(csg::box_of(part));
        });
      }
    }
  }
  return heights;
}

double lowest_point(const csg::Scene& scene) {
  csg::BoundaryFinder finder(scene);
  const SurfaceHeights heights = surface_heights(scene, finder);
  return heights.is_empty() ? scene.box.low.z : heights.low;
}

void place_on_bed(csg::Scene& scene) {
  csg::BoundaryFinder finder(scene);
  const SurfaceHeights heights = surface_heights(scene, finder);
  if (heights.is_empty()) return;
  csg::move_scene(scene, Affine(1.0), Vec3(0, 0, -heights.low));
  // Layers are counted from the bed, though leaves may reach below it.
  scene.box.low.z = 0;
}

}  // namespace lamina::slicer
