// lamina --dump: one layer between two stages, against figures that are known;
// and the example of docs/wrong-contour.md, command by command.

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::ProcessResult;
using support::TemporaryFolder;

class Dump : public ::testing::Test {
 protected:
  // A square of side 4 without one that stands on a corner, of half diagonal 1;
  // and a cube that ends below.
  Dump() {
    folder_.write("d.scad",
                  "difference() {\n"
                  "  cube([4, 4, 2]);\n"
                  "  translate([2, 2, -1]) cylinder(r = 1, h = 4, $fn = 4);\n"
                  "}\n"
                  "translate([5, 0, 0]) cube(1);\n");
  }

  ProcessResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "d.scad");
    return cli::run(folder_, arguments);
  }

  std::string text_of(const std::string& stage) {
    const ProcessResult result = run({"--dump", stage, "--at", "1.51"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.errors, "");
    return result.output;
  }

  TemporaryFolder folder_;
};

constexpr const char* kTitle =
    ": section at height 1.525 of the layer from 1.5 to 1.55\n";

TEST_F(Dump, SceneShowsTheProgramAndWhatMeetsTheLayer) {
  EXPECT_EQ(text_of("scene"),
            "scene" + std::string(kTitle) +
                "leaves: 2, instances: 3, operators: 2; * meets the layer\n"
                "  union\n"
                "    #2 d.scad:5:22: x 5 to 6, y 0 to 1, z 0 to 1, leaf 0, "
                "loft of 4 x 2\n"
                "    difference\n"
                "*     #0 d.scad:2:3, minuend: x 0 to 4, y 0 to 4, z 0 to 2, "
                "leaf 0, loft of 4 x 2\n"
                "*     #1 d.scad:3:25: x 1 to 3, y 1 to 3, z -1 to 3, leaf 1, "
                "loft of 4 x 2\n");
}

TEST_F(Dump, ChainsRunFromLeftToRight) {
  EXPECT_EQ(text_of("chains"),
            "chains" + std::string(kTitle) +
                "chains: 4, loops: 2\n"
                "chain 0 of loop 0, #0 d.scad:2:3, solid below\n"
                "    0 4\n"
                "    4 4\n"
                "chain 1 of loop 0, #0 d.scad:2:3, solid above\n"
                "    0 0\n"
                "    4 0\n"
                "chain 2 of loop 1, #1 d.scad:3:25, solid above\n"
                "    1 2\n"
                "    2 1\n"
                "    3 2\n"
                "chain 3 of loop 1, #1 d.scad:3:25, solid below\n"
                "    1 2\n"
                "    2 3\n"
                "    3 2\n");
}

TEST_F(Dump, EventsShowWhereTheHoleBeginsAndEnds) {
  EXPECT_EQ(
      text_of("events"),
      "events" + std::string(kTitle) +
          "event points: 4; a ray runs upwards, [ ] enclose solid, = is a tie\n"
          "event 1 at x 0\n"
          "  begins: 1 0\n"
          "  boundary begins: [1 0]\n"
          "  ray: [1 0]\n"
          "event 2 at x 1\n"
          "  begins: 2 3\n"
          "  boundary begins: 2] [3\n"
          "  ray: [1 2] [3 0]\n"
          "event 3 at x 3\n"
          "  ends: 2 3\n"
          "  boundary ends: 2] [3\n"
          "  ray: [1 0]\n"
          "event 4 at x 4\n"
          "  ends: 1 0\n"
          "  boundary ends: [1 0]\n");
}

TEST_F(Dump, ContoursHaveAreasAndLeaves) {
  EXPECT_EQ(text_of("contours"), "contours" + std::string(kTitle) +
                                     "loops: 2\n"
                                     "loop 0, outer, area 16, 4 points\n"
                                     "  of loop 0, #0 d.scad:2:3\n"
                                     "    4 4\n"
                                     "    0 4\n"
                                     "    0 0\n"
                                     "    4 0\n"
                                     "    4 4\n"
                                     "loop 1, hole, area -2, 4 points\n"
                                     "  of loop 1, #1 d.scad:3:25\n"
                                     "    3 2\n"
                                     "    2 1\n"
                                     "    1 2\n"
                                     "    2 3\n"
                                     "    3 2\n");
}

// The number of shapes of a kind that the drawing of a stage has; each has a
// title.
std::size_t count_shapes(const pugi::xml_document& drawing, const char* name) {
  std::size_t count = 0;
  for (const pugi::xml_node shape :
       drawing.child("svg").child("g").children(name)) {
    EXPECT_STRNE(shape.child_value("title"), "");
    ++count;
  }
  return count;
}

