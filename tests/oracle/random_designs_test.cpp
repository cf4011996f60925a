// Random designs against exact sections. A failure prints the design.

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/oracle/exact_region.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/random_design.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

constexpr std::size_t kHeights = 8;

// One design at three pitches. False at its first failure.
bool check_design(const std::string& text) {
  const support::Design design = support::Design::from_text(text);
  const csg::Scene& scene = design.scene();
  if (scene.instances.empty() || scene.box.is_empty()) return true;
  const WorldScene world = world_scene(scene);
  const auto heights =
      generic_heights(world, scene.box.low.z, scene.box.high.z, kHeights);
  std::vector<ExactRegion> sections;
  sections.reserve(heights.size());
  for (const double z : heights) sections.push_back(exact_section(world, z));
  for (const double pitch : {0.02, 0.0762, 0.5}) {
    const auto layers = support::slice_heights(scene, heights, pitch);
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const auto sound = support::are_sound(layers[i].contours);
      const Verdict verdict =
          judge(sections[i], layers[i].contours, kExactAllowance);
      if (sound && verdict.complaint.empty()) continue;
      ADD_FAILURE() << fmt::format("z = {}, pitch {}: {}\n{}\n", heights[i],
                                   pitch, verdict.complaint, sound.message())
                    << text;
      return false;
    }
  }
  return true;
}

// How many designs of each kind: LAMINA_RANDOM_DESIGNS, else a quick few.
std::uint32_t design_count() {
  constexpr std::uint32_t kQuick = 50;
  const char* wanted = std::getenv("LAMINA_RANDOM_DESIGNS");
  if (wanted == nullptr) return kQuick;
  return static_cast<std::uint32_t>(std::strtoul(wanted, nullptr, 10));
}

class RandomDesigns : public ::testing::TestWithParam<RandomKind> {};

TEST_P(RandomDesigns, EqualTheirExactSections) {
  std::size_t failures = 0;
  for (std::uint32_t seed = 1; seed <= design_count() && failures < 5; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const std::size_t leaf_count = 2 + seed * 7 % 39;
    if (!check_design(random_design(GetParam(), seed, leaf_count))) ++failures;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Oracle, RandomDesigns,
    ::testing::Values(RandomKind::kGrid, RandomKind::kTurnedGrid,
                      RandomKind::kGeneric, RandomKind::kThin),
    [](const auto& kind) { return std::string(name_of(kind.param)); });

}  // namespace
}  // namespace lamina::oracle
