#include "tests/oracle/whole_solid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

constexpr std::size_t kHeights = 7;

// Vertices no further apart have one height: rounding [mm].
constexpr double kLevelDistance = 1e-7;

// Of the volume. A Boolean of regions takes edges within 3e-8 mm for one.
constexpr double kVolumeShare = 1e-7;

std::vector<double> levels_of(const csg::Mesh& mesh) {
  std::vector<double> levels;
  for (const Vec3& vertex : mesh.vertices) levels.push_back(vertex.z);
  std::sort(levels.begin(), levels.end());
  const auto is_same = [](double a, double b) {
    return b - a < kLevelDistance;
  };
  levels.erase(std::unique(levels.begin(), levels.end(), is_same),
               levels.end());
  return levels;
}

double volume_by_layers(const csg::Scene& scene,
                        const std::vector<double>& levels) {
  std::vector<double> heights;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const double middle = 0.5 * (levels[i - 1] + levels[i]);
    const double gauss = 0.5 * (levels[i] - levels[i - 1]) / std::sqrt(3.0);
    heights.push_back(middle - gauss);
    heights.push_back(middle + gauss);
  }
  const auto layers = support::slice_heights(scene, heights);
  double volume = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const double slab = levels[i / 2 + 1] - levels[i / 2];
    volume += 0.5 * slab * support::total_area(layers[i].contours);
  }
  return volume;
}

}  // namespace

std::string compare_with_solid(const csg::Scene& scene,
                               const csg::Mesh& expected) {
  constexpr double kJoin = 1e-9;  // of the rounded mesh's open ends [mm]
  const std::vector<double> levels = levels_of(expected);
  WorldScene world;
  world.meshes.push_back(expected);
  const auto heights =
      generic_heights(world, levels.front(), levels.back(), kHeights);
  const auto layers = support::slice_heights(scene, heights);
  std::string faults;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto sound = support::are_sound(layers[i].contours);
    const Verdict verdict = judge(exact_section(expected, heights[i], kJoin),
                                  layers[i].contours, kExactAllowance);
    if (sound && verdict.complaint.empty()) continue;
    faults += fmt::format("z = {}: {} {}\n", heights[i], verdict.complaint,
                          sound.message());
  }
  const double volume = csg::signed_volume(expected);
  const double by_layers = volume_by_layers(scene, levels);
  if (!(std::abs(by_layers - volume) <= kVolumeShare * volume)) {
    faults +=
        fmt::format("volume by layers {}, expected {}\n", by_layers, volume);
  }
  return faults;
}

}  // namespace lamina::oracle
