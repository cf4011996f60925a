#include "parser/loader.h"

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "parser/customizer/program_printer.h"
#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

namespace fs = std::filesystem;

class LoaderTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    fs::create_directories(fs::path(folder_.file(name)).parent_path());
    folder_.write(name, text);
  }

  std::string path(const std::string& name) const {
    return fs::canonical(folder_.file(name)).string();
  }

  // The main file's tree, printed; its program stays in program_.
  std::string load(const std::string& name) {
    program_ = loader_.load(folder_.file(name));
    return ast::print(program_);
  }

  std::string messages() const {
    std::string text;
    for (const Diagnostic& message : diagnostics_.all()) {
      text += openscad_line(message, folder_.path());
    }
    return text;
  }

  support::TemporaryFolder folder_;
  SourceStore sources_;
  Diagnostics diagnostics_;
  Loader loader_{sources_, diagnostics_, {folder_.file("libraries")}, "d=1;\n"};
  ast::Program program_;
};

TEST_F(LoaderTest, IncludesMayStandWhereverABlankMay) {
  write("value.scad", "2 + 3");
  write("main.scad", "cube(1 + include <value.scad> * 4);");
  EXPECT_EQ(load("main.scad"),
            "//Parameter(\"\")\nd = 1;\ncube(((1 + 2) + (3 * 4)));\n");
}

TEST_F(LoaderTest, IncludesAreFoundFromTheFileThatNamesThem) {
  write("main.scad", "include <a/one.scad>\ninclude<lib.scad>");
  write("a/one.scad", "include <b/two.scad>\none();");
  write("a/b/two.scad", "two();");
  write("libraries/lib.scad", "lib();");
  EXPECT_EQ(load("main.scad"),
            "//Parameter(\"\")\nd = 1;\ntwo();\none();\nlib();\n");
  ASSERT_EQ(loader_.files().size(), 4u);
  EXPECT_EQ(loader_.files()[1], path("a/one.scad"));
}

TEST_F(LoaderTest, TheOwnFolderGoesBeforeTheLibraries) {
  write("main.scad", "include <lib.scad>");
  write("lib.scad", "own();");
  write("libraries/lib.scad", "library();");
  EXPECT_EQ(load("main.scad"), "//Parameter(\"\")\nd = 1;\nown();\n");
}

TEST_F(LoaderTest, MissingFilesAreWarnings) {
  write("main.scad", "include <no/i.scad>\nuse <no/u.scad>\ncube();");
  EXPECT_EQ(load("main.scad"), "//Parameter(\"\")\nd = 1;\ncube();\n");
  EXPECT_EQ(messages(),
            "WARNING: Can't open include file 'no/i.scad'.\n"
            "WARNING: Can't open library 'no/u.scad'.\n");
  ASSERT_EQ(program_.uses.size(), 1u);
  EXPECT_EQ(loader_.used_program(program_.uses[0]), nullptr);
}

TEST_F(LoaderTest, MessagesHaveTheWordsOf2026WhereThatIsAskedFor) {
  loader_.set_language(Language::k2026);
  write("main.scad",
        "include <no/i.scad>\nuse <no/u.scad>\nx = \"\\q\";\n"
        "y = 18446744073709551600;\ninclude <\nno.scad>\n");
  load("main.scad");
  const std::string place = " in file main.scad, line ";
  EXPECT_EQ(messages(),
            "WARNING: Can't find include file 'no/i.scad'." + place + "1\n" +
                "WARNING: Can't open library 'no/u.scad'." + place + "2\n" +
                "WARNING: Undefined escape sequence" + place + "3\n" +
                "WARNING: Integer \"18446744073709551600\" cannot be "
                "represented precisely" +
                place + "4\n" +
                "WARNING: new lines in 'include<>'-statement is not defined - "
                "behavior may change in the future" +
                place + "6\n" + "WARNING: Can't find include file 'no.scad'." +
                place + "6\n");
}

