#include "parser/customizer/parameter_set.h"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "parser/customizer/program_printer.h"
#include "tests/parser/parsed.h"
#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

// A design after a set of a file is applied. (What openscad 2021.01 makes of
// the same sets is compared in tests/conformance.)
class Applied {
 public:
  Applied(const std::string& design, const std::string& file,
          const std::string& set = "s", Language language = Language::k2021)
      : parsed_(design), program_(parsed_.program()) {
    folder_.write("f.json", file);
    try {
      is_good_ = apply_parameter_set(
          ParameterSets::read(folder_.file("f.json")).values_of(set), program_,
          language, messages_);
    } catch (const FileError& fault) {
      messages_.report(fault.diagnostic());
    }
  }

  bool is_good() const { return is_good_; }
  std::string ast() const { return ast::print(program_); }
  // The first, with its hint.
  std::string message() const {
    if (messages_.all().empty()) return "";
    const Diagnostic& first = messages_.all()[0];
    return first.hints.empty()
               ? first.message
               : fmt::format("{} ({})", first.message, first.hints[0].message);
  }

 private:
  support::TemporaryFolder folder_;
  Parsed parsed_;
  ast::Program program_;
  Diagnostics messages_;
  bool is_good_ = false;
};

std::string set_of(const std::string& entries) {
  return R"({"parameterSets": {"s": {)" + entries + R"(}}})";
}

// `x = <value>;` with the entry `"x": <entry>`, without its comment.
std::string applied(const std::string& value, const std::string& entry) {
  const std::string ast =
      Applied("x = " + value + ";", set_of("\"x\": " + entry)).ast();
  return ast.substr(ast.find("x = "));
}

TEST(ParameterSet, GivesAValueOfTheTypeThatTheParameterHas) {
  EXPECT_EQ(applied("1", "\"2.5\""), "x = 2.5;\n");
  EXPECT_EQ(applied("1", "-3"), "x = -3;\n");
  EXPECT_EQ(applied("\"a\"", "\"b c\""), "x = \"b c\";\n");
  EXPECT_EQ(applied("\"a\"", "1.50"), "x = \"1.50\";\n");
  EXPECT_EQ(applied("true", "\"false\""), "x = false;\n");
  EXPECT_EQ(applied("false", "1"), "x = true;\n");
  EXPECT_EQ(applied("[1, 2]", "\"[3, 4, a]\""), "x = [3, 4, \"a\"];\n");
  EXPECT_EQ(applied("[1:2]", "\"[1:2:9]\""), "x = [1 : 2 : 9];\n");
}

TEST(ParameterSet, KeepsEveryDigit) {
  const Applied applied("x = 0;", set_of(R"("x": "0.1234567890123")"));
  EXPECT_TRUE(applied.is_good());
}

TEST(ParameterSet, LeavesWhatDoesNotFit) {
  EXPECT_EQ(applied("1", "\"word\""), "x = 1;\n");
  EXPECT_EQ(applied("[1, 2]", "\"5\""), "x = [1, 2];\n");
  EXPECT_EQ(applied("undef", "\"5\""), "x = undef;\n");
  EXPECT_EQ(applied("y", "\"5\""), "x = y;\n");
  EXPECT_EQ(applied("1", "[2]"), "x = 1;\n");
}

// The first warning of a set.
std::string warning(const std::string& design, const std::string& entries,
                    Language language = Language::k2021) {
  return Applied(design, set_of(entries), "s", language).message();
}

TEST(ParameterSet, LosesNoValueWithoutAWarning) {
  const std::string keeps = "; it keeps its own value";
  EXPECT_EQ(warning("size = 1;", R"("sice": "5")"),
            "the set has 'sice', the design has no such variable "
            "(did you mean 'size'?)");
  EXPECT_EQ(
      warning("a = 1; size = a * 2;", R"("size": "5")"),
      "parameter size = 5 of the set can't replace what is computed" + keeps);
  EXPECT_EQ(
      warning("u = undef;", R"("u": "5")"),
      "parameter u = 5 of the set can't replace what is computed" + keeps);
  const std::string text_for_number =
      "parameter x = abc of the set is no value for it" + keeps;
  for (const char* design :
       {"x = 1;", "/* [Hidden] */\nx = 1;", "module m() {}\nx = 1;",
        "x = [1, \"a\"];", "x = [0:2];", "x = -1;", "x = 1 + 2;"}) {
    EXPECT_EQ(warning(design, R"("x": "abc")"), text_for_number) << design;
  }
  // A label of the comment is a choice, and no number.
  EXPECT_EQ(warning("x = 1; // [1, two]", R"("x": "two")"),
            "parameter x = two of the set is no value for it" + keeps);
  EXPECT_EQ(warning("x = \"Ada\";", R"("x": ["Bo"])"),
            "parameter x =  of the set is a list or an object; it is taken for "
            "an empty text");
}

