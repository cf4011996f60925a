// Thickness by brute force: the exact distance transform of fine voxels.
//
// Voxels know a solid by a formula for each place, and nothing of rays, points
// or balls. Source: Felzenszwalb and Huttenlocher, Distance transforms of
// sampled functions, 2012: the squared distance to the nearest voxel outside is
// the lower envelope of parabolas, along one axis after the other.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "slicer/thickness/feeding.h"
#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr double kVoxel = 0.02;  // [mm]
const double kDiagonal = std::sqrt(3.0) * kVoxel;
constexpr double kThicknessPitch = 0.1;

// By what share a cell that is no summit may be taken for thicker.
constexpr double kDoubt = 0.02;

using Inside = std::function<bool(Vec3)>;

// Replaces values f by the least of f(j) + (i - j)² over all j.
void transform(std::vector<double>& values) {
  const auto count = static_cast<int>(values.size());
  const std::vector<double> f = values;
  const auto at = [&](int i) { return f[static_cast<std::size_t>(i)]; };
  std::vector<int> parabolas;
  std::vector<double> begins;  // of each, where it becomes the lowest
  for (int q = 0; q < count; ++q) {
    double begin = -std::numeric_limits<double>::infinity();
    while (!parabolas.empty()) {
      const int p = parabolas.back();
      begin = ((at(q) + q * q) - (at(p) + p * p)) / (2.0 * (q - p));
      if (begin > begins.back()) break;
      parabolas.pop_back();
      begins.pop_back();
    }
    if (parabolas.empty()) begin = -std::numeric_limits<double>::infinity();
    parabolas.push_back(q);
    begins.push_back(begin);
  }
  std::size_t lowest = 0;
  for (int i = 0; i < count; ++i) {
    while (lowest + 1 < begins.size() && begins[lowest + 1] < i) ++lowest;
    const int p = parabolas[lowest];
    values[static_cast<std::size_t>(i)] = at(p) + (i - p) * (i - p);
  }
}

// How far each voxel's middle is from the nearest one outside.
class Voxels {
 public:
  Voxels(const Box3& box, const Inside& is_inside)
      : origin_(box.low - 2 * kVoxel) {
    for (int axis = 0; axis < 3; ++axis) {
      counts_[static_cast<std::size_t>(axis)] =
          static_cast<int>(std::ceil(box.size()[axis] / kVoxel) + 4);
    }
    squares_.resize(number(0, 0, counts_[2]));
    for_each([&](int x, int y, int z) {
      squares_[number(x, y, z)] = is_inside(middle(x, y, z)) ? 1e9 : 0;
    });
    for (std::size_t axis = 0; axis < 3; ++axis) transform_along(axis);
  }

  // Calls visit(distance [mm]) for voxels no farther than that from a place.
  template <typename Visit>
  void visit_near(Vec3 place, double reach, const Visit& visit) const {
    const Vec3 low = glm::ceil((place - reach - origin_) / kVoxel);
    const Vec3 high = glm::floor((place + reach - origin_) / kVoxel);
    for (int z = at_least_0(low.z); z <= high.z && z < counts_[2]; ++z) {
      for (int y = at_least_0(low.y); y <= high.y && y < counts_[1]; ++y) {
        for (int x = at_least_0(low.x); x <= high.x && x < counts_[0]; ++x) {
          if (glm::length(middle(x, y, z) - place) > reach) continue;
          visit(std::sqrt(squares_[number(x, y, z)]) * kVoxel);
        }
      }
    }
  }

  double greatest() const {
    return std::sqrt(*std::ranges::max_element(squares_)) * kVoxel;
  }

 private:
  static int at_least_0(double index) {
    return std::max(static_cast<int>(index), 0);
  }
  std::size_t number(int x, int y, int z) const {
    return static_cast<std::size_t>((z * counts_[1] + y) * counts_[0] + x);
  }
  Vec3 middle(int x, int y, int z) const {
    return origin_ + kVoxel * Vec3(x, y, z);
  }
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (int z = 0; z < counts_[2]; ++z) {
      for (int y = 0; y < counts_[1]; ++y) {
        for (int x = 0; x < counts_[0]; ++x) visit(x, y, z);
      }
    }
  }

  void transform_along(std::size_t axis) {
    std::vector<double> line(static_cast<std::size_t>(counts_[axis]));
    const std::size_t step = axis == 0   ? 1
                             : axis == 1 ? number(0, 1, 0)
                                         : number(0, 0, 1);
    for_each([&](int x, int y, int z) {
      if (std::array{x, y, z}[axis] != 0) return;
      const std::size_t first = number(x, y, z);
      for (std::size_t i = 0; i < line.size(); ++i) {
        line[i] = squares_[first + i * step];
      }
      transform(line);
      for (std::size_t i = 0; i < line.size(); ++i) {
        squares_[first + i * step] = line[i];
      }
    });
  }

  Vec3 origin_;
  std::array<int, 3> counts_ = {};
  std::vector<double> squares_;  // of distances [voxels²]
};

