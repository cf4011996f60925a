#include "csg/eval/evaluator.h"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "base/source.h"
#include "csg/csg_printer.h"
#include "parser/loader.h"
#include "tests/csg/eval/evaluate_text.h"

namespace lamina::csg {
namespace {

// Processor time that a program takes, the least of three runs, so that other
// work of the machine does not count.
std::clock_t ticks_for(const std::string& text) {
  std::clock_t least = std::numeric_limits<std::clock_t>::max();
  for (int run = 0; run < 3; ++run) {
    const std::clock_t start = std::clock();
    evaluate_text(text);
    least = std::min(least, std::clock() - start);
  }
  return least;
}

// --- Recursion --------------------------------------------------------------

TEST(Evaluate, RecursesAHundredThousandDeepOutsideTailPosition) {
  EXPECT_EQ(evaluate_text("function f(n) = n == 0 ? 0 : 1 + f(n - 1);\n"
                          "echo(f(100000));\n")
                .echo,
            "ECHO: 100000\n");
}

TEST(Evaluate, TurnsTailCallsIntoJumps) {
  // A stack for a few hundred calls at most.
  EXPECT_EQ(evaluate_text("function f(n, sum = 0) =\n"
                          "  n == 0 ? sum : let(s = sum + n) f(n - 1, s);\n"
                          "echo(f(900000));\n",
                          std::size_t{2} << 20)
                .echo,
            "ECHO: 4.05e+11\n");
}

TEST(Evaluate, EndsEndlessRecursionWithAnErrorAndAnEmptyTree) {
  const Evaluated endless = evaluate_text(
      "cube(1);\nmodule m() { m(); }\nm();\n", std::size_t{8} << 20);
  EXPECT_EQ(endless.csg, "\n");
  EXPECT_TRUE(endless.echo.starts_with(
      "ERROR: Recursion detected calling module 'm' in file test.scad, line "
      "2\nTRACE: called by 'm' in file test.scad, line 2\n"))
      << endless.echo;
}

TEST(Evaluate, EndsEndlessTailRecursion) {
  EXPECT_EQ(evaluate_text("function f(n) = f(n + 1);\nx = f(0);\n").echo,
            "ERROR: Recursion detected calling function 'f' in file "
            "test.scad, line 1\n"
            "TRACE: called by 'f' in file test.scad, line 2\n");
}

TEST(Evaluate, FreesVectorsNestedAMillionDeep) {
  EXPECT_EQ(evaluate_text("function f(n, v = []) = n == 0 ? v : f(n - 1, [v]);"
                          "\necho(len(f(999999)));\n",
                          std::size_t{2} << 20)
                .echo,
            "ECHO: 1\n");
}

// --- Cost -------------------------------------------------------------------

// Without that, each of these lines would take 2⁴⁰ vectors.
TEST(Evaluate, ResultsShareWhatOperandsShare) {
  EXPECT_EQ(evaluate_text(
                "function twice(v, n) = n == 0 ? v : twice([v, v], n - 1);\n"
                "function reach(v, n) = n == 0 ? v : reach(v[n % 2], n - 1);\n"
                "a = twice([[1, 2, \"x\"], 6], 40);\n"
                "b = -a; c = a + b * 2; d = (12 / a - c) / 3;\n"
                "echo(reach(b, 40), reach(c, 40), reach(d, 40));\n")
                .echo,
            "ECHO: [[-1, -2, undef], -6], [[-1, -2, undef], -6], "
            "[[4.33333, 2.66667, undef], 2.66667]\n");
}

TEST(Evaluate, BuildsListsAndStringsInLinearTime) {
  const auto list = [](const std::string& grown) {
    return "function f(n, v = []) = n == 0 ? v : f(n - 1, " + grown + ");\n";
  };
  const std::string string =
      "function f(n, s = \"\") = n == 0 ? s : f(n - 1, str(s, "
      "\"abcdefgh\"));\n";
  for (const std::string& program :
       {list("concat(v, [n])"), list("concat(n, v)"), list("[n, each v]"),
        list("[if (n > 0) each v, n]"),
        list("n % 2 == 0 ? [each v, n] : concat([n], v)"), string}) {
    const std::clock_t few = ticks_for(program + "echo(len(f(20000)));\n");
    const std::clock_t many = ticks_for(program + "echo(len(f(160000)));\n");
    // Eight times as long takes about eight times the time. Quadratic copying
    // would take 64 times as much.
    EXPECT_LT(many, 24 * few) << program;
  }
}

TEST(Evaluate, RefusesARangeWithoutEndAtOnce) {
  EXPECT_EQ(evaluate_text("for (i = [0 : 1e12]) cube(1);\n").echo,
            "WARNING: Bad range parameter in for statement: too many elements "
            "(4294967295) in file test.scad, line 1\n");
}

// How many hints a program gets that misspells each of its modules, and then
// the first one again.
std::size_t hints_for(int modules) {
  std::string text;
  for (int i = 0; i < modules; ++i) {
    const std::string number = std::to_string(i);
    text += "module part_" + number + "() {} prat_" + number + "();\n";
  }
  const std::string said = evaluate_text(text + "prat_0();\n").terminal;
  const std::string_view hint = "note: did you mean 'part_";
  std::size_t count = 0;
  for (std::size_t at = said.find(hint); at != std::string::npos;
       at = said.find(hint, at + 1)) {
    ++count;
  }
  EXPECT_TRUE(said.ends_with("note: did you mean 'part_0'?\n"));
  return count;
}

TEST(Evaluate, GuessesNoMoreWhereItHasComparedManyNames) {
  EXPECT_EQ(hints_for(300), 301U);
  const std::size_t few = hints_for(2000);
  const std::size_t fewer = hints_for(4000);
  EXPECT_LT(few, 500U);
  EXPECT_LT(fewer, few);
  EXPECT_GT(fewer, 50U);
}

// To compare them letter by letter would take hours.
TEST(Evaluate, DoesNotCompareNamesOfAMillionLetters) {
  const std::string name(1'000'000, 'a');
  const std::string said =
      evaluate_text("module " + name + "() {} " + name + "b();\n").echo;
  EXPECT_TRUE(said.starts_with("WARNING: Ignoring unknown module"));
}

// --- Closures ---------------------------------------------------------------

TEST(Evaluate, LetsAClosureSeeAVariableThatIsSetAfterIt) {
  EXPECT_EQ(evaluate_text("f = let(g = function(n) n < 2 ? 1 : n * g(n - 1))\n"
                          "    function(n) g(n);\n"
                          "echo(f(5));\n")
                .echo,
            "ECHO: 120\n");
}

TEST(Evaluate, LetsAClosureOutliveTheCallThatMadeIt) {
  EXPECT_EQ(evaluate_text("function add(a) = function(b) a + b;\n"
                          "fs = [for (i = [1 : 3]) add(i * 10)];\n"
                          "echo([for (f = fs) f(1)]);\n")
                .echo,
            "ECHO: [11, 21, 31]\n");
}

// --- Echo -------------------------------------------------------------------

TEST(Evaluate, EchoesNothingAsALineOfItsOwn) {
  EXPECT_EQ(evaluate_text("echo();\n").echo, "ECHO: \n");
}

// --- Steps ------------------------------------------------------------------

// What a program says that may take so many calls and turns of loops.
std::string say_within(std::uint64_t steps, const std::string& text) {
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, {});
  const ast::Program program = loader.load_text("test.scad", text);
  EvaluateOptions options;
  options.max_steps = steps;
  evaluate(program, loader, options, diagnostics);
  return openscad_text(diagnostics.all(), "");
}

TEST(Evaluate, CountsEveryKindOfStep) {
  // Each takes 100 steps in its loop and a few around it.
  const std::vector<std::string> loops = {
      "x = [for (i = [1 : 100]) i];",
      "x = [for (i = 0; i < 100; i = i + 1) i];",
      "for (i = [1 : 100]) { }",
      "function f(n) = n == 0 ? 0 : f(n - 1); x = f(99);",
      "function f(n) = n == 0 ? 0 : 1 + f(n - 1); x = f(99);",
      "f = function(n) n == 0 ? 0 : f(n - 1); x = f(99);",
      "module m(n) { if (n > 0) m(n - 1); } m(49);"};
  for (const std::string& loop : loops) {
    EXPECT_EQ(say_within(105, loop), "") << loop;
    EXPECT_EQ(
        say_within(95, loop).find("ERROR: Evaluation takes more than 95 steps"),
        0U)
        << loop;
  }
}

// --- Tree -------------------------------------------------------------------

TEST(Evaluate, ItsCsgIsAProgramThatMakesTheSameCsg) {
  const Evaluated first = evaluate_text(
      "$fn = 12;\n"
      "module ring(n) { for (i = [0 : n - 1]) rotate(360 / n * i)\n"
      "  translate([5, 0]) children(i % $children); }\n"
      "difference() { cylinder(r1 = 6, r2 = 1/3, h = 1e-7); \n"
      "  #ring(7) { cube([1, 2, 3e6]); %sphere(d = 1.5); }\n"
      "  linear_extrude(3, twist = 30, slices = 5, scale = 0.1)\n"
      "    polygon([[0, 0], [1, 0], [0.1, 1]]);\n"
      "  resize([1, 0, 2], auto = true) hull() { circle(2); square(); } }\n");
  ASSERT_EQ(first.echo, "");
  EXPECT_EQ(evaluate_text(first.csg).csg, first.csg);
}

TEST(Evaluate, SelectsTheFirstRootModifier) {
  EXPECT_EQ(evaluate_text("cube(1); translate([1, 2, 3]) !sphere(1);\n").csg,
            "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n\n");
}

TEST(Evaluate, ShowsTheChainOfCallsWithAFailedAssertion) {
  EXPECT_EQ(evaluate_text("function f(x) = assert(x > 0, \"positive\") x;\n"
                          "module m() { cube(f(-1)); }\n"
                          "m();\n")
                .terminal,
            "test.scad:1:17: error: Assertion '(x > 0)' failed: \"positive\"\n"
            "    1 | function f(x) = assert(x > 0, \"positive\") x;\n"
            "      |                 ^~~~~~~~~~~~~~~~~~~~~~~~~~~\n"
            "test.scad:2:19: note: called by 'f'\n"
            "    2 | module m() { cube(f(-1)); }\n"
            "      |                   ^~~~~\n"
            "test.scad:2:14: note: called by 'cube'\n"
            "    2 | module m() { cube(f(-1)); }\n"
            "      |              ^~~~~~~~~~~\n"
            "test.scad:3:1: note: called by 'm'\n"
            "    3 | m();\n"
            "      | ^~~\n");
}

}  // namespace
}  // namespace lamina::csg
