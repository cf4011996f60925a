// What layers hold: of a file, and of the design that it is of, the same.

#include "compiler/look_at.h"

#include <string>

#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "compiler/validate.h"
#include "tests/support/temporary_folder.h"

namespace lamina::compiler {
namespace {

using support::TemporaryFolder;

// A bar on two posts, with a ball that nothing holds.
constexpr const char* kBridge =
    "for (x = [0, 8]) translate([x, 0, 0]) cube([2, 2, 4]);\n"
    "translate([0, 0, 4]) cube([10, 2, 1]);\n"
    "translate([5, 1, 2]) sphere(0.5, $fn = 16);\n";

Inspection look(const Request& request, const LookOptions& options) {
  TemporaryFiles files;
  Compilation compilation(request, files);
  const auto inspection = look_at(compilation, options);
  EXPECT_TRUE(inspection.has_value());
  return inspection.value_or(Inspection());
}

TEST(LookAt, SeesTheSameInADesignAndInItsLayers) {
  const TemporaryFolder folder;
  Request request;
  request.design.path = folder.write("bridge.scad", kBridge);
  request.output.path = folder.file("bridge.layers.json");
  request.output.format = slicer::OutputFormat::kLayersJson;
  request.job.layer_thickness = 0.25;
  {
    TemporaryFiles files;
    Compilation compilation(request, files);
    ASSERT_TRUE(compile(compilation));
  }
  const LookOptions all = {
      .finds_defects = true, .min_feature = 0.5, .keeps_layers = true};
  const Inspection design = look(request, all);
  request.design.path = request.output.path;
  const Inspection file = look(request, all);

  ASSERT_EQ(design.layers.size(), 20U);
  ASSERT_EQ(file.layers.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(design.layers[i].contours.points, file.layers[i].contours.points);
  }
  EXPECT_DOUBLE_EQ(design.found.volume, file.found.volume);
  EXPECT_EQ(design.found.defects, 0U);
  EXPECT_EQ(file.found.defects, 0U);
  EXPECT_EQ(design.found.features.size(), file.found.features.size());
  ASSERT_TRUE(design.found.print && file.found.print);
  ASSERT_EQ(design.found.print->findings.size(),
            file.found.print->findings.size());
  EXPECT_GT(design.found.print->count(slicer::FindingKind::kLoosePart), 0U);
  // A file does not know the lines of its design.
  EXPECT_EQ(design.lines.findings.size(), design.found.print->findings.size());
  EXPECT_TRUE(file.lines.findings.empty());
}

TEST(LookAt, HasNoValueWhereTheDesignFailed) {
  Request request;
  request.design.path = "a.scad";
  request.design.text = "assert(false);";
  TemporaryFiles files;
  Compilation compilation(request, files);
  EXPECT_FALSE(look_at(compilation, {}));
  EXPECT_TRUE(compilation.diagnostics.has_errors());
}

TEST(LookAt, RefusesOptionsOfDesignsForAFile) {
  const TemporaryFolder folder;
  Request request;
  request.design.path = folder.write("a.layers.json", "{}");
  request.design.given_option = "--scale";
  TemporaryFiles files;
  Compilation compilation(request, files);
  EXPECT_THROW(look_at(compilation, {}), RequestError);
}

TEST(FindLines, NamesTheLinesOfADesign) {
  Request request;
  request.design.path = "a.scad";
  request.design.text = "module wall() cube([10, 0.3, 2]);\nwall();\n";
  request.job.min_feature = 0.5;
  const Inspection design = look(request, {});
  EXPECT_EQ(texts_of(design.lines.features),
            std::vector<std::string>{"a.scad:1:15 from a.scad:2:1"});
}

}  // namespace
}  // namespace lamina::compiler
