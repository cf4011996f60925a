// Compares texts with openscad's, in the same fonts, where its own test designs
// (tests/conformance) leave a gap.

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/oracle/exact_region.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/openscad.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

// OpenSCAD's own grid of 2D designs, 2^-16 mm, and a bit [mm].
constexpr double kOpenScadDistance = 2e-5;

class Text : public ::testing::TestWithParam<std::string> {};

// The designs are prisms: one section tells all.
TEST_P(Text, EqualsWhatOpenScadRenders) {
  const fs::path path =
      fs::path(LAMINA_ORACLE_TEXTS) / fmt::format("{}.scad", GetParam());
  const csg::Mesh mesh = render_with_openscad(path);
  const double distance = kOpenScadDistance + float32_spacing(mesh);
  const auto design = support::Design::from_file(path);
  const auto layers = support::slice_heights(design.scene(), {0.5});
  ASSERT_EQ(layers.size(), 1U);
  const Verdict verdict = judge(exact_section(mesh, 0.5, distance),
                                layers[0].contours, {distance, distance});
  EXPECT_EQ(verdict.complaint, "");
}

INSTANTIATE_TEST_SUITE_P(Oracle, Text,
                         ::testing::Values("directions", "styles"),
                         [](const auto& text) { return text.param; });

}  // namespace
}  // namespace lamina::oracle
