#include "tests/oracle/openscad.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/exact_region.h"
#include "tests/support/temporary_folder.h"

namespace lamina::oracle {
namespace {

class OpenScad : public ::testing::Test {
 protected:
  OpenScad() { ::setenv("LAMINA_TEST_CACHE", folder_.path().c_str(), 1); }

  std::string write(const std::string& text) const {
    return folder_.write("design.scad", text);
  }

  const support::TemporaryFolder folder_;
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
  const support::TemporaryFolder folder;
  EXPECT_THROW(
      read_binary_stl(folder.write("truncated.stl", std::string(100, '\1'))),
      std::runtime_error);
}

TEST(Float32Spacing, IsThatOfTheLargestCoordinate) {
  csg::Mesh mesh;
  mesh.vertices = {{1, 2, -70}, {3, 4, 5}};
  EXPECT_DOUBLE_EQ(float32_spacing(mesh), 0x1p-17);
}

}  // namespace
}  // namespace lamina::oracle