TEST_F(Dump, DrawingsShowTheItemsOverTheContours) {
  struct Shapes {
    std::string stage;
    std::size_t lines;
    std::size_t marks;
  };
  for (const auto& [stage, lines, marks] :
       {Shapes{"scene", 6, 0}, Shapes{"chains", 4, 0}, Shapes{"events", 4, 8},
        Shapes{"contours", 2, 0}}) {
    ASSERT_EQ(run({"--dump", stage, "--at", "1.51", "-o", "d.svg"}).status, 0);
    pugi::xml_document drawing;
    ASSERT_TRUE(
        drawing.load_string(support::read_file(folder_.file("d.svg")).c_str()));
    EXPECT_EQ(count_shapes(drawing, "polyline"), lines) << stage;
    EXPECT_EQ(count_shapes(drawing, "circle"), marks) << stage;
    const std::string loops =
        drawing.child("svg").child("g").child("path").attribute("d").value();
    EXPECT_EQ(std::ranges::count(loops, 'M'), 2) << stage;
    EXPECT_NE(loops.find("3,2 "), std::string::npos) << loops;
  }
}

TEST_F(Dump, TextGoesToAFileToo) {
  EXPECT_EQ(run({"--dump", "chains", "--at", "1.51", "-o", "d.txt"}).output,
            "");
  EXPECT_EQ(support::read_file(folder_.file("d.txt")), text_of("chains"));
}

// The layer of a height on the border of two is the upper one.
TEST_F(Dump, TheLayerHoldsItsBottom) {
  EXPECT_TRUE(run({"--dump", "scene", "--at", "0.5", "--layer", "0.5"})
                  .output.starts_with(
                      "scene: section at height 0.75 of the layer from 0.5"));
  EXPECT_TRUE(run({"--dump", "scene", "--at", "0.7", "--heights", "0.5,0.7"})
                  .output.starts_with("scene: section at height 0.7 "));
}

TEST_F(Dump, NeedsALayerThatIsThere) {
  const ProcessResult result = run({"--dump", "chains", "--at", "9"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors,
            "error: No layer is at height 9; the nearest reaches from 1.95 to "
            "2.\n");
}

TEST_F(Dump, RefusesWhatHasNoMeaning) {
  const auto refusal = [&](std::vector<std::string> arguments) {
    const ProcessResult result = run(std::move(arguments));
    EXPECT_EQ(result.status, 2);
    return result.errors.substr(0, result.errors.find('\n'));
  };
  EXPECT_EQ(refusal({"--dump", "scene"}),
            "lamina: --dump needs --at, a height in the layer");
  EXPECT_EQ(refusal({"--at", "1"}), "lamina: --at needs --dump");
  EXPECT_EQ(refusal({"--dump", "scene", "--at", "1", "--report", "r.json"}),
            "lamina: --report needs layers");
  EXPECT_EQ(refusal({"--dump", "scene", "--at", "1", "--min-feature", "1"}),
            "lamina: --min-feature needs layers");
  EXPECT_EQ(refusal({"--dump", "scene", "--at", "1", "--contour", "paper"}),
            "lamina: --dump needs --contour faithful");
  EXPECT_EQ(refusal({"--dump", "scene", "--at", "1", "--watch"}),
            "lamina: --dump needs one design, and no --watch");
  EXPECT_EQ(refusal({"--dump", "scene", "--at", "1", "-o", "d.slc"}),
            "lamina: --dump writes text, to standard output or .txt, or a "
            "drawing, to .svg");
  EXPECT_EQ(run({"--dump", "all", "--at", "1"}).status, 2);
  EXPECT_EQ(run({"--dump", "scene", "--at", "nan"}).status, 2);
}

// A command of a page, and lines that it prints, in this order.
struct Shown {
  std::vector<std::string> words;
  std::vector<std::string> lines;
};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

// Writes the page's designs, and returns its commands.
std::vector<Shown> commands_of(const std::string& page,
                               const TemporaryFolder& folder) {
  std::vector<Shown> commands;
  std::istringstream lines(page);
  std::string design;
  std::string name;
  bool is_design = false;
  bool is_command = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      if (is_design) folder.write(name, design);
      is_design = line == "```scad";
      design.clear();
    } else if (is_design) {
      if (line.starts_with("// ")) name = line.substr(3);
      design += line + '\n';
    } else if (line.starts_with("    lamina ")) {
      commands.push_back({words_of(line.substr(11)), {}});
      is_command = true;
    } else if (is_command && line.starts_with("    ")) {
      if (line != "    …") commands.back().lines.push_back(line.substr(4));
    } else {
      is_command = false;
    }
  }
  return commands;
}

TEST(WrongContour, ThePageShowsWhatItsCommandsPrint) {
  const std::string page = support::read_file(LAMINA_WRONG_CONTOUR);
  const TemporaryFolder folder;
  const auto commands =
      commands_of(page.substr(page.find("## A worked example")), folder);
  ASSERT_GE(commands.size(), 4U);
  for (const Shown& shown : commands) {
    const ProcessResult result = run(folder, shown.words);
    EXPECT_EQ(result.status, 0) << result.errors;
    std::size_t at = 0;
    const std::string output = '\n' + result.output;
    for (const std::string& line : shown.lines) {
      const std::size_t found = output.find('\n' + line + '\n', at);
      ASSERT_NE(found, std::string::npos) << line << "\nis not in" << output;
      at = found + line.size();
    }
  }
}

}  // namespace
}  // namespace lamina::cli
