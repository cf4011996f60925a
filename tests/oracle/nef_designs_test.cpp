// Random designs of sound leaves as whole solids: CGAL's Nef polyhedra unite
// the leaves in space, lamina in each layer. LAMINA_NEF_DESIGNS says how many
// of each kind, LAMINA_NEF_SEED where to begin.

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/oracle/nef_solid.h"
#include "tests/oracle/whole_solid.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/design.h"
#include "tests/support/environment.h"
#include "tests/support/random_design.h"

namespace lamina::oracle {
namespace {

using support::number_from;
using support::RandomKind;

class NefDesigns : public ::testing::TestWithParam<RandomKind> {};

TEST_P(NefDesigns, AreTheSolidsThatLaminaCuts) {
  const std::uint32_t count = number_from("LAMINA_NEF_DESIGNS", 6);
  const std::uint32_t first = number_from("LAMINA_NEF_SEED", 1);
  std::uint32_t judged = 0;
  for (std::uint32_t seed = first; judged < count; ++seed) {
    // Not so many leaves that the whole solid takes minutes.
    const std::string text = random_design(GetParam(), seed, 2 + seed % 4);
    const support::Design design = support::Design::from_text(text);
    if (design.scene().instances.empty()) continue;
    const csg::Mesh boundary = nef_boundary(world_scene(design.scene()));
    if (boundary.triangles.empty()) continue;
    ++judged;
    EXPECT_EQ(compare_with_solid(design.scene(), boundary), "")
        << "seed " << seed << "\n"
        << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, NefDesigns,
                         ::testing::Values(RandomKind::kGrid,
                                           RandomKind::kTurnedGrid,
                                           RandomKind::kGeneric),
                         [](const auto& kind) {
                           return std::string(name_of(kind.param));
                         });

}  // namespace
}  // namespace lamina::oracle
