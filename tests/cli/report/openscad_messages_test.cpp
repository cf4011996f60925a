// What is wrong with a design's geometry is reported in OpenSCAD's words: all
// messages of both programs, for one mistake each.

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;
using Messages = std::set<std::string>;

// Without what only lamina, or only OpenSCAD, says of a result.
bool is_about_the_design(const std::string& message) {
  return message.find("top level object") == std::string::npos &&
         message.find("2-manifold") == std::string::npos;
}

// "WARNING: text in file design.scad, line 1" and "ERROR: text".
Messages openscad_messages(const std::string& errors) {
  Messages messages;
  std::istringstream lines(errors);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string_view kind : {"WARNING: ", "ERROR: "}) {
      if (!line.starts_with(kind)) continue;
      std::string text = line.substr(kind.size());
      text.erase(
          std::min(text.find(" in file design.scad, line"), text.size()));
      if (text.ends_with(',')) text.pop_back();
      if (is_about_the_design(text)) messages.insert(text);
    }
  }
  return messages;
}

// "design.scad:1:1: warning: text", also without a place.
Messages lamina_messages(const std::string& errors) {
  Messages messages;
  std::istringstream lines(errors);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string_view kind : {"warning: ", "error: "}) {
      const std::size_t begin = line.find(kind);
      if (begin == std::string::npos) continue;
      const std::string text = line.substr(begin + kind.size());
      if (is_about_the_design(text)) messages.insert(text);
    }
  }
  return messages;
}

TEST(Messages, OnGeometryAreOpenScads) {
  const char* const designs[] = {
      "scale([0, 1, 1]) cube(1);",
      "scale([0, 1, 1]) { cube(1); cube(2); }",
      "scale([0, 1, 1]) difference() { cube(1); cube(0); }",
      "scale([0, 1]) square(1);",
      "multmatrix([[0 / 0]]) cube(1);",
      "projection(cut = true) translate([0, 0, 1]) cube(1);",
      "projection(cut = true) cylinder(h = 4, r1 = 0, r2 = 1);",
      "projection() scale([1, 1, 0]) cube(1);",
      "projection(cut = true) { cube(1); square(1); }",
      "union() { square(1); cube(1); }",
      "difference() { cube(1); square(1); sphere(3); }",
      "hull() { cube(1); square(1); }",
      "hull() polyhedron([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]], "
      "[[0, 1, 2, 3]]);",
      "hull() { scale([1, 1, 0]) cube(1); translate([0, 0, 3]) "
      "polyhedron([[0, 0, 0], [3, 0, 0]], [[0, 1]]); }",
      "linear_extrude(2) cube(1);",
      "rotate_extrude() square(4, center = true);",
      "polygon([[0, 0], [3, 0], [0, \"a\"]]);",
      "polygon([[0, 0], [3, 0], [0]]);",
      "polygon([[0, 0], [3, 0], [0, 1 / 0]]);",
      "polygon([[0, 0], [3, 0], [0, 0 / 0]]);",
      "polygon([[0, 0], [3, 0], undef]);",
      "polygon([[0, 0], [3, 0], [0, 3]], [[0, 1, -1]]);",
      "polygon([[0, 0], [3, 0], [0, 3]], [[0, 1, 7]]);",
      // Beside a cube in a hull, where what is left of the faces does not
      // matter.
      "hull() { cube(1); polyhedron([[0, 0, 0], [2, 0, 0], [0, 0 / 0, 2]], "
      "[[0, 1, 2]]); }",
      "hull() { cube(1); polyhedron([undef, [2, 0, 0], [0, 2, 0], 7], "
      "[[1, 2, 3], [0, 1, 2]]); }",
      "hull() { cube(1); polyhedron([undef, [2, 0, 0], [0, 2, 0], [0, 0, 7]], "
      "[[1, 2, 3], [1, 2, -1]]); }",
      "import(\"nothing.stl\");",
      "import(\"nothing.dxf\");",
      "surface(\"nothing.dat\");",
      "import(\"drawing.svg\", dpi = -5, origin = [1, 2]);",
  };
  const TemporaryFolder folder;
  folder.write("drawing.svg",
               "<svg width=\"9\" height=\"9\"><rect x=\"1\" y=\"1\" "
               "width=\"5\" height=\"5\"/></svg>");
  for (const std::string design : designs) {
    folder.write("design.scad", design);
    // What is flat cannot become a mesh, which OpenSCAD says besides.
    const auto openscad = support::run_process(
        {"openscad", "-o", "design.stl", "design.scad"}, folder.path());
    const auto lamina =
        run(folder, {"design.scad", "-o", "design.layers.json"});
    EXPECT_LE(lamina.status, 1) << design;
    EXPECT_EQ(lamina_messages(lamina.errors),
              openscad_messages(openscad.errors))
        << design;
  }
}

}  // namespace
}  // namespace lamina::cli
