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

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/move_scene.h"
#include "csg/degrees.h"
#include "plane/tie_distance.h"

namespace lamina::slicer {
namespace {

// Lengths [mm], and sums as a share of the whole surface, that differ by less
// are equal: so far the rounding of Booleans may move them.
constexpr double kSame = kTieDistance;

// What looks down by more than 45° wants supports; 45° but for rounding does
// not.
constexpr double kOverhang = std::numbers::sqrt2 / 2 + 1e-6;

// The area of a plane polygon with holes [mm²].
double area_of(const csg::BoundaryFace& face) {
  Vec3 twice(0);
  for (const auto& contour : face.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec3& next = contour[(i + 1) % contour.size()];
      // From the face's own corner, not from the origin: less is cancelled.
      twice += glm::cross(contour[i] - face.contours[0][0],
                          next - face.contours[0][0]);
    }
  }
  return glm::dot(twice, face.normal) / 2;
}

// Sums over the surface for both directions along a coordinate.
struct Sums {
  double steps = 0;  // area · |n| of all faces but flat ones
  double low = 1e300;
  double high = -1e300;
  // Surface that looks down, or up, by more than 45°; and how much is flat and
  // lies as low, or as high, as anything.
  double looks_down = 0;
  double looks_up = 0;
  double lies_low = 0;
  double lies_high = 0;

  double size() const { return high - low; }

  void take(double area, double normal, double face_low, double face_high) {
    const bool is_flat = face_high - face_low <= kSame;
    if (!is_flat) steps += area * std::abs(normal);
    if (face_low < low - kSame) lies_low = 0;
    if (face_high > high + kSame) lies_high = 0;
    low = std::min(low, face_low);
    high = std::max(high, face_high);
    if (normal < -kOverhang) looks_down += area;
    if (normal > kOverhang) looks_up += area;
    if (is_flat && normal < 0 && face_low <= low + kSame) lies_low += area;
    if (is_flat && normal > 0 && face_high >= high - kSame) lies_high += area;
  }
};

struct Surface {
  std::array<Sums, 3> along;  // x, y, z
  double area = 0;
};

Surface measure_surface(const csg::Scene& scene) {
  Surface surface;
  csg::visit_boundary_faces(
      scene, [](const Box3&) { return true; },
      [&](const csg::BoundaryFace& face) {
        const Box3 box = csg::box_of(face);
        const double area = area_of(face);
        surface.area += area;
        for (int i = 0; i < 3; ++i) {
          surface.along[static_cast<std::size_t>(i)].take(
              area, face.normal[i], box.low[i], box.high[i]);
        }
      });
  return surface;
}

bool fits(Vec3 size, Vec3 volume) {
  return glm::all(glm::lessThanEqual(size, volume + kSame));
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

Orientation orientation_along(std::string_view axis, const Surface& surface,
                              double thickness, Vec3 volume) {
  const bool is_reversed = axis.front() == '-';
  const Sums& sums = surface.along[static_cast<std::size_t>(axis.back() - 'x')];
  Orientation orientation;
  orientation.axis = axis;
  if (surface.area == 0) return orientation;
  orientation.cusp_error = sums.steps * thickness;
  fit(orientation,
      {surface.along[0].size(), surface.along[1].size(),
       surface.along[2].size()},
      volume);
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
  const Surface surface = measure_surface(scene);
  OrientationChoice choice;
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    choice.all[i] = orientation_along(kAxes[i], surface, thickness, volume);
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
  const double same_area = kSame * surface.area;
  keep_best("what fits", 0, [](const O& o) { return o.fits ? 0. : 1.; });
  keep_best("the least cusp error", same_area * thickness,
            [](const O& o) { return o.cusp_error; });
  keep_best("the least height", kSame, [](const O& o) { return o.size.z; });
  keep_best("the least overhang", same_area,
            [](const O& o) { return o.overhang; });
  keep_best("the most on the bed", same_area,
            [](const O& o) { return -o.footing; });
  if (choice.reason.empty()) choice.reason = "no other is better";
  choice.best = left.front();
  return choice;
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

SurfaceHeights surface_heights(const csg::Scene& scene) {
  SurfaceHeights heights;
  csg::visit_boundary_faces(
      scene,
      [&](const Box3& box) {
        return box.low.z < heights.low || box.high.z > heights.high;
      },
      [&](const csg::BoundaryFace& face) {
        const Box3 box = csg::box_of(face);
        heights.low = std::min(heights.low, box.low.z);
        heights.high = std::max(heights.high, box.high.z);
      });
  return heights;
}

void place_on_bed(csg::Scene& scene) {
  const SurfaceHeights heights = surface_heights(scene);
  if (heights.is_empty()) return;
  csg::move_scene(scene, Affine(1.0), Vec3(0, 0, -heights.low));
  // Layers are counted from the bed, though leaves may reach below it.
  scene.box.low.z = 0;
}

}  // namespace lamina::slicer
