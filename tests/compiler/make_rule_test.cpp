// The rule for make: what make itself reads in it.

#include "compiler/make_rule.h"

#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using compiler::make_rule;
using support::has;
using support::TemporaryFolder;

// All that make would be glad to take for something else.
const char* const kNames[] = {
    "$(shell touch pwned)x.stl",
    "${HOME}",
    "$@ $< $^",
    "two words",
    " first",
    "a#b",
    "a:b",
    "c:=b",
    "a=b",
    "CC=touch pwned",
    "a|b",
    "a%b",
    "a*b",
    "a?b",
    "a[b]",
    "a\\b",
    "a\\ b",
    "a\\\\ b",
    "a\\#b",
    "a\\:b",
    "a\\$b",
    "a\\=b",
    "a(b)c",
    "a&b",
    "'a'\"b\"`c`",
    "größe",
};

// What make understands the rule to say, of `target` and, in front of two
// files, `name`.
TEST(MakeRule, IsReadByMakeAsItIsMeant) {
  for (const std::string name : kNames) {
    const TemporaryFolder folder;
    const std::string first = folder.file("first");
    folder.write("first", "");
    folder.write(name, "");
    for (const std::vector<std::string>& files :
         {std::vector{first, folder.file(name)},
          std::vector{folder.file(name), first}}) {
      folder.write("rule", make_rule("out.slc", files) + "\t@touch done\n");
      const auto result =
          support::run_process({"make", "-rpn", "-f", "rule"}, folder.path());
      EXPECT_EQ(result.status, 0) << name << "\n" << result.errors;
      EXPECT_TRUE(has(result.output, folder.file(name))) << name;
      EXPECT_TRUE(has(result.output, "out.slc: " + files[0] + " " + files[1]) ||
                  has(result.output, "out.slc: " + files[1] + " " + files[0]))
          << name << "\n"
          << result.output;
      EXPECT_FALSE(std::filesystem::exists(folder.file("pwned"))) << name;
    }
  }
}

TEST(MakeRule, HasATargetOfAnyName) {
  for (const std::string target :
       {"$(shell touch pwned)x", "two words", "a#b", "a:b", "a=b", "a%b",
        "a\\ b", "a\\%b", "größe"}) {
    const TemporaryFolder folder;
    folder.write("a.scad", "");
    folder.write("rule", make_rule(target, std::vector<std::string>{"a.scad"}) +
                             "\t@touch done\n");
    const auto result =
        support::run_process({"make", "-f", "rule", target}, folder.path());
    EXPECT_EQ(result.status, 0) << target << "\n" << result.errors;
    EXPECT_TRUE(std::filesystem::exists(folder.file("done"))) << target;
    EXPECT_FALSE(std::filesystem::exists(folder.file("pwned"))) << target;
  }
}

// What make takes the name of a file and of a target for.
std::string understood(const std::string& name) {
  const TemporaryFolder folder;
  folder.write(name, "");
  folder.write("rule", make_rule("all", std::vector{name}) +
                           make_rule(name, {}) + "\t$(file >seen,$@)\n");
  const auto result =
      support::run_process({"make", "-BrRf", "rule"}, folder.path());
  if (!std::filesystem::exists(folder.file("seen"))) return result.errors;
  const std::string seen = support::read_file(folder.file("seen"));
  return seen.substr(0, seen.size() - 1);
}

TEST(MakeRule, SaysEveryNameOrRefusesIt) {
  std::string refused;
  for (char c = ' '; c < 0x7f; ++c) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/') continue;
    const std::string mark(1, c);
    for (const std::string& name :
         {mark + "root", "a" + mark, "a" + mark + "b", "a(" + mark,
          "a(b" + mark + "c", "a" + mark + "(b"}) {
      try {
        EXPECT_EQ(understood(name), name);
      } catch (const FileError&) {
        refused += name + "\n";
      }
    }
  }
  EXPECT_EQ(refused,
            "a \na( \na)\na()\n;root\na;\na;b\na(;\na(b;c\na;(b\na\\\na(\\\n"
            "~root\n");
}

TEST(MakeRule, RefusesWhatMakeCannotHold) {
  for (const std::string name : {"x\nall:\n\ttouch pwned\n.stl", "a\tb", "a\rb",
                                 "a\x7f", "a;touch pwned", "a\\;b", "a\\",
                                 "lib(member)", "member)", "~root", "a "}) {
    EXPECT_THROW(make_rule("out.slc", std::vector{name}), FileError) << name;
    EXPECT_THROW(make_rule(name, {}), FileError) << name;
  }
}

TEST(MakeRule, OfADesignHoldsNoCommands) {
  const TemporaryFolder folder;
  folder.write("a.scad", "import(\"$(shell touch pwned)x.stl\"); cube(1);");
  EXPECT_EQ(run(folder, {"a.scad", "-q", "-d", "a.d"}).status, 0);
  EXPECT_TRUE(has(support::read_file(folder.file("a.d")),
                  "/$$(shell\\ touch\\ pwned)x.stl"));
  support::run_process({"make", "-n", "-f", "a.d"}, folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.file("pwned")));
}

TEST(MakeRule, ThatCannotBeWrittenEndsTheRun) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "import(\"x\\nall:\\n\\ttouch pwned\\n.stl\"); cube(1);");
  const auto result = run(folder, {"a.scad", "-q", "-d", "a.d"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors,
                  "error: Can't write a rule for make (-d): it cannot hold the "
                  "name '"))
      << result.errors;
  EXPECT_TRUE(has(result.errors, "/x?all:??touch pwned?.stl'"))
      << result.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.d")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.slc")));
}

// To make it would mean that the output is made.
TEST(MakeRule, ComesWithTheOutputOrNotAtAll) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cylinder(r1 = 30, r2 = 20, h = 60, $fn = 500);");
  const auto late = run(folder, {"a.scad", "-q", "-d", "a.d", "--layer",
                                 "0.0001", "--max-time", "0.3"});
  EXPECT_EQ(late.status, 1) << late.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.d")));
  folder.write("flat.scad", "square(1); assert(false);");
  const auto failed = run(folder, {"flat.scad", "-q", "-d", "a.d"});
  EXPECT_EQ(failed.status, 1) << failed.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.d")));
}

}  // namespace
}  // namespace lamina::cli
