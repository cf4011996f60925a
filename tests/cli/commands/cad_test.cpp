// STEP, IGES and BREP on the command line.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
using support::TemporaryFolder;

// Cylinders of radius 5 and height 12.
void add_seed(const TemporaryFolder& folder, const std::string& seed,
              const std::string& name) {
  std::filesystem::copy_file(std::string(LAMINA_SEEDS) + "/" + seed,
                             folder.file(name));
}

TEST(Cad, APartIsSlicedAsTheDesignThatImportsIt) {
  const TemporaryFolder folder;
  add_seed(folder, "step/cylinder", "part.STEP");
  add_seed(folder, "iges/cylinder", "part.igs");
  add_seed(folder, "brep/binary", "part.brp");
  for (const char* name : {"part.STEP", "part.igs", "part.brp"}) {
    folder.write("a.scad", std::string("import(\"") + name + "\");");
    EXPECT_EQ(run(folder, {name, "-q", "-o", "part.slc"}).status, 0) << name;
    EXPECT_EQ(run(folder, {"a.scad", "-q", "-o", "a.slc"}).status, 0) << name;
    EXPECT_EQ(run(folder, {"compare", "part.slc", "a.slc"}).status, 0) << name;
  }
}

TEST(Cad, LayersKeepTheChordalErrorInTheWorld) {
  const TemporaryFolder folder;
  add_seed(folder, "step/cylinder", "part.step");
  folder.write("part.scad", "scale(10) import(\"part.step\");");
  folder.write("fine.scad", "scale(10) cylinder(r = 5, h = 12, $fn = 5000);");
  for (const char* design : {"part", "fine"}) {
    EXPECT_EQ(run(folder, {std::string(design) + ".scad", "-q", "--layer", "1",
                           "--chordal-error", "0.02", "-o",
                           std::string(design) + ".slc"})
                  .status,
              0);
  }
  const auto result =
      run(folder, {"compare", "part.slc", "fine.slc", "--tolerance", "0.0225"});
  EXPECT_EQ(result.status, 0) << result.output << result.errors;
}

TEST(Cad, HullsAndSumsKeepTheChordalErrorInTheWorld) {
  const TemporaryFolder folder;
  add_seed(folder, "step/cylinder", "part.step");
  folder.write("part.scad", "scale(10) import(\"part.step\");");
  folder.write("hull.scad", "scale(10) hull() import(\"part.step\");");
  folder.write("resize.scad",
               "scale(10) resize([20, 20, 12]) resize([10, 10, 12])"
               " import(\"part.step\");");
  folder.write("fine.scad", "scale(10) cylinder(r = 5, h = 12, $fn = 5000);");
  folder.write("wide.scad", "scale(10) cylinder(r = 10, h = 12, $fn = 5000);");
  for (const char* design : {"part", "hull", "resize", "fine", "wide"}) {
    EXPECT_EQ(run(folder, {std::string(design) + ".scad", "-q", "--layer", "1",
                           "-o", std::string(design) + ".slc"})
                  .status,
              0);
  }
  for (const auto& [a, b] :
       {std::pair("part", "fine"), {"hull", "fine"}, {"resize", "wide"}}) {
    const auto result =
        run(folder, {"compare", std::string(a) + ".slc",
                     std::string(b) + ".slc", "--tolerance", "0.0225"});
    EXPECT_EQ(result.status, 0) << a << result.output << result.errors;
  }
}

TEST(Cad, CopiesThatAreTurnedShareOneMesh) {
  const TemporaryFolder folder;
  add_seed(folder, "step/cylinder", "part.step");
  folder.write("a.scad",
               "for (i = [0 : 30]) translate([20 * i, 0, 0])"
               " rotate([i * 1.7, i * 2.3, i * 3.6]) import(\"part.step\","
               " decimate = 0.05);");
  const auto result = run(folder, {"a.scad", "-o", "a.slc", "--layer", "1"});
  EXPECT_EQ(result.status, 0);
  const std::string words = "within 0.05 of the file's surface";
  EXPECT_EQ(result.errors.find(words), result.errors.rfind(words))
      << result.errors;
  EXPECT_FALSE(has(result.errors, "times in all")) << result.errors;
}

