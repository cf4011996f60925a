// text(), textmetrics() and fontmetrics() in whole runs.

#include "tests/support/text.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::has;
using support::read_file;
using support::TemporaryFolder;

std::string echo_of(const std::string& design) {
  const TemporaryFolder folder;
  folder.write("a.scad", design);
  const auto result =
      run(folder, {"-q", "a.scad", "--language", "2021", "-o", "a.echo"});
  EXPECT_EQ(result.status, 0) << result.errors;
  return read_file(folder.file("a.echo"));
}

// What OpenSCAD's own test text-metrics-test.scad expects, but for the distance
// of letters, which is 1.024 times smaller in text() of 2021.01.
TEST(Metrics, AreThoseOfNewerOpenScadForRowsOf2021) {
  EXPECT_EQ(
      echo_of(R"(echo(textmetrics("hello", font="Liberation Sans"));
echo(textmetrics("hello", font="Liberation Sans", size=20, direction="rtl",
    language="en", script="latin", halign="right", valign="center", spacing=2));
fm = fontmetrics(font="Liberation Sans", size=20);
echo(fm.nominal, fm.interline, fm.font);
)"),
      "ECHO: { position = [0.96, -0.1408]; size = [27.2957, 10.208]; ascent = "
      "10.0672; descent = -0.1408; offset = [0, 0]; advance = [28.6565, 0]; }\n"
      "ECHO: { position = [-113.461, -9.97535]; size = [96.9331, 20.416]; "
      "ascent = 20.1344; descent = -0.2816; offset = [-114.626, -9.69375]; "
      "advance = [114.626, 0]; }\n"
      "ECHO: { ascent = 25.1466; descent = -5.8866; }, 31.9418, { family = "
      "\"Liberation Sans\"; style = \"Regular\"; }\n");
}

TEST(Metrics, WarnOfArgumentsOfTheWrongType) {
  EXPECT_EQ(
      echo_of("echo(textmetrics(text=123, size=[], valign=0).advance);\n"
              "echo(fontmetrics(text=\"bad\", size=true) == fontmetrics());"),
      "WARNING: textmetrics(..., size=[]) Invalid type: expected number, found "
      "vector in file a.scad, line 1\n"
      "WARNING: textmetrics(..., text=123) Invalid type: expected string, "
      "found number in file a.scad, line 1\n"
      "WARNING: textmetrics(..., valign=0) Invalid type: expected string, "
      "found number in file a.scad, line 1\n"
      "ECHO: [0, 0]\n"
      "WARNING: variable text not specified as parameter in file a.scad, line "
      "2\n"
      "WARNING: fontmetrics(..., size=true) Invalid type: expected number, "
      "found bool in file a.scad, line 2\n"
      "ECHO: true\n");
}

TEST(Metrics, AnEmIsHundredSeventySecondsOfASize) {
  EXPECT_EQ(echo_of("echo(textmetrics(\"M\", em = 100) == textmetrics(\"M\", "
                    "size = 72));\n"
                    "x = fontmetrics(em = 1, size = 2);"),
            "WARNING: fontmetrics: \"size\" ignored when \"em\" is set in file "
            "a.scad, line 2\n"
            "ECHO: true\n");
}

TEST(Metrics, AFunctionOfTheDesignGoesFirst) {
  EXPECT_EQ(echo_of("function textmetrics(t) = len(t);\n"
                    "echo(textmetrics(\"abc\"));"),
            "ECHO: 3\n");
}

TEST(Text, AProgramWithoutItsModuleSaysSo) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(LAMINA_PROGRAM, folder.file("lamina"));
  folder.write("a.scad", "linear_extrude(1) text(\"A\");");
  folder.write("b.scad", "cube(1);");
  folder.write("c.scad", "echo(textmetrics(\"A\"));");
  const std::string program = folder.file("lamina");
  EXPECT_EQ(support::run_process({program, "b.scad"}, folder.path()).status, 0);
  for (const char* design : {"a.scad", "c.scad"}) {
    const auto result = support::run_process(
        {program, design, "--language", "2021"}, folder.path());
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.errors,
              "error: Can't find the module for text(), lamina_text.so, in " +
                  folder.path() + " or " +
                  std::filesystem::path(folder.path())
                      .parent_path()
                      .append("lib/lamina")
                      .string() +
                  "\n");
  }
}

TEST(Text, NeedsNoProc) {
  const TemporaryFolder folder;
  folder.write("a.scad", "linear_extrude(1) text(\"A\");");
  const auto run_without_proc = [&](const std::string& words) {
    return support::run_process(
        {"unshare", "-m", "sh", "-c",
         "umount -l /proc || exit 99; exec " LAMINA_PROGRAM " -q " + words},
        folder.path());
  };
  const auto result = run_without_proc("a.scad -o a.slc");
  if (result.status == 99 || has(result.errors, "unshare")) return;  // not root
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(std::filesystem::exists(folder.file("a.slc")));
  EXPECT_EQ(run_without_proc("a.scad -o b.slc --root . 2>&1").output,
            "lamina: --root needs /proc, which is not there\n"
            "Run 'lamina --help' for the options.\n");
}

// What a run finds of fonts, or fails to find, it keeps from all other
// programs.
TEST(Text, LeavesTheCacheOfFontsAlone) {
  const TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  std::filesystem::create_directory(cache);
  folder.write("fonts.conf",
               "<fontconfig><dir>/usr/share/fonts/truetype/liberation</dir>"
               "<cachedir>" +
                   cache + "</cachedir></fontconfig>");
  folder.write("a.scad", "text(\"A\", font = \"Liberation Sans\");");
  std::vector<std::string> words = {
      "env", "FONTCONFIG_FILE=" + folder.file("fonts.conf"),
      "XDG_CACHE_HOME=" + cache};
  for (const std::string& word : command({"a.scad", "-o", "a.svg"})) {
    words.push_back(word);
  }
  const auto result = support::run_process(words, folder.path());
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_FALSE(has(result.errors, "not found")) << result.errors;
  EXPECT_TRUE(std::filesystem::is_empty(cache));
}

TEST(Text, UnderHardWarningsAMissingFontEndsTheRun) {
  const TemporaryFolder folder;
  folder.write("a.scad", "linear_extrude(1) text(\"A\", font = \"Nought\");");
  const auto result = run(folder, {"--hardwarnings", "a.scad"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(
      has(result.errors, "a.scad:1:19: warning: Font 'Nought' not found"))
      << result.errors;
}

TEST(Text, AFontBesideTheDesignIsItsOwn) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("lib"));
  folder.write("lib/cut.ttf", "no font");
  folder.write("lib/word.scad", "use <cut.ttf>\nmodule word() text(\"A\");");
  folder.write("a.scad", "use <lib/word.scad>\nlinear_extrude(1) word();");
  const auto result = run(folder, {"-q", "a.scad", "--layer", "1"});
  EXPECT_EQ(result.status, 0) << result.errors;
  const auto loud = run(folder, {"a.scad", "--layer", "1"});
  EXPECT_TRUE(has(loud.errors, "Can't register font '")) << loud.errors;
  EXPECT_TRUE(has(loud.errors, "lib/cut.ttf'")) << loud.errors;
}

}  // namespace
}  // namespace lamina::cli
