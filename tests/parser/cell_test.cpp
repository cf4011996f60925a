#include "parser/cell.h"

#include <string>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "parser/customizer/definitions.h"
#include "parser/loader.h"
#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

using enum ast::ValueType;

std::string value(const std::string& cell, ast::ValueType kind = kAny,
                  DecimalSign decimal = DecimalSign::kPoint) {
  try {
    return value_of_cell(cell, kind, decimal);
  } catch (const FileError& error) {
    return error.what();
  }
}

bool is_refused(const std::string& cell, ast::ValueType kind,
                const std::string& words) {
  return value(cell, kind).starts_with(words);
}

TEST(Cell, LooksLikeWhatItIs) {
  for (const char* const number : {"57", "-1.5", "1e3", "0.25", "1E-2", ".5"}) {
    EXPECT_EQ(value(number), number);
  }
  EXPECT_EQ(value("+3"), "3");
  EXPECT_EQ(value("true"), "true");
  EXPECT_EQ(value("FALSE"), "false");
  EXPECT_EQ(value("[1, -2.5, [true, \"a]\"]]"), "[1, -2.5, [true, \"a]\"]]");
  EXPECT_EQ(value("\"57\""), "\"57\"");
  EXPECT_EQ(value("\"a\\\"b\""), "\"a\\\"b\"");
  EXPECT_EQ(value("[1, /* c */ 2] /* c */"), "[1, /* c */ 2] /* c */");
}

TEST(Cell, IsTextElse) {
  EXPECT_EQ(value("Ada"), "\"Ada\"");
  EXPECT_EQ(value("N 1/2"), "\"N 1/2\"");
  EXPECT_EQ(value("57 mm"), "\"57 mm\"");
  EXPECT_EQ(value("nan"), "\"nan\"");
  EXPECT_EQ(value("undef"), "\"undef\"");
  EXPECT_EQ(value("1,5"), "\"1,5\"");
  EXPECT_EQ(value("\"Ada\" and \"Bea\""), R"("\"Ada\" and \"Bea\"")");
  EXPECT_EQ(value("\"a\"//\""), R"("\"a\"//\"")");
  EXPECT_EQ(value(R"("a"; x = "b")"), R"("\"a\"; x = \"b\"")");
  EXPECT_EQ(value("a\\b\n"), R"("a\\b\n")");
  EXPECT_EQ(value("\"a\"; cube(1); x = \"b\""),
            R"("\"a\"; cube(1); x = \"b\"")");
}

TEST(Cell, IsTextForAVariableThatIsText) {
  EXPECT_EQ(value("2024", kString), "\"2024\"");
  EXPECT_EQ(value("true", kString), "\"true\"");
  EXPECT_EQ(value("[1]", kString), "\"[1]\"");
  EXPECT_EQ(value("\"2024\"", kString), "\"2024\"");
}

TEST(Cell, HasTheKindOfTheVariable) {
  EXPECT_EQ(value("57", kNumber), "57");
  EXPECT_EQ(value("fifty", kNumber),
            "a number was expected, not 'fifty' (text would stand in quotes: "
            "\"fifty\")");
  EXPECT_TRUE(is_refused("true", kNumber, "a number was expected"));
  EXPECT_EQ(value("\"auto\"", kNumber), "\"auto\"");
  EXPECT_TRUE(is_refused("1", kBool, "true or false was expected"));
  EXPECT_EQ(value("True", kBool), "true");
  EXPECT_TRUE(is_refused("3", kVector, "a vector such as [1, 2.5] was"));
  EXPECT_EQ(value("[3]", kVector), "[3]");
}

TEST(Cell, IsAVectorAsAWholeOrNotAtAll) {
  for (const char* const cell :
       {"[1", "[1]]", "[x]", "[1] + [2]", "[1]; cube(1); y = [2]", "[1, 2]//",
        "[1, 2] // c", "[1] /*", "[1];", "[1];;", "[1];{}", "[1];*cube(1)",
        "[1]; x = [2]"}) {
    EXPECT_TRUE(is_refused(cell, kAny, "a vector such as [1, 2.5] was"))
        << cell;
  }
}

TEST(Cell, MayHaveADecimalCommaWhereCellsAreSeparatedOtherwise) {
  const auto with_comma = [](const std::string& cell, ast::ValueType kind) {
    return value(cell, kind, DecimalSign::kPointOrComma);
  };
  EXPECT_EQ(with_comma("54,5", kAny), "54.5");
  EXPECT_EQ(with_comma("-0,25", kNumber), "-0.25");
  EXPECT_EQ(with_comma("54.5", kNumber), "54.5");
  EXPECT_EQ(with_comma("54,5", kString), "\"54,5\"");
  EXPECT_EQ(with_comma("1,234.5", kNumber).find("a number was expected"), 0U);
}

// Tables may come from strangers.
TEST(Cell, OpensNoFile) {
  const support::TemporaryFolder folder;
  const std::string empty = folder.write("empty.scad", "");
  const std::string font = folder.write("empty.ttf", "");
  const std::string missing = folder.file("missing.scad");
  for (const std::string& file : {empty, font, missing}) {
    for (const std::string word : {"include", "use"}) {
      const std::string name = word + " <" + file + ">";
      for (const std::string& cell :
           {"[1]; " + name, "[1] " + name, "[" + name + " 1]"}) {
        EXPECT_TRUE(is_refused(cell, kAny, "a vector such as")) << cell;
        EXPECT_TRUE(is_refused(cell, kVector, "a vector such as")) << cell;
      }
      // Text as it stands, quotes and all.
      const std::string quoted = "\"a\" " + name + " \"\"";
      EXPECT_TRUE(value(quoted).starts_with("\"\\\"a")) << quoted;
    }
  }
}

TEST(Variables, AreThoseThatDefinitionsSet) {
  const support::TemporaryFolder folder;
  folder.write("lib.scad", "depth = 0.3; size = [1];");
  folder.write("part.scad", "text = \"Ada\";");
  const std::string path = folder.write(
      "a.scad",
      "use <lib.scad>\ninclude <part.scad>\nsize = 1; size = 27 * 2;\n"
      "open = !true; low = [1, 2]; wide = size / 2;\n"
      "module m() { inner = 1; }\n");
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, {});
  const Variables variables = find_variables(loader.load(path), loader);
  EXPECT_EQ(variables, (Variables{{"depth", kNumber},
                                  {"low", kVector},
                                  {"open", kBool},
                                  {"size", kNumber},
                                  {"text", kString},
                                  {"wide", kAny}}));
}

}  // namespace
}  // namespace lamina
