// Meshes and drawings in the place of a design.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
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

// A file by itself is read as slicers read it, import() as OpenSCAD.
TEST(Imported, AFileOfInchesIsPlacedInItsUnit) {
  const TemporaryFolder folder;
  std::string vertices;
  for (const char* const corner : {"000", "100", "010", "001"}) {
    vertices += "<vertex><coordinates><x>" + std::string(1, corner[0]) +
                "</x><y>" + corner[1] + "</y><z>" + corner[2] +
                "</z></coordinates></vertex>";
  }
  std::string triangles;
  for (const char* const face : {"021", "013", "123", "032"}) {
    triangles += "<triangle><v1>" + std::string(1, face[0]) + "</v1><v2>" +
                 face[1] + "</v2><v3>" + face[2] + "</v3></triangle>";
  }
  folder.write("a.amf",
               "<amf unit=\"inch\"><object id=\"1\"><mesh><vertices>" +
                   vertices + "</vertices><volume>" + triangles +
                   "</volume></mesh></object><constellation id=\"2\">"
                   "<instance objectid=\"1\"/><instance objectid=\"1\">"
                   "<deltax>2</deltax></instance></constellation></amf>");
  folder.write("b.scad",
               "for (x = [0, 50.8]) translate([x, 0, 0]) scale(25.4) "
               "polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "
               "[[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]);");
  folder.write("c.scad", "import(\"a.amf\");");
  for (const std::string language : {"2021", "2026"}) {
    const auto compared =
        run(folder, {"compare", "a.amf", "b.scad", "--language", language});
    EXPECT_EQ(compared.status, 0) << compared.output << compared.errors;
  }
  const auto imported = run(folder, {"c.scad"});
  EXPECT_NE(imported.errors.find(" x 1 mm, "), std::string::npos)
      << imported.errors;
  EXPECT_NE(imported.errors.find("has lengths in the unit 'inch'"),
            std::string::npos);
  EXPECT_NE(imported.errors.find("places 2 instances"), std::string::npos);
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

// PrusaSlicer and OpenSCAD open it as a box, so its name says what it is.
TEST(Imported, SlicesOf3mfAreNoMesh) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(3);");
  const auto expect = [&](const std::vector<std::string>& words, int status,
                          const std::string& told) {
    const auto result = run(folder, words);
    EXPECT_EQ(result.status, status) << result.errors;
    EXPECT_TRUE(has(result.errors, told)) << result.errors;
  };
  expect({"a.scad", "-o", "a.3mf"}, 1,
         "it writes no .3mf; the nearest output is .slices.3mf, which "
         "programs that know no slices open as a box");
  expect({"a.scad", "-o", "a.slices.3mf"}, 0,
         "programs that know no slices open this 3MF as a box");
  expect({"a.slices.3mf"}, 2, "'a.slices.3mf' holds layers already; try");
  std::filesystem::rename(folder.file("a.slices.3mf"), folder.file("b.3mf"));
  expect({"b.3mf"}, 1, "holds layers already, and its mesh is only");
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.slc")));
  folder.write("c.scad", "import(\"b.3mf\");");
  expect({"c.scad"}, 0, "its mesh is only a placeholder");
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
