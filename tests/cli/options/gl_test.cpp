// `--sampler gl`, and its other name, `--sampler gl-peeling`.

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::read_file;
using support::TemporaryFolder;

constexpr const char* kCutBall =
    "difference() { sphere(5, $fn = 40); rotate([20, 30, 0]) cylinder(r = 2, "
    "h = 20, center = true, $fn = 30); translate([0, 0, 4]) cube(9); }";

// Slices kCutBall by the paper's method and returns the report.
nlohmann::json slice(const TemporaryFolder& folder, const std::string& output,
                     const std::vector<std::string>& options) {
  folder.write("design.scad", kCutBall);
  std::vector<std::string> arguments = {
      "design.scad", "-o",  output,     "--contour",     "paper",
      "--layer",     "0.1", "--report", output + ".json"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const auto result = run(folder, arguments);
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.errors.find("warning"), std::string::npos) << result.errors;
  return nlohmann::json::parse(read_file(folder.file(output + ".json")));
}

TEST(Gl, ReportsWhatWasDrawnAndByWhat) {
  const TemporaryFolder folder;
  const auto exact = slice(folder, "exact.slc", {});
  const auto local = slice(folder, "local.slc", {"--sampler", "gl"});
  const auto global =
      slice(folder, "global.slc", {"--sampler", "gl", "--boxes", "global"});
  EXPECT_EQ(exact["sampler"], "scanline");
  EXPECT_EQ(exact["renderer"], "");
  EXPECT_EQ(local["sampler"], "gl");
  EXPECT_NE(local["renderer"], "");
  EXPECT_EQ(local["repaired_pixels"], 0);
  EXPECT_EQ(local["image_pixels"], exact["image_pixels"]);
  EXPECT_GT(global["image_pixels"], local["image_pixels"]);
  EXPECT_EQ(global["image_samples"], local["image_samples"]);
  EXPECT_GT(global["image_bytes"], local["image_bytes"]);
  EXPECT_EQ(global["loops"], exact["loops"]);
  EXPECT_GT(local["section_seconds"], 0);
  EXPECT_LE(local["boolean_seconds"].get<double>() +
                local["link_seconds"].get<double>(),
            local["sweep_seconds"].get<double>());
  EXPECT_NEAR(local["volume_mm3"].get<double>(),
              exact["volume_mm3"].get<double>(),
              1e-3 * exact["volume_mm3"].get<double>());
}

TEST(Gl, ExactContoursReportNoImages) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  ASSERT_EQ(run(folder, {"a.scad", "--report", "a.json"}).status, 0);
  const auto report = nlohmann::json::parse(read_file(folder.file("a.json")));
  EXPECT_FALSE(report.contains("sampler"));
}

TEST(Gl, WritesTheSameBytesForAnyMethodBoxesAndNumberOfThreads) {
  const TemporaryFolder folder;
  slice(folder, "a.slc", {"--sampler", "gl", "--threads", "1"});
  slice(folder, "b.slc", {"--sampler", "gl", "--threads", "3"});
  slice(folder, "c.slc", {"--sampler", "gl-peeling", "--threads", "3"});
  slice(folder, "d.slc", {"--sampler", "gl-peeling", "--boxes", "global"});
  const std::string bytes = read_file(folder.file("a.slc"));
  EXPECT_EQ(read_file(folder.file("b.slc")), bytes);
  EXPECT_EQ(read_file(folder.file("c.slc")), bytes);
  EXPECT_EQ(read_file(folder.file("d.slc")), bytes);
}

TEST(Gl, SaysWhichPackageIsMissing) {
  // Stand-ins that are no libraries hide the installed ones.
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const char* const name :
       {"libEGL.so.1", "libOSMesa.so.6", "libOSMesa.so.8"}) {
    folder.write(name, "no library");
  }
  const std::string path = "LD_LIBRARY_PATH=" + folder.path();
  std::vector<std::string> arguments =
      command({"a.scad", "--sampler", "gl", "--contour", "paper"});
  arguments.insert(arguments.begin(), {"/usr/bin/env", path});
  const auto result = support::run_process(arguments, folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.errors.find("libosmesa6"), std::string::npos)
      << result.errors;
  EXPECT_EQ(folder.entry_count(), 4U);
}

TEST(Gl, DrawsPicturesToo) {
  const TemporaryFolder folder;
  folder.write("a.scad", kCutBall);
  const auto result = run(folder, {"view", "a.scad", "-o", "a.png", "--contour",
                                   "paper", "--sampler", "gl"});
  EXPECT_EQ(result.status, 0) << result.errors;
}

}  // namespace
}  // namespace lamina::cli