TEST(ParameterSet, LosesNoValueWithoutAWarningIn2026) {
  const std::string said =
      "parameter x = 5 of the set is for no parameter of the customizer; it "
      "keeps its own value";
  for (const char* design :
       {"/* [Hidden] */\nx = 1;", "module m() {}\nx = 1;", "x = [0:2];",
        "y = 2; x = y;", "x = [1, 2, 3, 4, 5];"}) {
    EXPECT_EQ(warning(design, R"("x": "5")", Language::k2026), said) << design;
  }
  // OpenSCAD 2021.01 saves hidden parameters, too.
  EXPECT_EQ(warning("/* [Hidden] */\nx = [1.50, 2];", R"("x": "[1.5, 2]")",
                    Language::k2026),
            "");
}

TEST(ParameterSet, WarnsOfNoValueThatTheDesignGets) {
  EXPECT_EQ(warning("x = 1; // [0:9]\n/* [Hidden] */\ny = [1, \"a\"];\n"
                    "module m() {}\nz = 2 + 3; t = true; s = \"\";",
                    R"("x": "2", "y": "[2, \"b\"]", "z": 7, "t": 0, "s": "")"),
            "");
}

TEST(ParameterSet, OfManyNamesTakesTimeInProportion) {
  // Guesses for all of them would take minutes.
  std::string design;
  std::string entries;
  for (int i = 0; i < 20'000; ++i) {
    design += fmt::format("variable_{:05} = 1;\n", i);
    entries += fmt::format("\"variables{:05}\": \"1\",", i);
  }
  EXPECT_EQ(warning(design, entries + R"("x": "1")"),
            "the set has 'variables00000', the design has no such variable "
            "(did you mean 'variable_00000'?)");
}

TEST(ParameterSet, SetsTheAssignmentThatCounts) {
  EXPECT_EQ(Applied("x = 1;\nx = 2;\ncube(x);", set_of("\"x\": 3")).ast(),
            "//Parameter(\"\")\nx = 3;\ncube(x);\n");
}

TEST(ParameterSet, MakesNoParameterOfASum) {
  EXPECT_EQ(Applied("x = 1 + 2;", set_of("\"x\": 7")).ast(), "x = 7;\n");
}

TEST(ParameterSet, EndsAtAValueThatIsNeitherTrueNorFalse) {
  const Applied applied("a = 1;\nb = true;\nc = 1;",
                        set_of(R"("c": 5, "b": "maybe", "a": 5)"));
  EXPECT_FALSE(applied.is_good());
  EXPECT_EQ(applied.message(),
            "Cannot apply Parameter Set 'conversion of data to type \"b\" "
            "failed'");
  EXPECT_NE(applied.ast().find("a = 5;"), std::string::npos);
  EXPECT_NE(applied.ast().find("b = true;"), std::string::npos);
  EXPECT_NE(applied.ast().find("c = 1;"), std::string::npos);
}

TEST(ParameterSet, MustBeThere) {
  EXPECT_TRUE(Applied("x = 1;", set_of("")).is_good());
  for (const char* file :
       {"{}", "[]", "1", R"({"parameterSets": {}})",
        R"({"parameterSets": [{"s": {"x": 1}}]})", R"({"s": {"x": 1}})",
        R"([{"s": {"x": 1}}])", R"({"parameterSets": {"s": ["x"]}})",
        R"({"parameterSets": {"a": {"s": {"x": 1}}, "s": 1}})"}) {
    const Applied applied("x = 1;", file);
    EXPECT_FALSE(applied.is_good()) << file;
    EXPECT_NE(applied.message().find("has no such set"), std::string::npos)
        << applied.message();
  }
}

TEST(ParameterSet, NamesTheLineOfBadJson) {
  const Applied applied("x = 1;", "{\n\"parameterSets\": }\n");
  EXPECT_FALSE(applied.is_good());
  EXPECT_NE(applied.message().find("f.json(2): syntax error"),
            std::string::npos)
      << applied.message();
}

TEST(ParameterSets, AreThoseOfTheFileInItsOrder) {
  const support::TemporaryFolder folder;
  folder.write("f.json", R"({"fileFormatVersion": "1", "parameterSets": {
      "z": {"b": "", "a": 1.50, "n": {"b": "no"}, "v": ["no", {"b": "no"}]},
      "five": 5, "": {}, "a": {"a": true, "b": "c\u0000d"}, "z": {"b": "2"}},
      "other": {"x": {"y": "z"}}})");
  const ParameterSets sets = ParameterSets::read(folder.file("f.json"));
  const auto values = [&](const auto& which) {
    std::string text;
    for (const ParameterValue& entry : sets.values_of(which)) {
      text += entry.name + "=" + entry.text + ";";
    }
    return text;
  };
  std::vector<std::string> names;
  for (std::size_t i = 0; i < sets.size(); ++i)
    names.push_back(sets.name_of(i));
  EXPECT_EQ(names, (std::vector<std::string>{"z", "five", "", "a", "z"}));
  EXPECT_EQ(values(std::size_t{0}), "b=;a=1.50;n=;v=;");
  EXPECT_THROW(values(std::size_t{1}), FileError);
  EXPECT_EQ(values(std::size_t{2}), "");
  EXPECT_EQ(values("a"), std::string("a=true;b=c\0d;", 13));
  EXPECT_EQ(values(std::size_t{4}), "b=2;");
  EXPECT_EQ(values("z"), values(std::size_t{0}));
}

