// Designs that would break a careless program: each ends within seconds and in
// bounded memory, with a result or OpenSCAD's own words for what is wrong.

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::read_file;
using support::TemporaryFolder;

// The .echo of a design, or how the run ended if it wrote none.
std::string echo_of(const TemporaryFolder& folder, const std::string& text) {
  folder.write("design.scad", text);
  const support::ProcessResult result = support::run_process(
      {"/bin/sh", "-c",
       fmt::format("ulimit -v 4000000; exec timeout 20 {} design.scad -q -o "
                   "design.echo",
                   LAMINA_PROGRAM)},
      folder.path());
  if (result.status != 0) {
    return fmt::format("status {}: {}", result.status, result.errors);
  }
  return read_file(folder.path() + "/design.echo");
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

TEST(Pathological, EndlessRecursionIsFound) {
  const TemporaryFolder folder;
  folder.write("other.scad", "function there(x) = 1 + back(x);");
  const struct {
    const char* text;
    const char* message;
  } cases[] = {
      {"function f(x) = 1 + f(x); echo(f(1));", "calling function 'f'"},
      {"function f(x) = f(x + 1); echo(f(1));", "calling function 'f'"},
      {"function f(x) = g(x) + 1; function g(x) = f(x) + 1; echo(f(1));",
       "calling function"},
      {"f = function(x) 1 + f(x); echo(f(1));", "calling function 'f'"},
      {"module m() m(); m();", "calling module 'm'"},
      {"module m() { n(); } module n() { m(); } m();", "calling module"},
      {"include <other.scad>\nfunction back(x) = there(x); echo(back(1));",
       "calling function"},
  };
  for (const auto& one : cases) {
    EXPECT_TRUE(first_line(echo_of(folder, one.text))
                    .starts_with(std::string("ERROR: Recursion detected ") +
                                 one.message))
        << one.text;
  }
}

TEST(Pathological, DeepRecursionThatEndsIsNoError) {
  const TemporaryFolder folder;
  EXPECT_EQ(echo_of(folder,
                    "function f(n) = n == 0 ? 0 : 1 + f(n - 1);"
                    "echo(f(100000));"),
            "ECHO: 100000\n");
  EXPECT_EQ(echo_of(folder,
                    "function f(n, a = 0) = n == 0 ? a : f(n - 1, a + n);"
                    "echo(f(900000));"),
            "ECHO: 4.05e+11\n");
  EXPECT_EQ(echo_of(folder,
                    "module m(n) if (n == 0) echo(\"end\"); else m(n - 1);"
                    "m(100000);"),
            "ECHO: \"end\"\n");
}

TEST(Pathological, RangesTooLongAreRefused) {
  const TemporaryFolder folder;
  const std::string refused =
      "WARNING: Bad range parameter in for statement: too many elements "
      "(4294967295) in file design.scad, line 1\n";
  EXPECT_EQ(echo_of(folder, "for (i = [0 : 1e12]) cube(1);"), refused);
  EXPECT_EQ(echo_of(folder, "a = [for (i = [0 : 1e12]) i]; echo(len(a));"),
            refused + "ECHO: 0\n");
}

TEST(Pathological, AMillionBracketsEnd) {
  const TemporaryFolder folder;
  constexpr std::size_t kDepth = 1000000;
  const std::string echo =
      echo_of(folder, "a = " + std::string(kDepth, '[') +
                          std::string(kDepth, ']') + "; echo(len(a));");
  EXPECT_TRUE(echo == "ECHO: 1\n" || echo.find("nested") != std::string::npos)
      << echo.substr(0, 300);
}

// `open` as often as there are levels, each time with the level for `{}`, then
// `inner`, then `close` as often.
std::string nested(std::size_t levels, const char* open, const char* inner,
                   const char* close) {
  std::string text;
  for (std::size_t i = 0; i < levels; ++i) {
    text += fmt::format(fmt::runtime(open), i);
  }
  text += inner;
  for (std::size_t i = 0; i < levels; ++i) text += close;
  return text;
}

// Climbing from scope to scope would take minutes.
TEST(Pathological, NamesAreFoundAcrossManyScopes) {
  const TemporaryFolder folder;
  constexpr std::size_t kLevels = 40000;
  const std::string x = "x = 1;";
  EXPECT_EQ(
      echo_of(folder, x + "y = " +
                          nested(kLevels, "let(a{} = x + x + x + x + x + x) ",
                                 "x + a0;", "") +
                          "echo(y);"),
      "ECHO: 7\n");
  EXPECT_EQ(echo_of(folder,
                    x + nested(kLevels, "union() {{ a{} = x + x + x + x + x; ",
                               "echo(x + a0);", "}")),
            "ECHO: 6\n");
  EXPECT_EQ(echo_of(folder, x + nested(kLevels, "for (a{} = [x, ], b = [x]) ",
                                       "echo(x + a0);", "")),
            "ECHO: 2\n");
}

TEST(Pathological, ParameterListsMayBeLong) {
  const TemporaryFolder folder;
  constexpr std::size_t kParameters = 200000;
  const std::string parameters = nested(kParameters, "a{} = 1, ", "z", "");
  const std::string arguments = nested(kParameters, "a{} = 2, ", "z = 3", "");
  EXPECT_EQ(
      echo_of(folder, "function f(" + parameters +
                          ") = a0 + a199999 + z; echo(f(" + arguments + "));"),
      "ECHO: 7\n");
}

TEST(Pathological, StringsOfAHundredMegabytesAreStrings) {
  const TemporaryFolder folder;
  EXPECT_EQ(echo_of(folder,
                    "function twice(s, n) = n == 0 ? s : twice(str(s, s), "
                    "n - 1); echo(len(twice(\"0123456789\", 23)));"),
            "ECHO: 8.38861e+7\n");
  constexpr std::size_t kLength = 100000000;
  EXPECT_EQ(
      echo_of(folder, "echo(len(\"" + std::string(kLength, 'x') + "\"));"),
      "ECHO: 1e+8\n");
}

// Each name is looked up in more than a thousand files.
TEST(Pathological, NamesAreFoundInManyUsedFiles) {
  const TemporaryFolder folder;
  constexpr int kFiles = 1400;
  std::string text;
  for (int i = 0; i < kFiles; ++i) {
    folder.write(fmt::format("f{}.scad", i),
                 fmt::format("function f{0}() = {0};\n"
                             "function every() = {0};\n",
                             i));
    text += fmt::format("use <f{}.scad>\n", i);
  }
  text += "sum = 0";
  for (int i = 0; i < kFiles; ++i) text += fmt::format(" + f{}()", i);
  // Of one name the last file's counts.
  text += ";\necho(sum, every());";
  EXPECT_EQ(
      echo_of(folder, text),
      fmt::format("ECHO: {}, {}\n", kFiles * (kFiles - 1) / 2, kFiles - 1));
}

TEST(Pathological, FilesInACircleEnd) {
  const TemporaryFolder folder;
  folder.write("a.scad", "use <b.scad>\nfunction a() = 1;");
  folder.write("b.scad", "use <a.scad>\nfunction b() = 2;");
  EXPECT_EQ(echo_of(folder, "use <a.scad>\nuse <b.scad>\necho(a() + b());"),
            "ECHO: 3\n");
  folder.write("c.scad", "include <d.scad>\nc = 1;");
  folder.write("d.scad", "include <c.scad>\nd = 2;");
  const std::string echo = echo_of(folder, "include <c.scad>\necho(c);");
  EXPECT_FALSE(echo.starts_with("status 1")) << echo.substr(0, 300);
  EXPECT_LT(echo.size(), 10000U);
}

}  // namespace
}  // namespace lamina::cli
