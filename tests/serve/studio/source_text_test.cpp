// Values written back into a design's text.

#include "serve/studio/source_text.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "base/source.h"
#include "parser/loader.h"
#include "tests/support/temporary_folder.h"

namespace lamina::studio {
namespace {

class SourceText : public testing::Test {
 protected:
  SourceEdit edit(const std::string& text, const ParameterSet& values,
                  const std::string& definitions = "") {
    folder_.write("a.scad", text);
    loader_ = std::make_unique<Loader>(sources_, diagnostics_,
                                       std::vector<std::string>(), definitions);
    program_ = loader_->load(folder_.path() + "/a.scad");
    return edit_source(program_, values, Language::k2021, diagnostics_);
  }

  support::TemporaryFolder folder_;
  SourceStore sources_;
  Diagnostics diagnostics_;
  std::unique_ptr<Loader> loader_;
  ast::Program program_;
};

TEST_F(SourceText, KeepsAllButTheValues) {
  const SourceEdit made =
      edit("/* é */ a=1;b  =  [1,2] ; // [1:9]\r\n\tc = true;\ncube(a);",
           {{"a", "2.5"}, {"b", "[3, 4]"}, {"c", "false"}});
  EXPECT_EQ(made.text,
            "/* é */ a=2.5;b  =  [3, 4] ; // [1:9]\r\n\tc = false;\ncube(a);");
  EXPECT_EQ(made.diff,
            "--- a.scad\n+++ a.scad\n"
            "@@ -1,1 +1,1 @@\n"
            "-/* é */ a=1;b  =  [1,2] ; // [1:9]\r\n"
            "+/* é */ a=2.5;b  =  [3, 4] ; // [1:9]\r\n"
            "@@ -2,1 +2,1 @@\n"
            "-\tc = true;\n"
            "+\tc = false;\n");
}

TEST_F(SourceText, IsEqualWhereNothingChanges) {
  const SourceEdit made =
      edit("a = 1;\nb = \"x\";\n", {{"a", "1"}, {"b", "x"}});
  EXPECT_EQ(made.text, made.before);
  EXPECT_EQ(made.diff, "");
}

TEST_F(SourceText, LeavesOtherFilesAndOptionsAlone) {
  folder_.write("b.scad", "w = 5;\n");
  const SourceEdit made = edit("include <b.scad>\na = 1;\n",
                               {{"a", "3"}, {"w", "6"}, {"k", "7"}}, "k=2;\n");
  EXPECT_EQ(made.text, "include <b.scad>\na = 3;\n");
}

TEST_F(SourceText, TakesTheAssignmentThatCounts) {
  EXPECT_EQ(edit("a = 1;\na = 2;\n", {{"a", "3"}}).text, "a = 1;\na = 3;\n");
}

TEST_F(SourceText, ReplacesAValueOfSeveralLines) {
  const SourceEdit made = edit("a = [1,\n  2];\n", {{"a", "[3, 4]"}});
  EXPECT_EQ(made.text, "a = [3, 4];\n");
  EXPECT_EQ(made.diff,
            "--- a.scad\n+++ a.scad\n@@ -1,2 +1,1 @@\n"
            "-a = [1,\n-  2];\n+a = [3, 4];\n");
}

TEST_F(SourceText, WritesNumbersInFull) {
  EXPECT_EQ(edit("a = 1;\n", {{"a", "1.23456789"}}).text, "a = 1.23456789;\n");
}

}  // namespace
}  // namespace lamina::studio