TEST(Cad, ABrokenFileIsAnErrorWithItsPlace) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(LAMINA_CRASHES "/step/segmentation",
                             folder.file("crash.step"));
  folder.write("noise.step", "noise");
  folder.write("a.scad", "cube(1);\nimport(\"noise.step\");");
  const auto noise = run(folder, {"a.scad", "-o", "a.slc"});
  EXPECT_EQ(noise.status, 1);
  EXPECT_TRUE(has(noise.errors,
                  "a.scad:2:1: error: STEP that is no exchange structure of "
                  "ISO 10303-21 importing file '"))
      << noise.errors;
  const auto crash = run(folder, {"crash.step", "-o", "a.slc"});
  EXPECT_EQ(crash.status, 1);
  EXPECT_TRUE(has(crash.errors, "OpenCASCADE fails on this STEP"))
      << crash.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.slc")));
}

TEST(Cad, ASolidThatIsLostEndsAStrictRun) {
  const TemporaryFolder folder;
  add_seed(folder, "step/cylinder", "part.step");
  std::ifstream file(folder.file("part.step"));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text.replace(text.find("(#11,#15)"), 9, "(#11,#15,#999)");
  folder.write("lost.step", text);
  const auto lost = run(folder, {"lost.step", "-o", "a.slc", "--strict"});
  EXPECT_EQ(lost.status, 1);
  EXPECT_TRUE(has(lost.errors, "warning: OpenCASCADE can't use 1 of "))
      << lost.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.slc")));
  EXPECT_EQ(run(folder, {"part.step", "-o", "a.slc", "--strict"}).status, 0);
}

TEST(Cad, AProgramWithoutItsModuleSaysWhatHelps) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(LAMINA_PROGRAM, folder.file("lamina"));
  add_seed(folder, "step/cylinder", "part.step");
  const auto result =
      support::run_process({folder.file("lamina"), "part.step"}, folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors,
                  "error: Can't find the module for STEP, IGES and BREP, "
                  "lamina_cad.so, in "))
      << result.errors;
  EXPECT_TRUE(has(result.errors, "the package lamina-cad has it"))
      << result.errors;
}

TEST(Cad, IsReadWithinARoot) {
  const TemporaryFolder folder;
  add_seed(folder, "step/cylinder", "part.step");
  add_seed(folder, "iges/cylinder", "part.iges");
  for (const char* name : {"part.step", "part.iges"}) {
    const auto result = run(folder, {name, "-q", "-o", "a.slc", "--root", "."});
    EXPECT_EQ(result.status, 0) << result.errors;
  }
  const TemporaryFolder other;
  add_seed(other, "step/cylinder", "part.step");
  folder.write("a.scad", "import(\"" + other.file("part.step") + "\");");
  EXPECT_EQ(run(folder, {"a.scad", "-o", "b.slc", "--root", "."}).status, 1);
  folder.write("b.scad", "import(\"part.step\");");
  EXPECT_EQ(run(folder, {"b.scad", "-o", "b.slc", "--no-import"}).status, 1);
}

TEST(Cad, KeepsToTheLimitsOfTheRun) {
  const TemporaryFolder folder;
  // Chords so short that they fill all time and memory.
  add_seed(folder, "step/cylinder", "part.step");
  const auto endless =
      run(folder, {"part.step", "--chordal-error", "1e-6", "--max-time", "1"});
  EXPECT_EQ(endless.status, 1);
  EXPECT_TRUE(has(endless.errors, "out of time")) << endless.errors;
  const auto hungry = run(
      folder, {"part.step", "--chordal-error", "1e-6", "--max-memory", "100M"});
  EXPECT_EQ(hungry.status, 1);
  EXPECT_TRUE(has(hungry.errors, "out of memory")) << hungry.errors;
}

}  // namespace
}  // namespace lamina::cli
