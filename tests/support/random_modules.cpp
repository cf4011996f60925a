#include "tests/support/random_modules.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace lamina::support {
namespace {

// A grammar: what each name stands for, one of its alternatives. <name> in a
// text is put in its place, from left to right. Likelier ones stand there more
// than once; the first one is the simplest, and the only one where the design
// is as deep or as large as it may be.
using Alternatives = std::vector<std::string_view>;
const std::map<std::string_view, Alternatives>& grammar() {
  static const std::map<std::string_view, Alternatives> rules = {
      // --- Numbers ----------------------------------------------------------
      {"length", {"2", "1", "3", "4", "0.5", "1.5", "2.5", "2", "1", "0"}},
      {"place", {"0", "1", "-1", "2", "-2", "0.5", "-0.5", "3", "0.25", "1.5"}},
      {"facets", {"4", "3", "5", "6", "8", "7"}},
      {"truth", {"false", "true"}},
      {"right_angle", {"0", "90", "180", "270", "-90"}},
      {"angle", {"45", "30", "0", "60", "90", "10", "15", "0.00001"}},
      {"entry", {"0", "0", "1", "-1", "0.5"}},
      {"one", {"1", "1", "1", "1", "1", "2", "-1", "0"}},

      // --- Solids -----------------------------------------------------------
      {"solid",
       {"<move><leaf>", "<move><leaf>", "<move>union() {<solids>}",
        "<move>union() {<solids>}", "<move>difference() {<solids>}",
        "<move>difference() {<solids>}", "<move>difference() {<solids>}",
        "<move>intersection() {<solids>}", "<move>hull() {<solids>}",
        "<move>minkowski() {<summand><small_solid>}", "<move><extrusion>",
        "<move>union() {<twice>}", "<move>intersection() {<twice>}"}},
      {"solids",
       {"<solid>", "<solid> <solid>", "<solid> <solid>",
        "<solid> <solid> <solid>", "<solid> <solid> <solid> <solid>"}},
      {"move",
       {"<shift>", "", "", "<shift>", "<shift>", "<shift>",
        "rotate([<right_angle>, <right_angle>, <right_angle>]) ",
        "<shift>rotate([<angle>, <angle>, <angle>]) ",
        "<shift>mirror([1, 0, 0]) ", "<shift>mirror([<one>, <one>, 0]) ",
        "<shift>mirror([0, 0, 1]) ", "<shift>scale([<one>, <one>, 0.5]) ",
        "<shift>scale([0.5, <one>, 1]) ", "<matrix>",
        "resize([<length>, <length>, <length>]) "}},
      {"shift", {"translate([<place>, <place>, <place>]) "}},
      {"matrix",
       {"multmatrix([[<one>, <entry>, <entry>, <place>], [<entry>, <one>, "
        "<entry>, <place>], [<entry>, <entry>, <one>, <place>], [0, 0, 0, "
        "1]]) "}},
      {"leaf",
       {"cube([<length>, <length>, <length>], center = <truth>);",
        "cube([<length>, <length>, <length>], center = <truth>);",
        "cube([<length>, <length>, <length>], center = <truth>);",
        "sphere(r = <length>, $fn = <facets>);", "<cylinder>", "<cylinder>",
        "<polyhedron>", "<polyhedron>", "<plain_extrusion>"}},
      {"cylinder",
       {"cylinder(r = <length>, h = <length>, $fn = <facets>);",
        "cylinder(r1 = <length>, r2 = <length>, h = <length>, $fn = <facets>, "
        "center = <truth>);"}},
      // Sums of faces with faces: kept small.
      {"summand",
       {"<move><leaf>", "<move><leaf>", "union() {<move><leaf> <move><leaf>}",
        "difference() {<move><leaf> <move><leaf>}",
        "intersection() {<move><leaf> <move><leaf>}"}},
      {"small_solid",
       {"<move>cube(1);", "<move>cube([1, 0.5, 0.5], center = true);",
        "<move>sphere(r = 0.5, $fn = 4);",
        "<move>cylinder(r1 = 1, r2 = 0, h = 1, $fn = 3);",
        "<move>cube([1, 1, 0]);",
        "<move>linear_extrude(1) polygon([[0, 0], [2, 0], [2, 1], [1, 1], "
        "[1, 2], [0, 2]]);"}},
      {"polyhedron",
       {// A box with one corner pulled about, its faces maybe not flat.
        "polyhedron(<box_points>, [[0, 1, 2, 3], [4, 5, 1, 0], [7, 6, 5, 4], "
        "[5, 6, 2, 1], [6, 7, 3, 2], [7, 4, 0, 3]]);",
        // Inside out.
        "polyhedron(<box_points>, [[3, 2, 1, 0], [0, 1, 5, 4], [4, 5, 6, 7], "
        "[1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]);",
        // Without a wall.
        "polyhedron(<box_points>, [[0, 1, 2, 3], [4, 5, 1, 0], [7, 6, 5, 4], "
        "[5, 6, 2, 1], [6, 7, 3, 2]]);",
        // A face twice, and one of no area.
        "polyhedron(<box_points>, [[0, 1, 2, 3], [4, 5, 1, 0], [7, 6, 5, 4], "
        "[5, 6, 2, 1], [6, 7, 3, 2], [7, 4, 0, 3], [0, 1, 2, 3], [0, 4, 0]]);",
        // Two that share an edge, whose ends are given twice.
        "polyhedron([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [0, 0, 0], "
        "[-2, 0, 0], [0, -2, 0], [0, 0, 2]], [[0, 2, 1], [0, 1, 3], "
        "[1, 2, 3], [0, 3, 2], [4, 6, 5], [4, 5, 7], [5, 6, 7], [4, 7, 6]]);",
        // A pyramid whose floor is pushed in, maybe through the tip.
        "polyhedron([[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0], "
        "[0, 0, <place>], [<place>, 0, <length>]], [[0, 1, 5], [1, 2, 5], "
        "[2, 3, 5], [3, 0, 5], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]);",
        // Corners anywhere: it overlaps itself, faces are not flat.
        "polyhedron([<point>, <point>, <point>, <point>, <point>], "
        "[[0, 1, 2], [0, 2, 3, 4], [0, 4, 1], [1, 4, 3], [1, 3, 2]]);",
        // Corners in line.
        "polyhedron([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], "
        "[1, 1, <length>]], [[0, 1, 2, 3, 4], [1, 0, 5], [2, 1, 5], "
        "[3, 2, 5], [4, 3, 5], [0, 4, 5]]);"}},
      {"point", {"[<place>, <place>, <place>]"}},
      {"box_points",
       {"[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 1], [2, 0, 1], "
        "[2, 2, 1], [0, 2, 1]]",
        "[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, <length>], "
        "[2, 0, <length>], [2, 2, <length>], [<place>, 2, <length>]]"}},

      // --- Between solids and shapes ----------------------------------------
      {"extrusion",
       {"<plain_extrusion>", "linear_extrude(<length>) <shape>",
        "linear_extrude(<length>, twist = <angle>, slices = <facets>, scale = "
        "<scale>) <shape>",
        "rotate_extrude(angle = <turn>, $fn = <facets>) intersection() {<shape>"
        " translate([0, -20]) square(40);}",
        "rotate_extrude(angle = <turn>, $fn = <facets>) translate([<reach>, "
        "0]) intersection() {<shape> square(4, center = true);}",
        "linear_extrude(1) projection() <solid>",
        "linear_extrude(1) projection(cut = true) <solid>"}},
      {"plain_extrusion",
       {"linear_extrude(<length>) <outline>",
        "linear_extrude(<length>, twist = <angle>, slices = <facets>, scale = "
        "<scale>) <outline>",
        "rotate_extrude(angle = <turn>, $fn = <facets>) translate([<reach>, 0])"
        " <outline>"}},
      {"scale", {"1", "0.5", "0", "[1, 0.5]", "2"}},
      {"turn", {"360", "90", "180", "-90", "270"}},
      {"reach", {"6", "5", "4.5"}},

      // --- Shapes -----------------------------------------------------------
      {"shape",
       {"<move_2d><outline>", "<move_2d><outline>",
        "<move_2d>union() {<shape> <shape>}",
        "<move_2d>difference() {<shape> <shape>}",
        "<move_2d>difference() {<shape> <shape>}",
        "<move_2d>intersection() {<shape> <shape>}",
        "<move_2d>hull() {<shape> <shape>}",
        "<move_2d>minkowski() {<shape> <shape>}",
        "offset(r = 0.5, $fn = 8) <shape>", "offset(r = -0.5, $fn = 8) <shape>",
        "offset(delta = 0.5) <shape>", "offset(delta = -0.5) <shape>",
        "offset(delta = 1, chamfer = true) <shape>",
        "projection(cut = <truth>) <solid>"}},
      {"move_2d",
       {"translate([<place>, <place>]) ", "", "rotate(<angle>) ",
        "rotate(<right_angle>) ", "mirror([1, <entry>]) ",
        "scale([<one>, <one>]) ", "scale([0.5, <one>]) "}},
      {"outline",
       {"square([<length>, <length>], center = <truth>);",
        "square([<length>, <length>], center = <truth>);",
        "circle(r = <length>, $fn = <facets>);",
        // Corners anywhere: it may cross itself or lie in a line.
        "polygon([<point_2d>, <point_2d>, <point_2d>, <point_2d>, "
        "<point_2d>]);",
        // With a hole, which may touch the outside or leave it.
        "polygon([[0, 0], [4, 0], [4, 4], [0, 4], [<place>, 1], [3, 1], "
        "[3, <length>], [1, 3]], [[0, 1, 2, 3], [4, 5, 6, 7]]);",
        // A bracket with a corner in line.
        "polygon([[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]);"}},
      {"point_2d", {"[<place>, <place>]"}},
  };
  return rules;
}

class ModuleWriter {
 public:
  ModuleWriter(Choices& choices, std::size_t leaf_count)
      : choices_(choices), leaves_left_(leaf_count) {}

