// Tries each option that lamina shares with openscad 2021.01 on designs that
// show it: both programs must write the same bytes.

#include <string>

#include <gtest/gtest.h>

#include "tests/conformance/both_programs.h"

namespace lamina::conformance {
namespace {

class Options : public BothPrograms {};

TEST_F(Options, ParameterSets) {
  folder_.write("a.scad",
                "a = 2 * 3; b = [1, 2]; c = \"s\"; d = true; v = [1:2:3];\n"
                "n = -1; u = undef; echo(a, b, c, d, v, n, u);");
  folder_.write("sets.json", R"({"parameterSets": {
    "texts": {"a": "7.123456789", "b": "[3, 4, 5]", "c": "x y", "d": "0",
              "v": "[2:5]", "n": "+4", "u": "1", "z": "9"},
    "values": {"a": 12.50, "c": 12.50, "d": false, "n": null, "b": [7, 8]},
    "strings": {"c": null, "a": "1 2", "b": "[a, \"b c\", 3:4]", "v": "[1,2]"},
    "truth": {"a": "5", "d": " true ", "b": "1"},
    "untrue": {"a": "5", "c": "x", "d": "maybe", "n": "3"},
    "twice": {"a": "5", "a": "6"},
    "dot.ted": {"a": "5"}, "": {"a": "5"}},
    "fileFormatVersion": "1"})");
  for (const char* const set :
       {"texts", "values", "strings", "truth", "untrue", "twice", "dot.ted"}) {
    expect_same_echo({"-p", "sets.json", "-P", set}, "a.scad");
    expect_same_echo({"-p", "sets.json", "-P", set, "-D", "a=9"}, "a.scad");
    expect_same({"-p", "sets.json", "-P", set, "-o", "out.ast", "a.scad"},
                "out.ast");
  }
  expect_same_echo({"-p", "none.json", "-P", "texts"}, "a.scad");
}

TEST_F(Options, ParameterChecks) {
  folder_.write("a.scad",
                "module m(a, b) { echo(a, b, x); }\n"
                "function f(a) = a;\n"
                "m(1, 2, 3, 4); m(1, x = 3); m(a = 1, a = 2);\n"
                "m(1, x = 3, x = 4, 5, 6); m($q = 1);\n"
                "echo(f(1, 2)); echo(f(1, q = 2));\n"
                "cube(1, 2, 3); cube(1, zz = 4); sphere(-1);\n"
                "cylinder(h = -1); cube([1, -1, 0]); scale(0) cube();");
  for (const char* const value : {"true", "false", "on", "OFF", "1", "0"}) {
    for (const char* const option :
         {"--check-parameters", "--check-parameter-ranges"}) {
      expect_same_echo({std::string(option) + "=" + value}, "a.scad");
      expect_same_echo({option, value}, "a.scad");
    }
  }
  expect_same_echo({}, "a.scad");
}

TEST_F(Options, HardWarnings) {
  folder_.write("f.scad",
                "function f(x) = sin(x) + g(x);\n"
                "function g(x) = sin(\"a\") + 1 + [1][\"q\"] + h(x);\n"
                "module m() { translate([f(1), 0, 0]) cube(1); }\n"
                "if (true) m(); echo(2);");
  folder_.write("v.scad", "echo(1); x = unknown; cube(x); echo(2);");
  folder_.write("m.scad",
                "module a() { for (i = [0:1]) union() scale(\"q\") cube(1); }\n"
                "echo(1); a();");
  folder_.write("u.scad", "module m() { foo(); }\nm();");
  folder_.write("n.scad", "echo(\"no warning\");");
  for (const char* const design :
       {"f.scad", "v.scad", "m.scad", "u.scad", "n.scad"}) {
    expect_same_echo({"--hardwarnings"}, design);
    expect_same({"--hardwarnings", "-o", "out.csg", design}, "out.csg");
  }
}

TEST_F(Options, RenderAndPreview) {
  folder_.write("a.scad",
                "echo($preview); if ($preview) cube(); else sphere();");
  for (const Words& mode : std::vector<Words>{{},
                                              {"--render"},
                                              {"--render=cgal"},
                                              {"--preview"},
                                              {"--preview=throwntogether"},
                                              {"--render", "--preview"}}) {
    expect_same_echo(mode, "a.scad");
    Words arguments = mode;
    arguments.insert(arguments.end(), {"-o", "out.csg", "a.scad"});
    expect_same(arguments, "out.csg");
  }
}

TEST_F(Options, Dependencies) {
  std::filesystem::create_directories(folder_.file("sub/deep folder"));
  folder_.write("sub/u.scad", "use <b.scad>\nfunction u() = b();");
  folder_.write("sub/b.scad", "use <u.scad>\nfunction b() = 2;");
  folder_.write("sub/i.scad", "include <deep folder/j.scad>\nx = 1;");
  folder_.write("sub/deep folder/j.scad", "y = 1;");
  folder_.write("d.dat", "1 2\n3 4\n");
  folder_.write("l.dxf", "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n");
  folder_.write("a.scad",
                "use <sub/u.scad>\ninclude <sub/i.scad>\n"
                "include <./sub/../sub/i.scad>\n"
                "include <missing.scad>\nuse <missing_too.scad>\n"
                "use <MCAD/units.scad>\ninclude <MCAD/math.scad>\n"
                "surface(\"d.dat\"); surface(\"missing.dat\"); surface();\n"
                "for (i = [1:9]) import(str(\"part\", i, \".stl\"));\n"
                "linear_extrude(file = \"l.dxf\", height = 1);\n"
                "rotate_extrude(file = \"other.dxf\");\n"
                "echo(dxf_dim(file = \"missing_dim.dxf\"), u());\n"
                "echo(dxf_cross(file = \"l.dxf\"));\n");
  folder_.write("failing.scad", "include <sub/b.scad>\nassert(false);");
  folder_.write("one.scad", "cube();");
  for (const char* const design : {"a.scad", "failing.scad", "one.scad"}) {
    for (const char* const output : {"out.csg", "out.echo", "sub/out.csg"}) {
      expect_same({"-o", output, "-d", "out.d", design}, "out.d");
    }
    expect_same({"-o", folder_.file("out.csg"), "-d", folder_.file("out.d"),
                 folder_.file(design)},
                "out.d");
  }
  expect_same({"-o", "out.ast", "-d", "out.d", "one.scad"}, "out.d");
  expect_same({"-o", "-", "--export-format", "csg", "-d", "out.d", "one.scad"},
              "out.d");
}

TEST_F(Options, DependenciesOfADesignWithErrorsAreNotWritten) {
  folder_.write("a.scad", "cube(");
  for (const char* const program : {"openscad", LAMINA_PROGRAM}) {
    EXPECT_EQ(run(program, {"-o", "out.csg", "-d", "out.d", "a.scad"}, "out.d"),
              "(no file)");
  }
}

}  // namespace
}  // namespace lamina::conformance
