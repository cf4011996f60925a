#include "parser/parser.h"

#include <gtest/gtest.h>

#include "parser/loader.h"

namespace lamina {
namespace {

TEST(Parser, SyntaxErrorKeepsTheWordsOfOpenscad) {
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, {});
  EXPECT_THROW(loader.load_text("x.scad", "a = 1;\nb = ;\nc = ;\n"),
               SyntaxError);
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_EQ(openscad_line(diagnostics.all()[0], ""),
            "ERROR: Parser error: syntax error in file x.scad, line 2\n");
  EXPECT_EQ(caret_text(diagnostics.all()[0]),
            "x.scad:2:5: error: Parser error: syntax error\n"
            "    2 | b = ;\n"
            "      |     ^\n"
            "note: unexpected ';', expected an expression\n");
}

}  // namespace
}  // namespace lamina
