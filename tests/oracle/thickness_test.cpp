// Thickness, measured by CGAL from surfaces that openscad renders.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "slicer/thickness/feeding.h"
#include "slicer/thickness/thin_places.h"
#include "tests/oracle/openscad.h"
#include "tests/oracle/pieces.h"
#include "tests/oracle/surface_distance.h"
#include "tests/support/design.h"
#include "tests/support/random_design.h"
#include "tests/support/temporary_folder.h"

namespace lamina::oracle {
namespace {

// openscad's STL rounds to six digits.
constexpr double kRounding = 1e-4;

// By what share a cell that is no summit may be taken for thicker
// (measure_thickness).
constexpr double kDoubt = 0.02;

// How near to the largest ball climbing in steps ends [pitches].
constexpr double kSteps = 0.05;

std::vector<Vec3> middles_of(const slicer::SolidCells& cells) {
  std::vector<Vec3> middles;
  cells.visit([&](std::uint32_t, const slicer::SolidCells::Index& index) {
    middles.push_back(cells.middle_of(index));
  });
  return middles;
}

// The greatest distance from the surface near a place inside, by climbing.
double climb(const csg::Mesh& surface, Vec3 place, double step) {
  double greatest = distances_from(surface, {place})[0];
  step = std::min(step, greatest / 2);
  while (step > 1e-4) {
    std::vector<Vec3> around;
    for (int i = 0; i < 27; ++i) {
      around.push_back(place +
                       step * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    }
    const std::vector<double> distances = distances_from(surface, around);
    const auto best = std::max_element(distances.begin(), distances.end());
    if (*best > greatest + kRounding * step) {
      greatest = *best;
      place = around[static_cast<std::size_t>(best - distances.begin())];
    } else {
      step /= 2;
    }
  }
  return greatest;
}

// Judges points, cells, summits and thin places of a design.
void judge(const std::string& text) {
  SCOPED_TRACE(text);
  const support::Design design = support::Design::from_text(text);
  const Vec3 size = design.scene().box.size();
  const double pitch = std::cbrt(size.x * size.y * size.z / 60000);
  const auto samples = slicer::sample_solid(design.scene(), pitch);
  if (samples.points.empty()) return;
  const support::TemporaryFolder folder;
  const csg::Mesh surface = render_with_openscad(folder.write("a.scad", text));
  const slicer::BallFinder balls(samples.points);
  const auto field = slicer::measure_thickness(samples, balls);

  std::vector<Vec3> places;
  for (const auto& point : samples.points) places.push_back(point.place);
  for (const double distance : distances_from(surface, places)) {
    ASSERT_LE(distance, kRounding);
  }

  const std::vector<Vec3> middles = middles_of(samples.cells);
  const std::vector<double> distances = distances_from(surface, middles);
  const double cover = slicer::kCover * pitch;
  const double reach = slicer::kReach * pitch;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const double distance = distances[i];
    ASSERT_GE(field.radii[i], distance - kRounding);
    ASSERT_LE(field.radii[i],
              (distance + reach + cover) * (1 + kDoubt) + kRounding);
  }

  // The thickest place of all. A ball may reach out of the solid where an edge
  // points into it, by less than no point is near; it is not too small.
  const auto pools = slicer::find_pools(samples, balls, field, {});
  const auto thickest = std::max_element(
      pools.begin(), pools.end(),
      [](const auto& a, const auto& b) { return a.thickness < b.thickness; });
  const double greatest = climb(surface, thickest->place, pitch);
  EXPECT_LE(thickest->thickness / 2, greatest + cover);
  EXPECT_GE(thickest->thickness / 2, greatest - kSteps * pitch);
  EXPECT_GE(greatest,
            *std::max_element(distances.begin(), distances.end()) - cover);

  // Walls and gaps that are called thin are as thin as that.
  const double width = 6 * pitch;
  std::vector<Vec3> centres;
  const auto thin = slicer::find_thin_places(samples, balls, width);
  for (const auto& place : thin) centres.push_back(place.place);
  const std::vector<double> half = distances_from(surface, centres);
  for (std::size_t i = 0; i < thin.size(); ++i) {
    ASSERT_LE(thin[i].width, width);
    EXPECT_LE(half[i], thin[i].width / 2 + kRounding);
    EXPECT_GE(half[i], thin[i].width / 2 - cover);
  }
}

class Pieces : public testing::TestWithParam<int> {};

TEST_P(Pieces, AreAsThickAsTheirSurfaceSays) { judge(kPieces[GetParam()]); }

INSTANTIATE_TEST_SUITE_P(All, Pieces,
                         testing::Range(0,
                                        static_cast<int>(std::size(kPieces))));

void judge_random(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    // Of designs whose faces coincide openscad makes surfaces with holes.
    judge(support::random_design(support::RandomKind::kGeneric, seed,
                                 2 + seed % 6));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(RandomDesigns, AreAsThickAsTheirSurfaceSays) { judge_random(0, 6); }

// Some five minutes: ask for it with --gtest_also_run_disabled_tests.
TEST(RandomDesigns, DISABLED_TwoHundredAreAsThickAsTheirSurfaceSays) {
  judge_random(0, 200);
}

}  // namespace
}  // namespace lamina::oracle
