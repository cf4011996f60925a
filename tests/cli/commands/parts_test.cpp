// lamina parts, and --part.

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/base/file/zip_writer.h"
#include "tests/cli/lamina.h"
#include "tests/csg/import/freecad/freecad_document.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
using support::TemporaryFolder;

// A box of 3MF with its lower corner in the origin.
std::string box(const std::string& id, const std::string& name, double height) {
  std::string vertices;
  for (int i = 0; i < 8; ++i) {
    vertices += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", i & 1,
                            i / 2 & 1, i < 4 ? 0 : height);
  }
  std::string triangles;
  for (const char* const corners : {"021", "123", "456", "576", "014", "154",
                                    "236", "376", "042", "264", "135", "573"}) {
    triangles += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>",
                             corners[0], corners[1], corners[2]);
  }
  return fmt::format(
      "<object id=\"{}\" name=\"{}\"><mesh><vertices>{}</vertices>"
      "<triangles>{}</triangles></mesh></object>",
      id, name, vertices, triangles);
}

// A lid twice on the plate, of which one is raised, and a pin that is not.
std::string plate() {
  return csg::make_zip(
      {{"3D/3dmodel.model",
        "<model unit=\"millimeter\"><resources>" + box("1", "Lid", 2) +
            box("2", "Pin", 5) +
            "<object id=\"3\"><components><component objectid=\"1\"/>"
            "</components></object></resources><build><item objectid=\"1\"/>"
            "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 4 0 8\"/>"
            "</build></model>"}});
}

std::string two_boxes() {
  return csg::FreecadDocument()
      .box("Box", "3", csg::label("Lid"))
      .box("Box001", "2", csg::flag("Visibility", false))
      .add("Sketcher::SketchObject", "Sketch", csg::shape("s"))
      .bytes();
}

TEST(Parts, AreListedWithWhatNamesThem) {
  const TemporaryFolder folder;
  folder.write("a.FCStd", two_boxes());
  EXPECT_EQ(run(folder, {"parts", "a.FCStd"}).output,
            "name    label  shown   what\n"
            "Box     Lid    yes     Part::Box\n"
            "Box001         no      Part::Box\n");
  folder.write("a.3mf", plate());
  EXPECT_EQ(run(folder, {"parts", "a.3mf"}).output,
            "name  label  shown   what\n"
            "1     Lid    yes     12 triangles\n"
            "2     Pin    no      12 triangles\n"
            "3            yes     made of others\n");
}

// A cylinder of radius 5 and height 12, and what names it in the file.
TEST(Parts, OfCadFilesHaveNumbersAndNames) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(std::string(LAMINA_SEEDS) + "/step/cylinder",
                             folder.file("a.step"));
  const std::string name = "Open CASCADE STEP translator 7.6 1";
  const std::string listed = run(folder, {"parts", "a.step"}).output;
  EXPECT_TRUE(listed.starts_with(
      "name  label                               shown   what\n"
      "1     " +
      name + "  yes     "))
      << listed;
  EXPECT_TRUE(listed.ends_with(" x 12 mm\n")) << listed;
  for (const std::string& part : {std::string("1"), name}) {
    EXPECT_TRUE(
        has(run(folder, {"a.step", "--part", part}).errors, " x 12 mm"));
  }
  const auto none = run(folder, {"a.step", "--part", "2"});
  EXPECT_EQ(none.status, 1);
  EXPECT_TRUE(has(none.errors, "there is no part '2'")) << none.errors;
}

TEST(Parts, AreSlicedOneByOne) {
  const TemporaryFolder folder;
  folder.write("a.FCStd", two_boxes());
  folder.write("a.3mf", plate());
  const auto volume = [&](const std::string& file, const std::string& part) {
    const auto result = run(folder, {file, "--part", part});
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.errors;
  };
  EXPECT_TRUE(has(volume("a.FCStd", "Lid"), "3 x 4 x 5 mm, 60 mm³"));
  EXPECT_TRUE(has(volume("a.FCStd", "Box001"), "2 x 4 x 5 mm, 40 mm³"));
  EXPECT_TRUE(has(volume("a.3mf", "Lid"), "5 x 1 x 10 mm, 4 mm³"));
  EXPECT_TRUE(has(volume("a.3mf", "3"), "1 x 1 x 2 mm, 2 mm³"));
  folder.write("a.scad", "import(\"a.3mf\", part = \"Pin\");");
  EXPECT_TRUE(has(run(folder, {"a.scad"}).errors, "1 x 1 x 5 mm, 5 mm³"));
}

TEST(Parts, AreNamedWhereThereAreNone) {
  const TemporaryFolder folder;
  folder.write("a.3mf", plate());
  folder.write("a.scad", "cube(1);");
  folder.write("b.3mf", "junk");
  EXPECT_TRUE(has(run(folder, {"a.3mf", "--part", "Nut"}).errors,
                  "3MF, there is no part 'Nut'"));
  EXPECT_TRUE(
      has(run(folder, {"a.scad", "--part", "Lid"}).errors,
          "--part names a part of a CAD file or a 3MF; 'a.scad' is neit"));
  EXPECT_TRUE(
      has(run(folder, {"parts", "a.scad"}).errors,
          "parts lists those of a CAD file or a 3MF; 'a.scad' is neither"));
  for (const std::string file : {"b.3mf", "none.3mf"}) {
    const auto result = run(folder, {"parts", file});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(has(result.errors, file)) << result.errors;
  }
}

}  // namespace
}  // namespace lamina::cli
