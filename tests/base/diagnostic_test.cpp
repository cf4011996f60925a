#include "base/diagnostic.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/parser/parsed.h"

namespace lamina {
namespace {

std::string terminal_text(const std::string& text) {
  return Parsed(text).terminal_text();
}

TEST(CaretText, QuotesANameThatLooksLikeAMessage) {
  const Source source("b.scad:9: error: \"no\"", "cube(1);");
  EXPECT_EQ(caret_text({Severity::kWarning, {&source, 0, 4}, "old"}),
            "\"b.scad:9: error: \\\"no\\\"\":1:1: warning: old\n"
            "    1 | cube(1);\n"
            "      | ^~~~\n");
}

TEST(SyntaxErrors, KeepTheWordsOfOpenscad) {
  EXPECT_EQ(Parsed("a = 1;\nb = ;\n").openscad_text(),
            "ERROR: Parser error: syntax error in file x.scad, line 2\n");
  EXPECT_EQ(Parsed("cube(\n").openscad_text(),
            "ERROR: Parser error: syntax error in file x.scad, line 3\n");
  EXPECT_EQ(Parsed("x = \"abc\n").openscad_text(),
            "ERROR: Parser error: Unterminated string in file x.scad, line 4\n"
            "ERROR: Parser error: syntax error in file x.scad, line 4\n");
  EXPECT_EQ(Parsed("x = 1; /* abc\n").openscad_text(),
            "ERROR: Parser error: Unterminated comment in file x.scad, line 4\n"
            "ERROR: Parser error: syntax error in file x.scad, line 4\n");
  EXPECT_EQ(Parsed("a;\n\ninclude <abc\n").messages()[1].message,
            "Parser error: Unterminated include statement");
  EXPECT_EQ(Parsed("use <abc\n").openscad_text(),
            "ERROR: Parser error: Unterminated use statement in file x.scad, "
            "line 1\n"
            "ERROR: Parser error: syntax error in file x.scad, line 1\n");
  // It ends at the first error; the terminal goes on.
  EXPECT_EQ(Parsed("a = ;\nb = ;\n").openscad_text(),
            "ERROR: Parser error: syntax error in file x.scad, line 1\n");
}

TEST(SyntaxErrors, ShowWhatCouldStandThere) {
  EXPECT_EQ(terminal_text("a = 1;\nb = ;\n"),
            "x.scad:2:5: error: Parser error: syntax error\n"
            "    2 | b = ;\n"
            "      |     ^\n"
            "note: unexpected ';', expected an expression\n");
  EXPECT_EQ(terminal_text("a == 1;"),
            "x.scad:1:3: error: Parser error: syntax error\n"
            "    1 | a == 1;\n"
            "      |   ^~\n"
            "note: unexpected '==', expected '(' or '='\n");
}

TEST(SyntaxErrors, KnowTheBitwiseOperators) {
  EXPECT_EQ(terminal_text("a = 1 | ;\nb = 1 &&& 2;\nc = 5 ~ 3;\nd = 1 <<< 2;"),
            "x.scad:1:9: error: Parser error: syntax error\n"
            "    1 | a = 1 | ;\n"
            "      |         ^\n"
            "note: unexpected ';', expected an expression\n"
            "x.scad:2:9: error: Parser error: syntax error\n"
            "    2 | b = 1 &&& 2;\n"
            "      |         ^\n"
            "note: unexpected '&', expected an expression\n"
            "x.scad:3:7: error: Parser error: syntax error\n"
            "    3 | c = 5 ~ 3;\n"
            "      |       ^\n"
            "note: unexpected '~', expected ';'\n"
            "x.scad:4:9: error: Parser error: syntax error\n"
            "    4 | d = 1 <<< 2;\n"
            "      |         ^\n"
            "note: unexpected '<', expected an expression\n");
}

TEST(SyntaxErrors, ShowTheBracketThatWasLeftOpen) {
  EXPECT_EQ(terminal_text("for (i = [0:1:10) cube(i);"),
            "x.scad:1:17: error: Parser error: syntax error\n"
            "    1 | for (i = [0:1:10) cube(i);\n"
            "      |                 ^\n"
            "note: unexpected ')', expected ']'\n"
            "x.scad:1:10: note: opened here\n"
            "    1 | for (i = [0:1:10) cube(i);\n"
            "      |          ^\n");
  EXPECT_EQ(terminal_text("if (x) {\n  cube(1);\n"),
            "x.scad:2:11: error: Parser error: syntax error\n"
            "    2 |   cube(1);\n"
            "      |           ^\n"
            "note: unexpected end of the file, expected ';', '{', '}' or a "
            "module\n"
            "x.scad:1:8: note: opened here\n"
            "    1 | if (x) {\n"
            "      |        ^\n");
}

TEST(SyntaxErrors, ShowWhereAStringBegins) {
  EXPECT_EQ(terminal_text("x = \"abc\n"),
            "x.scad:1:9: error: Parser error: Unterminated string\n"
            "    1 | x = \"abc\n"
            "      |         ^\n"
            "x.scad:1:5: note: it begins here\n"
            "    1 | x = \"abc\n"
            "      |     ^\n");
}

TEST(SyntaxErrors, TellWhatNoTextMayHold) {
  EXPECT_EQ(terminal_text("\tcube(\tä\"ä\");"),
            "x.scad:1:8: error: Parser error: syntax error\n"
            "    1 |  cube( ä\"ä\");\n"
            "      |        ^\n"
            "note: unexpected 'ä': only strings and comments may hold it\n");
  EXPECT_EQ(terminal_text("\xe9;"),
            "x.scad:1:1: error: Parser error: syntax error\n"
            "    1 | ?;\n"
            "      | ^\n"
            "note: unexpected byte 0xE9, which is no UTF-8\n");
  EXPECT_EQ(Parsed("x = 1e999;").messages()[0].hints[0].message,
            "unexpected '1e999', which is beyond the greatest number");
}

// OpenSCAD ends at the first one, and so do the lines of `.echo`.
TEST(SyntaxErrors, OfOneRunAreAllReported) {
  const Parsed parsed(
      "a = ;\n"
      "module m() {\n"
      "  x = [1, 2;\n"
      "  cube(;\n"
      "  sphere(3);\n"
      "}\n"
      "translate([1, 2, 3) { cube(1) }\n"
      "b = 1;\n"
      "c = b +;\n");
  std::vector<std::string> lines;
  for (const Diagnostic& error : parsed.messages()) {
    lines.push_back(openscad_line(error, ""));
  }
  EXPECT_EQ(
      lines,
      std::vector<std::string>(
          {"ERROR: Parser error: syntax error in file x.scad, line 1\n",
           "ERROR: Parser error: syntax error in file x.scad, line 3\n",
           "ERROR: Parser error: syntax error in file x.scad, line 4\n",
           "ERROR: Parser error: syntax error in file x.scad, line 7\n",
           "ERROR: Parser error: syntax error in file x.scad, line 9\n"}));
  EXPECT_EQ(parsed.openscad_text(), lines.front());
}

TEST(SyntaxErrors, InABlockDoNotSpoilWhatFollowsIt) {
  EXPECT_EQ(Parsed("group() { cube( }\nsphere(1);\nb = ;").messages().size(),
            2u);
}

TEST(Warnings, OfOverwrittenVariablesShowBothPlaces) {
  const Parsed parsed("x = 1;\ny = 2;\nx = 3;\n");
  EXPECT_EQ(parsed.openscad_text(),
            "WARNING: x was assigned on line 1 but was overwritten in file "
            "x.scad, line 3\n");
  EXPECT_EQ(parsed.terminal_text(),
            "x.scad:3:1: warning: x was assigned on line 1 but was "
            "overwritten\n"
            "    3 | x = 3;\n"
            "      | ^~~~~~\n"
            "x.scad:1:1: note: assigned here\n"
            "    1 | x = 1;\n"
            "      | ^~~~~~\n");
}

TEST(Warnings, OfOverwrittenVariablesAreForOneScope) {
  EXPECT_EQ(Parsed("x=1; module a() { x=1; group() { x=1; } if(x) { x=1; } "
                   "else { x=1; } }")
                .messages()
                .size(),
            0u);
}

TEST(Warnings, CountCarriageReturnsAsOpenscadDoes) {
  const Parsed parsed("x=1; // c\r\n\r\ny=\"\r\";\r\nx=3;\r\n");
  EXPECT_EQ(parsed.openscad_text(),
            "WARNING: x was assigned on line 1 but was overwritten in file "
            "x.scad, line 6\n");
  EXPECT_TRUE(parsed.terminal_text().starts_with("x.scad:4:1: warning:"));
}

TEST(OpenscadLine, AddsATraceLineForEachNote) {
  const Source source("/designs/lib/a.scad", "f();\ng();\n");
  const Diagnostic warning{Severity::kWarning,
                           {&source, 0, 3},
                           "Ignoring unknown module 'f'",
                           {{{&source, 5, 8}, "called by 'g'"}}};
  EXPECT_EQ(openscad_line(warning, "/designs"),
            "WARNING: Ignoring unknown module 'f' in file lib/a.scad, line 1\n"
            "TRACE: called by 'g' in file lib/a.scad, line 2\n");
  EXPECT_EQ(openscad_line(warning, "/other/x"),
            "WARNING: Ignoring unknown module 'f' in file "
            "../../designs/lib/a.scad, line 1\n"
            "TRACE: called by 'g' in file ../../designs/lib/a.scad, line 2\n");
}

TEST(OpenscadLine, KnowsEchoesAndMessagesWithoutPlace) {
  EXPECT_EQ(openscad_line({Severity::kEcho, {}, "6"}, ""), "ECHO: 6\n");
  EXPECT_EQ(openscad_line({Severity::kDeprecated, {}, "old"}, ""),
            "DEPRECATED: old\n");
}

TEST(OpenscadText, LeavesOutWhatRepeatsTheLastFiveWarnings) {
  const Diagnostic echo{Severity::kEcho, {}, "1"};
  const Diagnostic warning{Severity::kWarning, {}, "w"};
  const Diagnostic other{Severity::kWarning, {}, "v"};
  std::vector<Diagnostic> messages(7, warning);
  messages.insert(messages.begin() + 3, echo);
  messages.push_back(other);
  messages.push_back(warning);
  EXPECT_EQ(openscad_text(messages, ""),
            "WARNING: w\nWARNING: w\nWARNING: w\nECHO: 1\nWARNING: w\n"
            "WARNING: w\nWARNING: v\nWARNING: w\n");
}

TEST(CaretText, MarksARangeOfSeveralLinesToTheEndOfItsFirst) {
  const Source source("a.scad", "cube([1,\n2]);\n");
  EXPECT_EQ(caret_text({Severity::kError, {&source, 0, 12}, "no"}),
            "a.scad:1:1: error: no\n"
            "    1 | cube([1,\n"
            "      | ^~~~~~~~\n");
}

TEST(CaretText, ShowsNoLineThatIsTooLong) {
  const Source source("a.scad", std::string(1000, 'a'));
  EXPECT_EQ(caret_text({Severity::kWarning, {&source, 500, 501}, "no"}),
            "a.scad:1:501: warning: no\n");
}

// A design chooses the words of its messages, and a file its name.
TEST(CaretText, CannotSteerATerminalNorForgeALine) {
  const Source source("a\x1b[2J\nb.scad", "cube();");
  EXPECT_EQ(caret_text({Severity::kEcho,
                        {},
                        "\"\x1b[31m\x07\r\xc2\x9b \xe2\x80\xae\xff\n"
                        "error: forged\n\tx\""}),
            "ECHO: \"\\u001B[31m\\u0007\\u000D\\u009B \\u202E\uFFFD\n"
            "| error: forged\n"
            "| \tx\"\n");
  EXPECT_EQ(caret_text({Severity::kError, {&source, 0, 4}, "no"}),
            "a\\u001B[2J\\u000Ab.scad:1:1: error: no\n"
            "    1 | cube();\n"
            "      | ^~~~\n");
  const Source turned("a.scad",
                      "a\xe2\x80\xae"
                      "b();");
  EXPECT_EQ(caret_text({Severity::kError, {&turned, 0, 1}, "no"}),
            "a.scad:1:1: error: no\n"
            "    1 | a b();\n"
            "      | ^\n");
}

}  // namespace
}  // namespace lamina
