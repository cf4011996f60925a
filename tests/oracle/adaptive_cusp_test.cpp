// openscad judges adaptive layers: each facet of the mesh that it renders must
// keep the cusp, whatever lamina takes for visible.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "slicer/plan/adaptive.h"
#include "tests/oracle/openscad.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

constexpr double kCusp = 0.06;
constexpr double kThinnest = 0.03;
constexpr double kThickest = 0.24;

struct Facet {
  double low;
  double high;
  double steepness;  // |n_z|, at least
};

std::vector<Facet> facets_of(const csg::Mesh& mesh, double spacing) {
  std::vector<Facet> facets;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.vertices[triangle[i]];
    const Vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double longest =
        std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]),
                  glm::distance(p[2], p[0])});
    // Corners are rounded to float32, which turns facets that are narrow.
    const double width = glm::length(cross) / longest;
    if (width < 100 * spacing) continue;
    const auto [low, high] = std::minmax({p[0].z, p[1].z, p[2].z});
    facets.push_back(
        {low, high,
         std::abs(cross.z) / glm::length(cross) - 4 * spacing / width});
  }
  return facets;
}

// Heights of vertices with no neighbour above them, or none below.
std::vector<double> ends_of(const csg::Mesh& mesh, double spacing) {
  std::vector<bool> goes_up(mesh.vertices.size());
  std::vector<bool> goes_down(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t a : triangle) {
      for (const std::uint32_t b : triangle) {
        const double rise = mesh.vertices[b].z - mesh.vertices[a].z;
        if (rise > 2 * spacing) goes_up[a] = true;
        if (rise < -2 * spacing) goes_down[a] = true;
      }
    }
  }
  std::vector<double> ends;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!goes_up[i] || !goes_down[i]) ends.push_back(mesh.vertices[i].z);
  }
  return ends;
}

// What is wrong with the layers; empty if nothing is.
std::string faults_of(const ldni::LayerGrid& grid, const csg::Mesh& mesh) {
  const double spacing = float32_spacing(mesh);
  // What reaches into a layer by rounding only does not count.
  const double reach = 4 * spacing + 1e-5;
  std::string faults;
  // Of layers that a stretch of heights comes into, the thick ones.
  const auto each_layer = [&](double low, double high, const auto& judge) {
    for (std::uint32_t i = grid.layers_below(low - kThickest);
         i < grid.layer_count() && grid.layer_bottom(i) + reach < high; ++i) {
      const double thickness = grid.layer_top(i) - grid.layer_bottom(i);
      if (grid.layer_top(i) - reach <= low) continue;
      if (thickness > kThinnest + 1e-9) judge(i, thickness);
    }
  };
  for (const Facet& facet : facets_of(mesh, spacing)) {
    each_layer(facet.low, facet.high, [&](std::uint32_t i, double thickness) {
      if (thickness * facet.steepness <= kCusp + 1e-9) return;
      faults += fmt::format("layer {} of {} mm: cusp {}\n", i, thickness,
                            thickness * facet.steepness);
    });
  }
  for (const double z : ends_of(mesh, spacing)) {
    each_layer(z, z, [&](std::uint32_t i, double thickness) {
      faults +=
          fmt::format("layer {} of {} mm has an end at {}\n", i, thickness, z);
    });
  }
  return faults.substr(0, 1000);
}

class AdaptiveCusp : public ::testing::TestWithParam<std::string> {};

TEST_P(AdaptiveCusp, HoldsForEveryFacetThatOpenscadRenders) {
  const fs::path path = fs::path(LAMINA_ORACLE_SCENES) / (GetParam() + ".scad");
  const csg::Mesh mesh = render_with_openscad(path);
  const auto design = support::Design::from_file(path);
  const ldni::LayerGrid grid =
      slicer::adaptive_grid(design.scene(), {kThinnest, kThickest, kCusp});
  EXPECT_EQ(faults_of(grid, mesh), "");

  // Layers are thicker where openscad's facets allow it, so there are never
  // more than of one thickness.
  double low = 1e300;
  double high = -1e300;
  for (const Vec3& vertex : mesh.vertices) {
    low = std::min(low, vertex.z);
    high = std::max(high, vertex.z);
  }
  const auto uniform = (high - low) / kThinnest;
  const double count = grid.layer_count();
  std::printf("%s: %.0f layers, %.0f of one thickness\n", GetParam().c_str(),
              count, std::round(uniform));
  EXPECT_LE(count, std::round(uniform) + 1);
  EXPECT_NEAR(grid.layer_bottom(0), low, float32_spacing(mesh) + 1e-6);
}

std::vector<std::string> names_of_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(LAMINA_ORACLE_SCENES)) {
    names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, AdaptiveCusp,
                         ::testing::ValuesIn(names_of_scenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace lamina::oracle
