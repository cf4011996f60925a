// Scans: PLY as a design, --decimate, import(decimate =), and what inspect says
// of a mesh.

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::read_file;
using support::TemporaryFolder;

constexpr double kRadius = 3;
constexpr int kAcross = 60;

// A torus of ring radius 10 and tube radius 3 as a text PLY.
std::string torus(int around = 200) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      around * kAcross, around * kAcross);
  for (int i = 0; i < around; ++i) {
    const double a = 2 * std::numbers::pi * i / around;
    for (int j = 0; j < kAcross; ++j) {
      const double b = 2 * std::numbers::pi * j / kAcross;
      const double r = 10 + kRadius * std::cos(b);
      text += fmt::format("{} {} {}\n", r * std::cos(a), r * std::sin(a),
                          kRadius * std::sin(b));
    }
  }
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    for (int j = 0; j < kAcross; ++j) {
      const int k = (j + 1) % kAcross;
      text +=
          fmt::format("4 {} {} {} {}\n", i * kAcross + j, next * kAcross + j,
                      next * kAcross + k, i * kAcross + k);
    }
  }
  return text;
}

nlohmann::json inspected(const TemporaryFolder& folder,
                         const std::string& file) {
  const auto result = run(folder, {"inspect", file, "--json", "-q"});
  EXPECT_EQ(result.status, 0) << result.errors;
  return nlohmann::json::parse(result.output);
}

TEST(Scan, IsSlicedAndInspectedAsADesign) {
  const TemporaryFolder folder;
  folder.write("a.PLY", torus());
  const auto sliced = run(folder, {"a.PLY"});
  ASSERT_EQ(sliced.status, 0) << sliced.errors;
  EXPECT_EQ(sliced.errors.find("warning"), std::string::npos) << sliced.errors;
  const nlohmann::json found = inspected(folder, "a.PLY");
  ASSERT_EQ(found.at("meshes").size(), 1U);
  const nlohmann::json& mesh = found.at("meshes")[0];
  EXPECT_EQ(mesh.at("vertices"), 200 * kAcross);
  EXPECT_EQ(mesh.at("triangles"), 2 * 200 * kAcross);
  EXPECT_EQ(mesh.at("components"), 1);
  EXPECT_EQ(mesh.at("genus"), 1);
  EXPECT_EQ(mesh.at("boundary_loops"), 0);
  EXPECT_EQ(mesh.at("non_manifold_edges"), 0);
  EXPECT_EQ(mesh.at("is_closed"), true);
  EXPECT_NEAR(mesh.at("volume_mm3").get<double>(),
              2 * std::numbers::pi * std::numbers::pi * 10 * 9, 5);
  EXPECT_NEAR(mesh.at("area_mm2").get<double>(),
              4 * std::numbers::pi * std::numbers::pi * 10 * 3, 3);
  const auto text = run(folder, {"inspect", "a.PLY", "-q"});
  EXPECT_NE(text.output.find("\nmesh      12000 vertices, 24000 triangles; "
                             "closed\nsurface   1 component, genus 1, 0 "
                             "boundary loops\n"),
            std::string::npos)
      << text.output;
}

TEST(Scan, InspectTellsOfHolesBeforeTheyAreClosed) {
  const TemporaryFolder folder;
  std::string open = torus();
  open.replace(open.find("element face 12000"), 18, "element face 11999");
  folder.write("a.ply", open.substr(0, open.rfind("\n4 ") + 1));
  const auto result = run(folder, {"inspect", "a.ply"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.errors.find("The given mesh is not closed!"),
            std::string::npos)
      << result.errors;
  EXPECT_NE(result.output.find("; not closed\nsurface   1 component, genus 1, "
                               "1 boundary loop\nedges     4 open\n"),
            std::string::npos)
      << result.output;
}

TEST(Scan, DecimationKeepsTheVolumeAndSaysWhatItDid) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus());
  const auto result = run(
      folder, {"a.ply", "--scale", "2", "--decimate", "0.1", "-o", "a.slc"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.errors.find(" of 24000 triangles, within 0.05 of the "
                               "file's surface"),
            std::string::npos)
      << result.errors;
  ASSERT_EQ(run(folder, {"a.ply", "--scale", "2", "-o", "b.slc"}).status, 0);
  const double whole = inspected(folder, "b.slc").at("volume_mm3");
  const double thinned = inspected(folder, "a.slc").at("volume_mm3");
  const double area = 4 * 4 * std::numbers::pi * std::numbers::pi * 10 * 3;
  EXPECT_NE(thinned, whole);
  EXPECT_NEAR(thinned, whole, 0.1 * area);
}

