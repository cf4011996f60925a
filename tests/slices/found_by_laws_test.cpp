// Designs whose layers once broke a law of scene_laws.h, made small.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina {
namespace {

std::vector<plane::Contours> sections(const std::string& text,
                                      const std::vector<double>& heights) {
  const auto design = support::Design::from_text(text);
  std::vector<plane::Contours> all;
  for (auto& layer : support::slice_heights(design.scene(), heights)) {
    EXPECT_TRUE(support::are_sound(layer.contours));
    all.push_back(std::move(layer.contours));
  }
  return all;
}

// The tip of a wedge ends beyond a face by 1e-7 mm. Where each of them is there
// twice, copies that are no boundary lay between the two that are, and that
// these had passed each other went unnoticed.
TEST(FoundByLaws, ATipBeyondAFaceByLessThanATieIsSeenBetweenCopies) {
  const std::string part =
      "difference() {"
      "  translate([3.749999836495, -1.25, 0]) cylinder(r = 2, h = 3, $fn = 4);"
      "  translate([0.749999836495, -2.750000163505, 0])"
      "    linear_extrude(3) polygon([[0, 0], [0, -1], [3.5, 0]]); }";
  const auto once = sections(part, {2});
  const auto twice = sections("intersection() {" + part + part + "}", {2});
  // The diamond, without what the wedge takes of its lower corner.
  EXPECT_NEAR(support::total_area(once[0]), 8 - 0.125 + 1.0 / 72, 1e-6);
  EXPECT_NEAR(support::total_area(twice[0]), 8 - 0.125 + 1.0 / 72, 1e-6);
  EXPECT_EQ(support::count_loops(twice[0]).outer, 2U);
}

}  // namespace
}  // namespace lamina