TEST_F(LoaderTest, NamesThatBeginWithADigitAreDeprecatedIn2026) {
  loader_.set_language(Language::k2026);
  write("main.scad",
        "2a = 1; echo(2a);\nfunction 3f(4x) = 4x + 2a + 0x1f + 1e3;\n"
        "b = 1; b = 2;\n");
  load("main.scad");
  const auto deprecated = [](const std::string& name, int line) {
    return fmt::format(
        "DEPRECATED: Variable names starting with digits (\"{}\") will be "
        "removed in future releases. in file main.scad, line {}\n",
        name, line);
  };
  EXPECT_EQ(messages(),
            deprecated("2a", 1) + deprecated("3f", 2) + deprecated("4x", 2) +
                deprecated("2a", 2) +
                "WARNING: \"b\" was assigned on line 3 but was overwritten in "
                "file main.scad, line 3\n");
}

// Each is an error of OpenSCAD 2026, and fine in 2021.01.
TEST_F(LoaderTest, CommasTooManyAreErrorsIn2026) {
  for (const std::string text :
       {"a = [,];", "a = [1,,2];", "a = [1, 2,,];", "a = [each [1],, 2];",
        "function f(a,, b) = a;", "function f(, a) = a;",
        "function f(a,,) = a;", "module m(,) {}", "m(1,, 2);", "m(, 1);",
        "for (i = [1],, k = [2]) m();", "f = function(a,, b) a;"}) {
    write("main.scad", text);
    loader_.set_language(Language::k2021);
    EXPECT_NO_THROW(load("main.scad")) << text;
    loader_.set_language(Language::k2026);
    EXPECT_THROW(load("main.scad"), SyntaxError) << text;
  }
  for (const std::string text :
       {"a = [];", "a = [1,];", "function f(a, b,) = a;", "m(1, 2,);"}) {
    write("main.scad", text);
    EXPECT_NO_THROW(load("main.scad")) << text;
  }
}

TEST_F(LoaderTest, AFolderIsNoFile) {
  write("sub/x.scad", "");
  write("main.scad", "include <sub>\nuse <sub>");
  load("main.scad");
  EXPECT_EQ(messages(),
            "WARNING: Can't open include file 'sub'.\n"
            "WARNING: Can't open library 'sub'.\n");
}

TEST_F(LoaderTest, IncludesInACircleEnd) {
  write("main.scad", "include <a.scad>\nmain();");
  write("a.scad", "include <b.scad>\na();");
  write("b.scad", "include <a.scad>\nb();");
  EXPECT_EQ(load("main.scad"),
            "//Parameter(\"\")\nd = 1;\nb();\na();\nmain();\n");
  EXPECT_EQ(messages(), "WARNING: Can't open include file 'a.scad'.\n");
}

TEST_F(LoaderTest, FilesThatUseEachOtherAreEachReadOnce) {
  write("main.scad", "use <a.scad>\n");
  write("a.scad", "use <b.scad>\nuse <a.scad>\nmodule a() {}");
  write("b.scad", "use <a.scad>\nmodule b() {}");
  load("main.scad");
  EXPECT_EQ(loader_.files().size(), 3u);
  const ast::Program* a = loader_.used_program(program_.uses[0]);
  ASSERT_NE(a, nullptr);
  ASSERT_EQ(a->uses.size(), 2u);
  const ast::Program* b = loader_.used_program(a->uses[1]);
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(loader_.used_program(b->uses[0]), a);
  EXPECT_EQ(ast::print(*b), "module b() {\n}\nd = 1;\n");
}

TEST_F(LoaderTest, TheLastUseIsLookedUpFirst) {
  write("main.scad", "use <a.scad>\nuse <b.scad>\nuse <c.scad>\nuse <a.scad>");
  for (const char* name : {"a.scad", "b.scad", "c.scad"}) write(name, "");
  load("main.scad");
  ASSERT_EQ(program_.uses.size(), 3u);
  EXPECT_EQ(program_.uses[0].file, path("a.scad"));
  EXPECT_EQ(program_.uses[1].file, path("c.scad"));
  EXPECT_EQ(program_.uses[2].file, path("b.scad"));
}

TEST_F(LoaderTest, UsesOfAnIncludedFileBelongToTheMainOne) {
  write("main.scad", "include <sub/i.scad>");
  write("sub/i.scad", "use <u.scad>");
  write("sub/u.scad", "");
  load("main.scad");
  ASSERT_EQ(program_.uses.size(), 1u);
  EXPECT_EQ(program_.uses[0].file, path("sub/u.scad"));
}