struct Solid {
  const char* name;
  const char* text;
  Inside is_inside;
};

bool in_box(Vec3 place, Vec3 low, Vec3 high) {
  return glm::all(glm::greaterThan(place, low)) &&
         glm::all(glm::lessThan(place, high));
}

const Solid kSolids[] = {
    {"a bracket", "cube([2.2, 1, 0.6]); cube([0.5, 1, 2.2]);",
     [](Vec3 p) {
       return in_box(p, Vec3(0), Vec3(2.2, 1, 0.6)) ||
              in_box(p, Vec3(0), Vec3(0.5, 1, 2.2));
     }},
    {"a bracket that is turned",
     "rotate(30) { cube([2.2, 1, 0.6]); cube([0.5, 1, 2.2]); }",
     [](Vec3 world) {
       const double c = std::sqrt(0.75);
       const Vec3 p(c * world.x + 0.5 * world.y, c * world.y - 0.5 * world.x,
                    world.z);
       return in_box(p, Vec3(0), Vec3(2.2, 1, 0.6)) ||
              in_box(p, Vec3(0), Vec3(0.5, 1, 2.2));
     }},
    {"a prong with a ball on a base",
     "cube([1.6, 1.6, 0.5]); translate([0.8, 0.8, 0]) { cylinder(r = 0.35, h "
     "= 1.8, $fn = 256); translate([0, 0, 1.8]) sphere(0.55, $fn = 256); }",
     [](Vec3 p) {
       const Vec3 q = p - Vec3(0.8, 0.8, 0);
       return in_box(p, Vec3(0), Vec3(1.6, 1.6, 0.5)) ||
              (q.z > 0 && q.z < 1.8 && std::hypot(q.x, q.y) < 0.35) ||
              glm::length(q - Vec3(0, 0, 1.8)) < 0.55;
     }},
    {"a corner of a seal with a border and a stroke",
     "difference() { cube([2.4, 2.4, 1.2]); translate([0.3, 0.3, 0.9]) cube("
     "[3, 0.35, 1]); translate([0.3, 0.3, 0.9]) cube([0.35, 3, 1]); "
     "translate([1.1, 1.1, 0.8]) cube([0.4, 0.9, 1]); }",
     [](Vec3 p) {
       return in_box(p, Vec3(0), Vec3(2.4, 2.4, 1.2)) &&
              !in_box(p, Vec3(0.3, 0.3, 0.9), Vec3(3.3, 0.65, 1.9)) &&
              !in_box(p, Vec3(0.3, 0.3, 0.9), Vec3(0.65, 3.3, 1.9)) &&
              !in_box(p, Vec3(1.1, 1.1, 0.8), Vec3(1.5, 2, 1.8));
     }},
    {"a bored ball",
     "difference() { sphere(1.1, $fn = 256); translate([0.4, 0, -2]) "
     "cylinder(r = 0.3, h = 4, $fn = 256); }",
     [](Vec3 p) {
       return glm::length(p) < 1.1 && std::hypot(p.x - 0.4, p.y) > 0.3;
     }},
};

class Solids : public testing::TestWithParam<int> {};

TEST_P(Solids, AreAsThickAsTheirVoxels) {
  const Solid& solid = kSolids[GetParam()];
  SCOPED_TRACE(solid.name);
  const Design design = Design::from_text(solid.text);
  const SolidSamples samples = sample_solid(design.scene(), kThicknessPitch);
  const BallFinder balls(samples.points);
  const ThicknessField field = measure_thickness(samples, balls);
  const Voxels voxels(design.scene().box, solid.is_inside);

  // A voxel's distance is too large by a diagonal at most, and never too small;
  // half a diagonal away from a cell it says as much of that.
  const double cover = kCover * kThicknessPitch;
  samples.cells.visit([&](std::uint32_t cell, const SolidCells::Index& index) {
    const Vec3 middle = samples.cells.middle_of(index);
    double here = 0;
    voxels.visit_near(middle, kDiagonal / 2 + 1e-9,
                      [&](double one) { here = std::max(here, one); });
    double near = 0;
    voxels.visit_near(middle, kReach * kThicknessPitch + kDiagonal / 2,
                      [&](double one) { near = std::max(near, one); });
    ASSERT_GE(field.radii[cell], here - 1.5 * kDiagonal);
    ASSERT_LE(field.radii[cell], (near + cover) * (1 + kDoubt) + kDiagonal / 2);
  });

  double thickest = 0;
  for (const Pool& pool : find_pools(samples, balls, field, {})) {
    thickest = std::max(thickest, pool.thickness / 2);
  }
  EXPECT_GE(thickest, voxels.greatest() - 1.5 * kDiagonal);
  EXPECT_LE(thickest, voxels.greatest() + cover + kDiagonal / 2);
}

INSTANTIATE_TEST_SUITE_P(All, Solids,
                         testing::Range(0,
                                        static_cast<int>(std::size(kSolids))));

}  // namespace
}  // namespace lamina::slicer
