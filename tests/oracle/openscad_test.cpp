#include "tests/oracle/openscad.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/exact_region.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

class OpenScad : public ::testing::Test {
 protected:
  OpenScad() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    ::setenv("LAMINA_TEST_CACHE", folder_.c_str(), 1);
  }
  ~OpenScad() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text) {
    fs::path path = folder_ / "design.scad";
    std::ofstream(path) << text;
    return path;
  }

  fs::path folder_ =
      fs::path(::testing::TempDir()) /
      ("lamina_openscad_" +
       std::string(
           ::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(OpenScad, RendersABooleanWhoseSectionsAreRight) {
  const csg::Mesh mesh = render_with_openscad(
      write("difference() { cube(4); translate([1, 1, 1]) cube([1, 1, 4]); }"));
  EXPECT_NEAR(csg::signed_volume(mesh), 64 - 3, 1e-9);
  EXPECT_EQ(exact_area(exact_section(mesh, 0.5, 0)), "16");
  EXPECT_EQ(exact_area(exact_section(mesh, 1.5, 0)), "15");
  EXPECT_EQ(count_regions(exact_section(mesh, 1.5, 0)), (RegionCounts{1, 1}));
}

TEST_F(OpenScad, FailsLoudly) {
  try {
    render_with_openscad(write("cube(;"));
    FAIL() << "a syntax error went unnoticed";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("syntax error"), std::string::npos)
        << error.what();
  }
}

TEST(ReadBinaryStl, RefusesATruncatedFile) {
  const fs::path path = fs::path(::testing::TempDir()) / "truncated.stl";
  std::ofstream(path, std::ios::binary) << std::string(100, '\1');
  EXPECT_THROW(read_binary_stl(path), std::runtime_error);
  fs::remove(path);
}

TEST(Float32Spacing, IsThatOfTheLargestCoordinate) {
  csg::Mesh mesh;
  mesh.vertices = {{1, 2, -70}, {3, 4, 5}};
  EXPECT_DOUBLE_EQ(float32_spacing(mesh), 0x1p-17);
}

}  // namespace
}  // namespace lamina::oracle