TEST(Scan, TheDesignDecidesBeforeTheCommandLine) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus());
  folder.write("a.scad", "import(\"a.ply\", decimate = 0);");
  folder.write("b.scad", "import(\"a.ply\");");
  ASSERT_EQ(run(folder, {"a.scad", "--decimate", "0.1"}).status, 0);
  ASSERT_EQ(run(folder, {"b.scad"}).status, 0);
  EXPECT_EQ(read_file(folder.file("a.slc")), read_file(folder.file("b.slc")));
}

// Of a file named twice, below an operator that is lowered apart.
TEST(Scan, IsDecimatedOnceForTheWholeDesign) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus(50));
  folder.write("a.scad",
               "module scan() import(\"a.ply\", decimate = 0.1);\n"
               "resize([30, 0, 0], auto = true) scan();\n"
               "translate([0, 0, 9]) difference() { scan(); cube(9); }\n");
  const auto result = run(folder, {"a.scad"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::size_t first = result.errors.find("triangles, within");
  ASSERT_NE(first, std::string::npos) << result.errors;
  EXPECT_EQ(result.errors.find("triangles, within", first + 1),
            std::string::npos)
      << result.errors;
  EXPECT_EQ(result.errors.find("times in all"), std::string::npos)
      << result.errors;
}

// What is resized is lowered more than once.
TEST(Scan, SaysWhatDecimationDidBelowResizeToo) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus(50));
  folder.write("a.scad",
               "resize([60, 0, 0], auto = true) {\n"
               "  import(\"a.ply\", decimate = 0.1);\n  sphere(9);\n}\n");
  const auto result = run(folder, {"a.scad", "--chordal-error", "0.05"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.errors.find("triangles, within 0.1 of"), std::string::npos)
      << result.errors;
}

TEST(Scan, DecimateStandsInCsgOnlyWhereItWasGiven) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus(20));
  const auto csg = [&](const std::string& arguments) {
    folder.write("a.scad", "import(\"a.ply\"" + arguments + ");");
    const auto result = run(folder, {"a.scad", "-o", "a.csg"});
    EXPECT_EQ(result.status, 0) << result.errors;
    return read_file(folder.file("a.csg"));
  };
  EXPECT_EQ(csg("").find("decimate"), std::string::npos);
  const std::string text = csg(", decimate = 0.02");
  EXPECT_NE(text.find("decimate = 0.02, convexity"), std::string::npos) << text;
  // The text is a design again.
  folder.write("b.csg", text);
  ASSERT_EQ(run(folder, {"b.csg", "-o", "c.csg"}).status, 0);
  EXPECT_EQ(read_file(folder.file("c.csg")), text);
}

TEST(Scan, DistancesThatAreNoneAreRefused) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus(20));
  for (const std::string value : {"-1", "1e-9", "nan", "\"x\"", "[1]", "1/0"}) {
    folder.write("a.scad",
                 "nan = 0/0; import(\"a.ply\", decimate = " + value + ");");
    const auto result = run(folder, {"a.scad"});
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.errors.find("expected a distance of at least 0.000001, "
                                 "or 0 for none"),
              std::string::npos)
        << value << result.errors;
  }
  for (const std::string value : {"-1", "0", "nan", "inf", "x", "1e-9"}) {
    const auto result = run(folder, {"a.ply", "--decimate", value});
    EXPECT_EQ(result.status, 2) << value;
    EXPECT_NE(result.errors.find("--decimate"), std::string::npos)
        << result.errors;
  }
}

TEST(Scan, BrokenFilesEndWithAMessage) {
  const TemporaryFolder folder;
  const std::string whole = torus(20);
  folder.write("a.ply", whole.substr(0, whole.size() / 2));
  folder.write("b.off", "OFF");
  for (const std::string name : {"a.ply", "b.off"}) {
    const auto result = run(folder, {name, "--decimate", "0.1"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.errors.find("importing file '"), std::string::npos)
        << result.errors;
  }
}

TEST(Scan, SharesTheDistanceWithTheOtherTermOfASum) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus());
  folder.write("b.scad", "minkowski() { import(\"a.ply\"); cube(1); }");
  const auto result = run(folder, {"b.scad", "--decimate", "0.1"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.errors.find("triangles, within 0.05 of the "),
            std::string::npos)
      << result.errors;
}

TEST(Scan, IsDecimatedInARootToo) {
  const TemporaryFolder folder;
  folder.write("a.ply", torus(20));
  const auto result =
      run(folder, {"a.ply", "--decimate", "0.1", "--root", "."});
  EXPECT_EQ(result.status, 0) << result.errors;
}

}  // namespace
}  // namespace lamina::cli
