// Meshes and drawings in the place of a design.

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::read_file;
using support::TemporaryFolder;

constexpr char kTetrahedron[] =
    "OFF\n4 4 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n"
    "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

TEST(Imported, AMeshIsSlicedAsTheDesignThatImportsIt) {
  for (const std::string name : {"a \"b\"", "a\\b", "a\n\r\tb"}) {
    const TemporaryFolder folder;
    folder.write(name + ".OFF", kTetrahedron);
    folder.write("plain.off", kTetrahedron);
    folder.write("design.scad", R"(import("plain.off");)");
    const auto mesh = run(folder, {name + ".OFF", "--scale", "1.5"});
    ASSERT_EQ(mesh.status, 0) << mesh.errors;
    EXPECT_EQ(mesh.errors.find("warning"), std::string::npos) << mesh.errors;
    ASSERT_EQ(run(folder, {"design.scad", "--scale", "1.5"}).status, 0);
    EXPECT_EQ(read_file(folder.file(name + ".slc")),
              read_file(folder.file("design.slc")));
  }
}

TEST(Imported, CommandsThatTakeDesignsTakeMeshes) {
  const TemporaryFolder folder;
  folder.write("a.off", kTetrahedron);
  EXPECT_EQ(run(folder, {"inspect", "a.off"}).status, 0);
  EXPECT_EQ(run(folder, {"view", "a.off", "-o", "a.png"}).status, 0);
}

TEST(Imported, AMissingMeshEndsWithOne) {
  const TemporaryFolder folder;
  const auto result = run(folder, {"a.stl"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.errors.find("Can't open import file"), std::string::npos)
      << result.errors;
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(Imported, TheMeshBesideSlicesIsNoneToCount) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(3);");
  ASSERT_EQ(run(folder, {"a.scad", "-o", "a.3mf"}).status, 0);
  const auto result = run(folder, {"a.3mf"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.errors.find("its mesh only stands in for them"),
            std::string::npos)
      << result.errors;
}

TEST(Imported, PicturesAreRefused) {
  const TemporaryFolder folder;
  for (const char* const command : {"inspect", "view"}) {
    const auto result = run(folder, {command, "b.png", "-o", "a.png"});
    EXPECT_EQ(result.status, 2) << command << ' ' << result.errors;
  }
  const auto result = run(folder, {"inspect", "b.png"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.errors.find("inspect reads files of layers"),
            std::string::npos)
      << result.errors;
}

}  // namespace
}  // namespace lamina::cli
