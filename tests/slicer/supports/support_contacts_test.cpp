// Where supports touch the part, against closed formulas.

#include "slicer/supports/support_contacts.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "slicer/slice/slice.h"
#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

// Makes a design with a support of its own and measures it.
SupportMeasures measured(const std::string& part, const std::string& support) {
  const Design design = Design::from_text(part + "\nmodule support_of() { " +
                                          support + " }\nsupport_of();");
  Settings settings;
  settings.layer_thickness = 0.1;
  SupportMeter meter;
  for (const Layer& layer : support::slice_layers(design.scene(), settings)) {
    meter.take(layer);
  }
  return meter.finish();
}

// Of a regular polygon with so many corners on a circle.
double polygon_area(double radius, int corners) {
  return corners / 2.0 * radius * radius *
         std::sin(2 * std::numbers::pi / corners);
}

TEST(SupportMeter, MeasuresAPostBelowAPlate) {
  // From the bed 0.2 mm deep into the plate.
  const SupportMeasures found =
      measured("translate([0, 0, 5]) cube([10, 10, 2]);",
               "translate([5, 5, 0]) cylinder(r = 0.5, h = 5.2, $fn = 24);");
  ASSERT_EQ(found.contacts.size(), 1U);
  const SupportContact& contact = found.contacts[0];
  EXPECT_NEAR(contact.area, polygon_area(0.5, 24), 1e-3);
  EXPECT_NEAR(contact.place.x, 5, 1e-3);
  EXPECT_NEAR(contact.place.y, 5, 1e-3);
  EXPECT_NEAR(contact.section_z, 5.05, 1e-9);
  EXPECT_FALSE(contact.is_from_above);
  EXPECT_NEAR(found.volume, 5 * polygon_area(0.5, 24), 1e-2);
}

TEST(SupportMeter, MeasuresASlopeAsSeenFromAbove) {
  // A tip that leans goes as deep as it likes: only its way in counts.
  const SupportMeasures found = measured(
      "translate([0, 0, 5]) rotate([0, 45, 0]) translate([-10, -10, 0]) "
      "cube([20, 20, 5]);",
      "translate([0, 0, 5.3]) rotate([0, 205, 0]) "
      "cylinder(r = 0.4, h = 8, $fn = 48);");
  ASSERT_EQ(found.contacts.size(), 1U);
  // The rod leans by 25° from the upright, the face by 45°, to the other side:
  // its normal is 20° from the rod.
  const double section = polygon_area(0.4, 48);
  const double angle = std::numbers::pi / 180;
  const double on_face = section / std::cos(20 * angle);
  EXPECT_NEAR(found.contacts[0].area, on_face * std::cos(45 * angle),
              0.03 * section);
}

TEST(SupportMeter, TellsWhatStandsOnThePart) {
  const SupportMeasures found = measured(
      "difference() { cube(10); translate([1, -1, 1]) cube([8, 12, 8]); }",
      "translate([5, 5, 0.8]) cylinder(d = 1, h = 8.4, $fn = 24);");
  ASSERT_EQ(found.contacts.size(), 2U);
  EXPECT_TRUE(found.contacts[0].is_from_above);
  EXPECT_FALSE(found.contacts[1].is_from_above);
  for (const SupportContact& contact : found.contacts) {
    EXPECT_NEAR(contact.area, polygon_area(0.5, 24), 1e-3);
  }
  EXPECT_NEAR(found.volume, 8 * polygon_area(0.5, 24), 1e-2);
}

TEST(SupportMeter, SeesNoContactInWhatStandsBesideThePart) {
  const SupportMeasures found =
      measured("cube(10);", "translate([12, 5, 0]) cylinder(d = 1, h = 12);");
  EXPECT_TRUE(found.contacts.empty());
  EXPECT_GT(found.volume, 0);
}

TEST(SupportMeter, SeesAPinInsideASupport) {
  // The part's lowest layers are within the tip.
  const SupportMeasures found = measured(
      "cylinder(d = 0.2, h = 6, $fn = 24); translate([0, 0, 5]) "
      "cylinder(d = 4, h = 1);",
      "translate([0, 0, -3]) cylinder(d1 = 1, d2 = 0.4, h = 3.6, $fn = 24);");
  ASSERT_EQ(found.contacts.size(), 1U);
  EXPECT_NEAR(found.contacts[0].section_z, 0.05, 1e-9);
  EXPECT_NEAR(found.contacts[0].area, polygon_area(0.1, 24), 1e-3);
}

// What a difference has cut belongs to the part.
TEST(SupportMeter, KnowsNoSupportsWithinADifference) {
  const Design design = Design::from_text(
      "module support_of() cube(4); difference() { cube(10); support_of(); }");
  Settings settings;
  SliceReport report;
  LayerDrain sink;
  Diagnostics diagnostics;
  report = slice(design.scene(), plan_layers(design.scene(), settings),
                 settings, sink, diagnostics);
  EXPECT_FALSE(report.supports.has_value());
  EXPECT_NEAR(part_volume(report.volume, report.supports), 1000 - 64, 1e-6);
}

}  // namespace
}  // namespace lamina::slicer