TEST_F(LoaderTest, FontsStandApart) {
  write("main.scad", "use <x.TTF>\nuse <no.otf>");
  write("x.TTF", "\x01\x02");
  load("main.scad");
  EXPECT_EQ(program_.uses.size(), 0u);
  ASSERT_EQ(program_.fonts.size(), 2u);
  EXPECT_EQ(program_.fonts[0].file, path("x.TTF"));
  EXPECT_EQ(messages(),
            "WARNING: Can't open library 'no.otf'.\n"
            "ERROR: Can't read font with path 'no.otf'\n");
}

TEST_F(LoaderTest, FontsOfUsedFilesAreTheDesignsToo) {
  write("main.scad", "use <sub/u.scad>\nuse <x.TTF>\nuse <no.otf>");
  write("x.TTF", "");
  write("sub/u.scad", "use <y.otf>\nuse <x.otf>");
  write("sub/y.otf", "");
  load("main.scad");
  EXPECT_EQ(loader_.fonts(),
            (std::vector<std::string>{path("x.TTF"), path("sub/y.otf")}));
}

TEST_F(LoaderTest, AnErrorInAUsedFileDoesNotEndTheRun) {
  write("main.scad", "use <bad.scad>\ncube();");
  write("bad.scad", "module a() { cube( }\n");
  EXPECT_EQ(load("main.scad"), "//Parameter(\"\")\nd = 1;\ncube();\n");
  EXPECT_EQ(diagnostics_.all().size(), 1u);
  EXPECT_EQ(loader_.used_program(program_.uses[0]), nullptr);
}

TEST_F(LoaderTest, AnErrorInAnIncludedFileDoes) {
  write("main.scad", "include <bad.scad>\ncube();");
  write("bad.scad", "x = ;\n");
  EXPECT_THROW(load("main.scad"), SyntaxError);
  ASSERT_EQ(diagnostics_.all().size(), 1u);
  EXPECT_EQ(diagnostics_.all()[0].range.source->path(), path("bad.scad"));
}

TEST_F(LoaderTest, AStatementMayBeginInOneFileAndEndInAnother) {
  write("main.scad", "include <open.scad>\n cube(2); }");
  write("open.scad", "union() { cube(1);");
  EXPECT_EQ(
      load("main.scad"),
      "//Parameter(\"\")\nd = 1;\nunion() {\n\tcube(1);\n\tcube(2);\n}\n");
}

TEST_F(LoaderTest, AMissingMainFileIsAnError) {
  try {
    load("no.scad");
    FAIL() << "no error";
  } catch (const FileError& error) {
    EXPECT_TRUE(
        error.diagnostic().message.starts_with("Can't open input file '"));
  }
}

// OpenSCAD warns where the main file or a file itself is overwritten, not
// where the main file overwrites what it includes.
TEST_F(LoaderTest, OverwrittenVariablesAreWarningsOnlyWhereOpenscadWarns) {
  write("main.scad", "m = 1;\ninclude <a.scad>\ni = 2;\nm = 3;\n");
  write("a.scad", "i = 1;\nm = 2;\ninclude <b.scad>\n");
  write("b.scad", "i = 5;\nb = 1;\nb = 2;\n");
  load("main.scad");
  EXPECT_EQ(messages(),
            "WARNING: m was assigned on line 1 of \"main.scad\" but was "
            "overwritten in file a.scad, line 2\n"
            "WARNING: b was assigned on line 2 of \"b.scad\" but was "
            "overwritten in file b.scad, line 3\n");
}

TEST(LibraryFolders, BeginWithThoseOfTheEnvironment) {
  setenv("OPENSCADPATH", "/a/b:/c/./d", 1);
  const std::vector<std::string> folders = library_folders();
  unsetenv("OPENSCADPATH");
  ASSERT_EQ(folders.size(), 4u);
  EXPECT_EQ(folders[0], "/a/b");
  EXPECT_EQ(folders[1], "/c/d");
  EXPECT_EQ(library_folders().size(), 2u);
}

}  // namespace
}  // namespace lamina
