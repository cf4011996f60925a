// What OpenSCAD 2021.01 and OpenSCAD 2026 read differently, and what both
// languages understand. The expected lines are what the two programs echo.

#include <string>

#include <gtest/gtest.h>

#include "tests/csg/eval/evaluate_text.h"

namespace lamina::csg {
namespace {

std::string echo(const std::string& text, Language language) {
  return evaluate_text(text, std::size_t{256} << 20, language).echo;
}
std::string csg(const std::string& text, Language language) {
  return evaluate_text(text, std::size_t{256} << 20, language).csg;
}

// Echoes of both languages.
void expect_echoes(const std::string& text, const std::string& of_2021,
                   const std::string& of_2026) {
  EXPECT_EQ(echo(text, Language::k2021), of_2021) << text;
  EXPECT_EQ(echo(text, Language::k2026), of_2026) << text;
}

// --- Understood in both ------------------------------------------------------

TEST(BothLanguages, TakeACommaBehindTheLastArgument) {
  const std::string text =
      "function f(a, b,) = a + b;\n"
      "echo(f(1, 2,), let(x = 3,) x, [for (i = [1, 2],) i],);\n";
  expect_echoes(text, "ECHO: 3, 3, [1, 2]\n", "ECHO: 3, 3, [1, 2]\n");
}

TEST(BothLanguages, TakeByteOrderMarksForBlanks) {
  expect_echoes(
      "\xef\xbb\xbf"
      "a\xef\xbb\xbf=\xef\xbb\xbf"
      "2;echo(a);",
      "ECHO: 2\n", "ECHO: 2\n");
}

TEST(BothLanguages, PrintAnEmptyFileName) {
  for (const Language language : {Language::k2021, Language::k2026}) {
    EXPECT_TRUE(csg("surface();", language).starts_with("surface(file = \"\""));
    EXPECT_TRUE(csg("import();", language).starts_with("import(file = \"\""));
  }
}

// --- Functions made in loops -------------------------------------------------

TEST(Languages, FunctionsMadeInAListSeeTheValueOfTheirRoundSince2026) {
  expect_echoes("f = [for (i = [0:2]) function() i]; echo([for (g = f) g()]);",
                "ECHO: [2, 2, 2]\n", "ECHO: [0, 1, 2]\n");
  expect_echoes(
      "f = [for (i = 0; i < 3; i = i + 1) function() i];\n"
      "echo([for (g = f) g()]);",
      "ECHO: [3, 3, 3]\n", "ECHO: [0, 1, 2]\n");
  expect_echoes(
      "function make(v) = [for (e = v) function(x) x * e];\n"
      "echo([for (g = make([1, 2, 3])) g(10)]);",
      "ECHO: [30, 30, 30]\n", "ECHO: [10, 20, 30]\n");
  expect_echoes(
      "f = [for (i = [0:1]) [for (j = [0:1]) function() [i, j]]];\n"
      "echo([for (row = f) [for (g = row) g()]]);",
      "ECHO: [[[1, 1], [1, 1]], [[1, 1], [1, 1]]]\n",
      "ECHO: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]]\n");
  // The counters of a loop in C's way, and what it keeps besides.
  expect_echoes(
      "f = [for (i = 0, s = 0; i < 3; i = i + 1, s = s + i) function() [i, "
      "s]];\n"
      "echo([for (g = f) g()]);",
      "ECHO: [[3, 6], [3, 6], [3, 6]]\n", "ECHO: [[0, 0], [1, 1], [2, 3]]\n");
}

// --- Arguments ---------------------------------------------------------------

TEST(Languages, PutArgumentsWithoutANameInOtherPlaces) {
  expect_echoes("function f(a = 0, b = 0) = [a, b];\necho(f(b = 1, 2));\n",
                "ECHO: [2, 1]\n", "ECHO: [2, 1]\n");
  expect_echoes("function f(a = 0, b = 0) = [a, b];\necho(f(a = 1, 2));\n",
                "ECHO: [2, 0]\n", "ECHO: [1, 2]\n");
}

TEST(Languages, EvaluateArgumentsInTheOrderOfTheTextSince2026) {
  EXPECT_EQ(echo("module m(b, a) {}\n"
                 "m(a = echo(1) 1, b = echo(2) 2, c = echo(3) 3);\n",
                 Language::k2026),
            "ECHO: 1\nECHO: 2\nECHO: 3\n"
            "WARNING: variable \"c\" not specified as parameter in file "
            "test.scad, line 2\n");
}

TEST(Languages, EvaluateFallbacksWhereNeededOrAlways) {
  expect_echoes(
      "module m(a = echo(\"fallback\") 1) { echo(a); }\nm(2);\nm();\n",
      "ECHO: \"fallback\"\nECHO: 2\nECHO: \"fallback\"\nECHO: 1\n",
      "ECHO: 2\nECHO: \"fallback\"\nECHO: 1\n");
}

TEST(Languages, EvaluateTheFallbacksOfTailCallsOnceOrEachTime) {
  // The fallback counts with rands(), whose numbers differ.
  const std::string text =
      "function f(n, x = rands(0, 1, 1)[0], seen = []) =\n"
      "  n == 0 ? seen : f(n - 1, seen = concat(seen, [x]));\n"
      "s = f(3);\necho(s[1] == s[2]);\n";
  expect_echoes(text, "ECHO: true\n", "ECHO: false\n");
}

TEST(Languages, LetArgumentsSeeDollarVariablesOfTheSameCallIn2021Only) {
  EXPECT_EQ(echo("$x = 1;\nmodule m(a) { echo(a, $x); }\nm($x = 2, a = $x);\n",
                 Language::k2026),
            "ECHO: 1, 2\n");
}

// --- Children ----------------------------------------------------------------

TEST(Languages, ShowChildrenTheDollarVariablesOfTheModule) {
  const std::string text =
      "module m() { $i = 6; children(); $unused = 0; }\n"
      "m() { x = is_undef($i) ? 0 : $i * 6; echo(x); }\n";
  expect_echoes(text, "ECHO: 0\n", "ECHO: 36\n");
}

TEST(Languages, AssignForChildrenOnceOrEachTime) {
  const std::string text =
      "module m() { children(); children(); }\n"
      "m() { x = echo(\"assigned\") 1; echo(x); }\n";
  expect_echoes(text, "ECHO: \"assigned\"\nECHO: 1\nECHO: 1\n",
                "ECHO: \"assigned\"\nECHO: 1\n"
                "ECHO: \"assigned\"\nECHO: 1\n");
}

TEST(Languages, GroupAChildAlone) {
  const std::string text = "module m() { %children(0); }\nm() cube(10);\n";
  EXPECT_EQ(csg(text, Language::k2021),
            "group() {\n\tcube(size = [10, 10, 10], center = false);\n}\n\n");
  EXPECT_EQ(csg(text, Language::k2026),
            "group() {\n%\tgroup() {\n"
            "\t\tcube(size = [10, 10, 10], center = false);\n\t}\n}\n\n");
}

// --- Values ------------------------------------------------------------------

TEST(Languages, TakeFallingRangesForReversedOrEmpty) {
  expect_echoes(
      "a = 3;\necho([for (i = [a:0]) i]);\n",
      "DEPRECATED: Using ranges of the form [begin:end] with begin value "
      "greater than the end value is deprecated in file test.scad, line 2\n"
      "ECHO: [0, 1, 2, 3]\n",
      "ECHO: []\n");
}

TEST(Languages, TellTheirVersion) {
  expect_echoes("echo(version(), version_num() % 10000);\n",
                "ECHO: [2021, 1, 0], 100\n", "ECHO: [2026, 7, 20], 720\n");
}

TEST(Languages, CallFunctionsInDollarVariables) {
  expect_echoes("$f = function(x) x * x;\necho($f(3));\n",
                "WARNING: Can't call function on dynamically scoped variable "
                "in file test.scad, line 2\nECHO: undef\n",
                "ECHO: 9\n");
}

TEST(Languages, NeedNoStackForTailCallsOfOtherFunctions) {
  const std::string text =
      "function even(n) = n == 0 ? true : odd(n - 1);\n"
      "function odd(n) = n == 0 ? false : even(n - 1);\n"
      "a = function(n) n == 0 ? \"a\" : b(n - 1);\n"
      "b = function(n) n == 0 ? \"b\" : a(n - 1);\n"
      "echo(even(500001), a(500001));\n";
  EXPECT_EQ(echo(text, Language::k2026), "ECHO: false, \"b\"\n");
}

// --- Words -------------------------------------------------------------------

TEST(Languages, QuoteNamesInTheirOwnWay) {
  expect_echoes(
      "echo(x);\nmodule m(b) { b = 3; }\nm(a = 1);\n",
      "WARNING: Ignoring unknown variable 'x' in file test.scad, line 1\n"
      "ECHO: undef\n"
      "WARNING: variable a not specified as parameter in file test.scad, line "
      "3\n"
      "WARNING: Module m: Parameter b is overwritten with a literal in file "
      "test.scad, line 2\n",
      "WARNING: Ignoring unknown variable \"x\" in file test.scad, line 1\n"
      "ECHO: undef\n"
      "WARNING: variable \"a\" not specified as parameter in file test.scad, "
      "line 3\n"
      "WARNING: Parameter \"b\" is overwritten with a literal in file "
      "test.scad, line 2\n");
}

TEST(Languages, SayWhatWasExpectedAndWhatCame) {
  expect_echoes(
      "a = [sin(), sin(\"x\"), norm(1)];\n",
      "WARNING: sin() number of parameters does not match in file test.scad, "
      "line 1\n"
      "WARNING: sin() parameter could not be converted in file test.scad, line "
      "1\n",
      "WARNING: sin() number of parameters does not match: expected 1, found 0 "
      "in file test.scad, line 1\n"
      "WARNING: sin() parameter could not be converted: argument 0: expected "
      "number, found string (\"x\") in file test.scad, line 1\n"
      "WARNING: norm() parameter could not be converted: argument 0: expected "
      "vector, found number (1) in file test.scad, line 1\n");
}

TEST(Languages, ComparedAnyElementsOrNumbersOnly) {
  expect_echoes("echo(max([\"a\", \"b\"]));\n", "ECHO: \"b\"\n",
                "WARNING: max() parameter could not be converted: vector "
                "element 0: expected number, found string (\"a\") in file "
                "test.scad, line 1\nECHO: undef\n");
}

TEST(Languages, WarnOfRangesWithoutNumbers) {
  expect_echoes("a = [undef:3];\nb = [0:\"1\":2];\n", "",
                "WARNING: Unable to convert [undef:...:3] to a range in file "
                "test.scad, line 1\n"
                "WARNING: Unable to convert [...:\"1\":...] to a step value in "
                "file test.scad, line 2\n");
}

TEST(Languages, AreNamedWhereAVersionIsAskedForInVain) {
  const std::string text = "assert(version()[0] > 2022, \"too old\");\n";
  EXPECT_TRUE(evaluate_text(text).terminal.ends_with(
      "note: read as OpenSCAD 2021.01; --language 2026 reads it as newer "
      "ones\n"))
      << evaluate_text(text).terminal;
  EXPECT_EQ(echo(text, Language::k2026), "");
  EXPECT_TRUE(evaluate_text("assert(1 > 2);\n").terminal.find("read as") ==
              std::string::npos);
}

TEST(BothLanguages, TakeComprehensionsInParentheses) {
  const std::string text =
      "echo([(for (i = [0:2]) i)], [(each [1, 2]), (if (true) 5)],\n"
      "     [(1), (2)], [(1):(2)], [(let (a = 2) a):3]);\n";
  for (const Language language : {Language::k2021, Language::k2026}) {
    EXPECT_EQ(echo(text, language),
              "ECHO: [0, 1, 2], [1, 2, 5], [1, 2], [1 : 1 : 2], [2 : 1 : 3]\n");
  }
}

// --- Limits ------------------------------------------------------------------

TEST(BothLanguages, EndRecursionsThatPrintWhatTheyNest) {
  const std::string text =
      "module m(a) { echo(a); m([[[[[[[[[[a]]]]]]]]]]); }\nm(1);\n";
  for (const Language language : {Language::k2021, Language::k2026}) {
    EXPECT_TRUE(echo(text, language)
                    .ends_with("\nERROR: Stack exhausted while trying to "
                               "convert a vector to EchoString\n"));
  }
}

}  // namespace
}  // namespace lamina::csg
