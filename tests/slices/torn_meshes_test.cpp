// Meshes with cracks, and with triangles that are missing, doubled or turned:
// their layers have the volume of the sound mesh.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "csg/lower/detail/repair.h"
#include "csg/scene.h"
#include "tests/csg/scan_meshes.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"
#include "tests/support/leaf_scenes.h"

namespace lamina {
namespace {

using csg::Mesh;
using Soup = std::vector<std::array<Vec3, 3>>;

Soup to_soup(const Mesh& mesh) {
  Soup soup;
  for (const auto& t : mesh.triangles) {
    soup.push_back(
        {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
  return soup;
}

Mesh to_mesh(const Soup& soup) {
  Mesh mesh;
  for (const auto& triangle : soup) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Mesh turned_inside_out(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// 1 mm thick.
Mesh hollow_box() {
  return csg::test::joined(
      {csg::test::box(Vec3(0), Vec3(10, 12, 8), 3),
       turned_inside_out(csg::test::box(Vec3(1), Vec3(9, 11, 7), 3))});
}

// Two boxes 0.01 mm apart.
Mesh boxes_apart() {
  return csg::test::joined(
      {csg::test::box(Vec3(0), Vec3(5, 10, 8), 2),
       csg::test::box(Vec3(5.01, 0, 0), Vec3(10, 10, 8), 2)});
}

std::vector<plane::Contours> sections_of(Mesh mesh) {
  csg::Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  Box3 box;
  box.add(mesh.vertices);
  scene.leaves.push_back(support::mesh_leaf(std::move(mesh), true));
  support::place_leaf(scene, 0, Affine(1.0));
  support::cover_instances(scene);
  std::vector<double> heights;
  for (double share = 0.0173; share < 1; share += 0.0491) {
    heights.push_back(box.low.z + share * box.size().z);
  }
  std::vector<plane::Contours> sections;
  for (const slicer::Layer& layer : support::slice_heights(scene, heights)) {
    sections.push_back(layer.contours);
  }
  return sections;
}

double total_area(const std::vector<plane::Contours>& sections) {
  double area = 0;
  for (const plane::Contours& section : sections) {
    area += support::total_area(section);
  }
  return area;
}

class Tearing {
 public:
  Tearing(std::uint32_t seed, double width) : random_(seed), width_(width) {}

  double width() const { return width_; }
  std::uint32_t draw(std::size_t below) {
    return static_cast<std::uint32_t>(random_() % below);
  }
  double draw_real(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }
  Vec3 draw_shift() {
    return {draw_real(-width_, width_), draw_real(-width_, width_),
            draw_real(-width_, width_)};
  }

 private:
  std::mt19937 random_;
  const double width_;
};

// Every triangle by itself.
void tear_all(Soup& soup, Tearing& tearing) {
  for (auto& triangle : soup) {
    for (Vec3& corner : triangle) corner += tearing.draw_shift();
  }
}

// One half off the other.
void tear_halves(Soup& soup, Tearing& tearing) {
  const auto axis = static_cast<int>(tearing.draw(3));
  const auto place = [axis](const std::array<Vec3, 3>& triangle) {
    return triangle[0][axis] + triangle[1][axis] + triangle[2][axis];
  };
  const double middle = place(soup[tearing.draw(soup.size())]);
  const Vec3 shift = tearing.draw_shift();
  for (auto& triangle : soup) {
    if (place(triangle) >= middle) continue;
    for (Vec3& corner : triangle) corner += shift;
  }
}

// Corners of one triangle along the edge of another.
void tear_edges(Soup& soup, Tearing& tearing) {
  for (std::size_t i = soup.size(); i-- > 0;) {
    if (tearing.draw(6) > 0) continue;
    const auto [a, b, c] = soup[i];
    const Vec3 middle =
        a + tearing.draw_real(0.2, 0.8) * (b - a) + tearing.draw_shift();
    soup[i] = {a, middle, c};
    soup.push_back({middle, b, c});
  }
}

// Up to two triangles each are missing, doubled and turned.
void spoil(Soup& soup, Tearing& tearing) {
  for (std::uint32_t n = tearing.draw(3); n > 0; --n) {
    soup.erase(soup.begin() + tearing.draw(soup.size()));
  }
  for (std::uint32_t n = tearing.draw(3); n > 0; --n) {
    soup.push_back(soup[tearing.draw(soup.size())]);
  }
  for (std::uint32_t n = tearing.draw(3); n > 0; --n) {
    auto& triangle = soup[tearing.draw(soup.size())];
    std::swap(triangle[1], triangle[2]);
  }
}

struct Sound {
  std::string name;
  Mesh mesh;
  double area = 0;        // of all sections together
  std::size_t loops = 0;  // as many
};

std::vector<Sound> sound_meshes() {
  std::vector<Sound> meshes = {
      {"ball", csg::test::ball(10, 6)},
      {"box", csg::test::box(Vec3(0), Vec3(10, 20, 30), 2)},
      {"ring", csg::test::doughnut(8, 3, 24, 12)},
      {"hollow box", hollow_box()},
      {"boxes apart", boxes_apart()}};
  for (Sound& sound : meshes) {
    const auto sections = sections_of(sound.mesh);
    sound.area = total_area(sections);
    for (const plane::Contours& section : sections) {
      sound.loops += section.loop_count();
    }
  }
  return meshes;
}

TEST(TornMeshes, KeepTheirVolume) {
  const std::vector<Sound> meshes = sound_meshes();
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    constexpr std::array kWidths = {0.0, 1e-6, 1e-5, 1e-4, 1e-3};
    constexpr std::array kTears = {tear_all, tear_halves, tear_edges};
    const Sound& sound = meshes[seed % meshes.size()];
    Tearing tearing(seed, kWidths[seed / 5 % kWidths.size()]);
    Soup soup = to_soup(sound.mesh);
    const bool is_spoiled_first = tearing.draw(2) == 0;
    const bool is_spoiled = seed % 2 == 0;
    if (is_spoiled && is_spoiled_first) spoil(soup, tearing);
    kTears[seed / 25 % kTears.size()](soup, tearing);
    if (is_spoiled && !is_spoiled_first) spoil(soup, tearing);
    std::shuffle(soup.begin(), soup.end(), std::mt19937(seed));

    Mesh mesh = to_mesh(soup);
    Diagnostics diagnostics;
    csg::repair_and_report(mesh, {}, diagnostics);
    const auto sections = sections_of(std::move(mesh));
    std::size_t loops = 0;
    for (const plane::Contours& section : sections) {
      loops += section.loop_count();
    }
    const std::string what = fmt::format("seed {}: {} torn by {} mm", seed,
                                         sound.name, tearing.width());
    EXPECT_NEAR(total_area(sections), sound.area, 1e-3 * sound.area) << what;
    // A gap of 0.01 mm stays, and no hollow comes.
    EXPECT_EQ(loops, sound.loops) << what;
  }
}

}  // namespace
}  // namespace lamina