  // What `name` stands for in the grammar.
  std::string text_of(std::string_view name) {
    expand(name);
    return std::move(text_);
  }

 private:
  static constexpr int kGreatestDepth = 4;
  static bool nests(std::string_view name) {
    return name == "solid" || name == "shape";
  }
  static bool is_leaf(std::string_view name) {
    return name == "leaf" || name == "small_solid" || name == "outline";
  }

  void expand(std::string_view name) {
    if (name == "twice") return expand_twice();
    const Alternatives& alternatives = grammar().at(name);
    depth_ += nests(name) ? 1 : 0;
    if (is_leaf(name)) leaves_left_ -= std::min<std::size_t>(leaves_left_, 1);
    const bool must_end = (nests(name) || name == "solids") &&
                          (depth_ > kGreatestDepth || leaves_left_ < 2);
    const auto count = static_cast<std::uint32_t>(alternatives.size());
    write(alternatives[must_end ? 0 : choices_.below(count)]);
    depth_ -= nests(name) ? 1 : 0;
  }

  // A solid, and the same one where it stands or a little off.
  void expand_twice() {
    const std::size_t begin = text_.size();
    expand("solid");
    const std::string part = text_.substr(begin);
    text_ += ' ';
    expand("shift");
    text_ += part;
  }

  void write(std::string_view pattern) {
    while (!pattern.empty()) {
      const std::size_t open = pattern.find('<');
      text_ += pattern.substr(0, open);
      if (open == std::string_view::npos) return;
      const std::size_t close = pattern.find('>', open);
      expand(pattern.substr(open + 1, close - open - 1));
      pattern.remove_prefix(close + 1);
    }
  }

  Choices& choices_;
  std::size_t leaves_left_;
  int depth_ = 0;
  std::string text_;
};

}  // namespace

std::string random_modules(Choices& choices, std::size_t leaf_count) {
  return ModuleWriter(choices, leaf_count).text_of("solid");
}

std::string random_shape(Choices& choices, std::size_t leaf_count) {
  return ModuleWriter(choices, leaf_count).text_of("shape");
}

}  // namespace lamina::support
