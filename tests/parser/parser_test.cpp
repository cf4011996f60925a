#include "parser/parser.h"

#include <cmath>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "tests/parser/parsed.h"

namespace lamina {
namespace {

std::string repeat(const std::string& text, int count) {
  std::string result;
  result.reserve(text.size() * static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

const ast::Expr& first_value(const Parsed& parsed) {
  const ast::Statement& statement = *parsed.program().statements[0];
  return *std::get<ast::Assignment>(statement.node).value;
}

std::string string_value(const std::string& literal) {
  const Parsed parsed("s = " + literal + ";");
  return std::string(std::get<ast::String>(first_value(parsed).node).value);
}

double number_value(const std::string& literal) {
  const Parsed parsed("n = " + literal + ";");
  return std::get<ast::Number>(first_value(parsed).node).value;
}

// --- Operators -------------------------------------------------------------

TEST(Precedence, PowerBindsTighterThanTheSignBeforeItButNotBehindIt) {
  EXPECT_EQ(Parsed::expression("-2^2"), "-(2 ^ 2)");
  EXPECT_EQ(Parsed::expression("2^-2^2"), "(2 ^ -(2 ^ 2))");
  EXPECT_EQ(Parsed::expression("a^!b == c"), "((a ^ !b) == c)");
}

TEST(Precedence, PowerGroupsToTheRightAllOthersToTheLeft) {
  EXPECT_EQ(Parsed::expression("2^3^2"), "(2 ^ (3 ^ 2))");
  EXPECT_EQ(Parsed::expression("8/4/2%3*1"), "((((8 / 4) / 2) % 3) * 1)");
  EXPECT_EQ(Parsed::expression("1-2-3+4"), "(((1 - 2) - 3) + 4)");
  EXPECT_EQ(Parsed::expression("a<b<=c>d>=e"), "((((a < b) <= c) > d) >= e)");
  EXPECT_EQ(Parsed::expression("a==b!=c"), "((a == b) != c)");
}

TEST(Precedence, NotBindsTighterThanComparison) {
  EXPECT_EQ(Parsed::expression("!a==b"), "(!a == b)");
  EXPECT_EQ(Parsed::expression("!-!a.x[1](2)"), "!-!(a.x[1])(2)");
}

TEST(Precedence, FallsFromPowerToTheConditional) {
  EXPECT_EQ(Parsed::expression("a || b && c == d < e + f * g ^ h"),
            "(a || (b && (c == (d < (e + (f * (g ^ h)))))))");
  EXPECT_EQ(Parsed::expression("a ? b : c ? d : e"), "(a ? b : (c ? d : e))");
  EXPECT_EQ(Parsed::expression("a ? b ? c : d : e"), "(a ? (b ? c : d) : e)");
}

TEST(Precedence, LetAndFunctionReachFarAndAreNoOperands) {
  EXPECT_EQ(Parsed::expression("let(a = 1) a + 1"), "let(a = 1) (a + 1)");
  EXPECT_EQ(Parsed::expression("function(x) x + 1"), "function(x) (x + 1)");
  EXPECT_EQ(Parsed::expression("1 + (let(a = 1) a)"), "(1 + let(a = 1) a)");
  EXPECT_EQ(Parsed::expression("1 + let(a = 1) a"), "syntax error");
  EXPECT_EQ(Parsed::expression("-function(x) x"), "syntax error");
}

TEST(Parser, UnaryPlusLeavesNoTrace) {
  EXPECT_EQ(Parsed::expression("+ +a"), "a");
}

// --- Literals --------------------------------------------------------------

TEST(Numbers, MayBeginOrEndWithAPoint) {
  EXPECT_EQ(number_value("1."), 1);
  EXPECT_EQ(number_value(".5"), 0.5);
  EXPECT_EQ(number_value("1e3"), 1000);
  EXPECT_EQ(number_value("2.5E-2"), 0.025);
  EXPECT_EQ(number_value("1.e+1"), 10);
  EXPECT_EQ(number_value("007"), 7);
}

TEST(Numbers, KeepEveryBit) {
  EXPECT_EQ(number_value("0.1"), 0.1);
  EXPECT_EQ(number_value("1.7976931348623157e308"), 1.7976931348623157e308);
  EXPECT_EQ(number_value("4.9406564584124654e-324"), 4.9406564584124654e-324);
  EXPECT_EQ(number_value("1e-999"), 0);
}

TEST(Numbers, BeyondDoubleAreAnError) {
  EXPECT_TRUE(Parsed("x = 1e999;").has_failed());
}

TEST(Numbers, OfAVectorOfNothingElseLieFlat) {
  const Parsed parsed("x = [1, -2, -0];");
  const auto& numbers = std::get<ast::Numbers>(first_value(parsed).node);
  ASSERT_EQ(numbers.values.size(), 3u);
  EXPECT_EQ(numbers.values[1], -2);
  EXPECT_TRUE(std::signbit(numbers.values[2]));
  EXPECT_EQ(Parsed::expression("[1, -2, -0]"), "[1, -2, -0]");
  EXPECT_EQ(Parsed::expression("[1, +2, --3, a]"), "[1, 2, --3, a]");
}

TEST(Names, MayBeginWithADigitOrADollar) {
  EXPECT_EQ(Parsed::expression("2d + 1e + $fn + 1e5x"),
            "(((2d + 1e) + $fn) + 1e5x)");
  EXPECT_EQ(Parsed::expression("$"), "syntax error");
}

TEST(Names, OfModulesMayBeKeywordsOfExpressions) {
  EXPECT_EQ(Parsed("for() let() each() echo() assert();").ast(),
            "for() let() each() echo() assert();\n");
}

TEST(Strings, DecodeTheirEscapes) {
  EXPECT_EQ(string_value(R"("\n\t\r\\\"")"), "\n\t\r\\\"");
  EXPECT_EQ(string_value(R"("\x41\u20ac\U01f600")"), "A€😀");
}

TEST(Strings, ShowABlankForWhatIsNoCharacter) {
  EXPECT_EQ(string_value(R"("\x00|\u0000|\ud800|\U110000")"), " | | | ");
}

TEST(Strings, LoseTheBackslashOfAnUnknownEscape) {
  EXPECT_EQ(string_value(R"("\q\x9f\u12")"), "qx9fu12");
}

TEST(Strings, LoseTheirLineBreaks) {
  EXPECT_EQ(string_value("\"a\nb\""), "ab");
}

TEST(Strings, MayHoldAnyBytes) {
  EXPECT_EQ(string_value("\"ä\xff//\""), "ä\xff//");
}

TEST(Blanks, MayBeNoBreakSpaces) {
  EXPECT_EQ(Parsed("x\xc2\xa0=\xa0"
                   "1;")
                .ast(),
            "//Parameter(\"\")\nx = 1;\n");
}
TEST(Blanks, MayBeByteOrderMarks) {
  EXPECT_EQ(Parsed("\xef\xbb\xbf"
                   "x = 1;")
                .ast(),
            "//Parameter(\"\")\nx = 1;\n");
}

TEST(Comments, EndWhereTheyShould) {
  EXPECT_EQ(Parsed::expression("1/**/+/***/2/* // */+3// */\n"),
            "((1 + 2) + 3)");
}

// --- Lists -----------------------------------------------------------------

TEST(Commas, MayBeRepeatedWhereOpenscadAllowsIt) {
  EXPECT_EQ(Parsed::expression("[1,,a,,]"), "[1, a]");
  EXPECT_EQ(Parsed::expression("[,,]"), "[]");
  EXPECT_EQ(Parsed::expression("f(,1,,2)"), "f(1, 2)");
  EXPECT_EQ(Parsed::expression("f(1,)"), "f(1)");
  EXPECT_EQ(Parsed::expression("f(1,,)"), "syntax error");
  EXPECT_EQ(Parsed::expression("[,1]"), "syntax error");
  EXPECT_EQ(Parsed::expression("function(a,,b=1,) a"), "function(a, b = 1) a");
}

TEST(Comprehensions, MayStandInOneAnother) {
  EXPECT_EQ(Parsed::expression("[for(i=[0:2], j=a) if(i) each [i] else j]"),
            "[for(i = [0 : 2]) (for(j = a) (if(i) (each ([i])) else (j)))]");
  EXPECT_EQ(Parsed::expression("[for(i=0; i<3; i=i+1) let(k=i) (each k)]"),
            "[for(i = 0;(i < 3);i = (i + 1)) let(k = i) (each (k))]");
}

TEST(Comprehensions, StandInVectorsOnly) {
  EXPECT_EQ(Parsed::expression("for(i=a) i"), "syntax error");
  EXPECT_EQ(Parsed::expression("each a"), "syntax error");
}

TEST(Comprehensions, GiveAnElseToTheNearestIf) {
  EXPECT_EQ(Parsed::expression("[if(a) if(b) 1 else 2]"),
            "[if(a) (if(b) (1) else (2))]");
}

TEST(Expressions, AssertAndEchoMayHaveNoBody) {
  EXPECT_EQ(Parsed::expression("assert(a, \"b\") echo(c)"),
            "assert(a, \"b\") echo(c)");
}

TEST(Calls, MayHaveAnyCallee) {
  EXPECT_EQ(Parsed::expression("f(1)(2)[3].x(4)"), "((f(1))(2)[3].x)(4)");
}

// --- Statements ------------------------------------------------------------

TEST(Statements, InBareBracesBelongToTheScopeAround) {
  const Parsed parsed("\n{ a = 1; { cube(); } } a = 2;");
  EXPECT_EQ(parsed.ast(), "a = 2;\ncube();\n");
  EXPECT_EQ(parsed.openscad_text(),
            "WARNING: a was assigned on line 2 but was overwritten in file "
            "x.scad, line 2\n");
}

TEST(Statements, DisabledVanishWithTheirChildren) {
  EXPECT_EQ(Parsed("*cube(); !*#a() b(); group() { *c(); }").ast(),
            "group();\n");
}

TEST(Statements, KeepTheirModifiers) {
  const Parsed parsed("!#cube(); %if (a) b();");
  const auto& cube =
      std::get<ast::Instantiation>(parsed.program().statements[0]->node);
  EXPECT_TRUE(cube.modifiers.root && cube.modifiers.highlight &&
              !cube.modifiers.background);
  const auto& if_else =
      std::get<ast::IfElse>(parsed.program().statements[1]->node);
  EXPECT_TRUE(if_else.modifiers.background && !if_else.modifiers.root);
}

TEST(Statements, GiveAnElseToTheNearestIf) {
  EXPECT_EQ(Parsed("if(a) if(b) c(); else d(); else e();").ast(),
            "if(a) if(b) c();\nelse d();\nelse e();\n");
}

TEST(Statements, OfAModuleMayBeOneOrNone) {
  EXPECT_EQ(Parsed("module a() cube(); module b();").ast(),
            "module a() {\n\tcube();\n}\nmodule b() {\n}\n");
}

TEST(Statements, DefineNothingAmongChildren) {
  EXPECT_TRUE(Parsed("group() { module a() {} }").has_failed());
  EXPECT_TRUE(Parsed("group() { function a() = 1; }").has_failed());
  EXPECT_EQ(Parsed("group() { a = 1; }").ast(), "group() {\n\ta = 1;\n}\n");
}

TEST(Statements, OfDefinitionsOverwriteWithoutAWarning) {
  const Parsed parsed("a = 1;", "a=2;\n");
  EXPECT_EQ(parsed.ast(), "//Parameter(\"\")\na = 2;\n");
  EXPECT_EQ(parsed.messages().size(), 0u);
}

TEST(Statements, KnowTheirPlaceInTheText) {
  const Parsed parsed("a = 1;\n  rotate(45)\n cube([1,\n2]);");
  const ast::Statement& rotate = *parsed.program().statements[1];
  EXPECT_EQ(rotate.range.text(), "rotate(45)");
  const auto& node = std::get<ast::Instantiation>(rotate.node);
  EXPECT_EQ(node.children[0]->range.text(), "cube([1,\n2])");
}

TEST(Statements, PlaceAnIfOfSeveralLinesAtItsParenthesis) {
  const Parsed parsed("if (a ||\n    b\n) cube();\nif (a) cube();");
  EXPECT_EQ(parsed.program().statements[0]->range.begin, 15u);
  EXPECT_EQ(parsed.program().statements[1]->range.text(), "if (a)");
}

TEST(Expressions, KnowTheirPlaceInTheText) {
  const Parsed parsed("x = (1 + b) * f(2);");
  const ast::Expr& product = first_value(parsed);
  EXPECT_EQ(product.range.text(), "(1 + b) * f(2)");
  const auto& node = std::get<ast::Binary>(product.node);
  EXPECT_EQ(node.left->range.text(), "1 + b");
  EXPECT_EQ(node.right->range.text(), "f(2)");
}

// --- Hostile input ---------------------------------------------------------

TEST(HostileInput, DeepNestingIsAResultOrAClearError) {
  constexpr int kDeep = 200'000;
  constexpr int kTooDeep = 1'000'000;
  EXPECT_EQ(
      Parsed(std::string("x=") + repeat("[", kDeep) + repeat("]", kDeep) + ";")
          .ast()
          .size(),
      std::string("//Parameter(\"\")\nx = ;\n").size() +
          std::size_t{2} * kDeep);
  const std::string words =
      "ERROR: Parser error: memory exhausted in file x.scad, line 1\n";
  for (const char* nested : {"[", "(", "{", "-", "a?b:", "2^", "translate()",
                             "if(a) b(); else ", "function(x) ", "a[", "f("}) {
    const Parsed parsed(std::string("x=1;y=") + repeat(nested, kTooDeep));
    const Parsed statement(repeat(nested, kTooDeep));
    EXPECT_TRUE(parsed.has_failed() && statement.has_failed()) << nested;
    const bool is_clear = parsed.openscad_text().starts_with(words) ||
                          statement.openscad_text().starts_with(words);
    EXPECT_TRUE(is_clear) << nested;
  }
}

TEST(HostileInput, LongChainsAreAResultOrAClearError) {
  const std::string sum =
      Parsed::expression(std::string("a") + repeat("+a", 99'999));
  EXPECT_EQ(sum.size(), 99'999u * 6 + 1);
  EXPECT_EQ(Parsed(std::string("x=a") + repeat("+a", 1'000'000) + ";")
                .openscad_text(),
            "ERROR: Parser error: memory exhausted in file x.scad, line 1\n");
  EXPECT_TRUE(
      Parsed(std::string("x=a") + repeat(".x", 1'000'000) + ";").has_failed());
}

TEST(HostileInput, LongTokensTakeLinearTime) {
  const std::string name = repeat("a", 20'000'000);
  EXPECT_FALSE(Parsed(name + "=1;").has_failed());
  EXPECT_FALSE(Parsed("/*" + name + "*/x=\"" + name + "\";").has_failed());
}

TEST(HostileInput, ErrorsWithoutEndAreGivenUp) {
  EXPECT_EQ(Parsed(repeat("a=;\n", 100'000)).messages().size(), 20u);
}

TEST(HostileInput, AZeroByteEndsTheTextWithAWarning) {
  using namespace std::string_literals;
  const Parsed parsed("a = 1;\0 b = 2;"s);
  EXPECT_EQ(parsed.ast(), "//Parameter(\"\")\na = 1;\n");
  EXPECT_EQ(parsed.terminal_text(),
            "x.scad:1:7: warning: Ignoring all text after a zero byte\n"
            "    1 | a = 1;  b = 2;\n"
            "      |       ^\n");
}

TEST(HostileInput, LineBreaksMayBeThoseOfWindows) {
  EXPECT_EQ(Parsed("a = 1;\r\n// b\r\ncube(a\r\n);\r\n").ast(),
            "//Parameter(\"\")\na = 1;\ncube(a);\n");
}

TEST(HostileInput, NothingIsAProgram) {
  EXPECT_EQ(Parsed("").ast(), "");
  EXPECT_EQ(Parsed(";;{}{;}").ast(), "");
}

}  // namespace
}  // namespace lamina