// --- Rules of the customizer -------------------------------------------------

// `x = <own>; // <comment>` with the entry `"x": "<entry>"`, and the warning.
struct Kept {
  std::string value;
  std::string warning;
  bool operator==(const Kept&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Kept& kept) {
  return out << kept.value << " " << kept.warning;
}

Kept kept(const std::string& own, const std::string& comment,
          const std::string& entry, Language language = Language::k2026) {
  const Applied applied("x = " + own + "; // " + comment + "\n",
                        set_of("\"x\": \"" + entry + "\""), "s", language);
  const std::string ast = applied.ast();
  const std::size_t begin = ast.find("x = ") + 4;
  return {ast.substr(begin, ast.find(';') - begin), applied.message()};
}

TEST(ParameterRules, TakeWhatKeepsToThem) {
  EXPECT_EQ(kept("1", "[0:0.5:4]", "2.5"), (Kept{"2.5", ""}));
  EXPECT_EQ(kept("1", "[1, 2, 3]", "2"), (Kept{"2", ""}));
  EXPECT_EQ(kept("10", "[10:S, 20:M]", "20"), (Kept{"20", ""}));
  EXPECT_EQ(kept("\"S\"", "[S:Small, M:Medium]", "M"), (Kept{"\"M\"", ""}));
  EXPECT_EQ(kept("[1, 2]", "[9]", "[3, 9]"), (Kept{"[3, 9]", ""}));
  EXPECT_EQ(kept("true", "", "0"), (Kept{"false", ""}));
}

TEST(ParameterRules, MoveNumbersIntoTheirRangeIn2026) {
  const std::string said = "does not keep to [10 : 100]";
  EXPECT_EQ(kept("34", "[10:100]", "340"),
            (Kept{"100", "parameter x = 340 of the set " + said +
                             "; it is moved there"}));
  EXPECT_EQ(kept("34", "[10:100]", "340", Language::k2021),
            (Kept{"340", "parameter x = 340 of the set " + said}));
  // The design's own value is always good.
  EXPECT_EQ(kept("200", "[10:100]", "150"), (Kept{"150", ""}));
  EXPECT_EQ(kept("[12, 34]", "[1:50]", "[0, 60]").value, "[1, 50]");
}

TEST(ParameterRules, LeaveOutWhatIsNoChoiceIn2026) {
  const std::string said =
      "parameter x = S new of the set does not keep to "
      "[[\"S\", \"Small\"], [\"M\", \"Medium\"]]";
  EXPECT_EQ(kept("\"S\"", "[S:Small, M:Medium]", "S new"),
            (Kept{"\"S\"", said + "; it keeps its own value"}));
  EXPECT_EQ(kept("\"S\"", "[S:Small, M:Medium]", "S new", Language::k2021),
            (Kept{"\"S new\"", said}));
}

TEST(ParameterRules, CutTextsToTheirLengthIn2026) {
  EXPECT_EQ(kept("\"ab\"", "5", "abcdefg").value, "\"abcde\"");
  EXPECT_EQ(kept("\"ab\"", "3", "ab\u00e9").value, "\"ab\"");
}

TEST(ParameterRules, AreThoseOfShownParametersOnly) {
  const std::string design =
      "/* [ Hidden ] */\nx = 1;\n/* [Shown] */\ny = 1;\n"
      "module m() {}\nz = 1;\n";
  const std::string set = set_of(R"("x": "2", "y": "2", "z": "2")");
  const std::string of_2026 = Applied(design, set, "s", Language::k2026).ast();
  EXPECT_NE(of_2026.find("x = 1;"), std::string::npos);
  EXPECT_NE(of_2026.find("y = 2;"), std::string::npos);
  EXPECT_NE(of_2026.find("z = 1;"), std::string::npos);
  EXPECT_NE(Applied(design, set).ast().find("x = 2;"), std::string::npos);
}

}  // namespace
}  // namespace lamina
