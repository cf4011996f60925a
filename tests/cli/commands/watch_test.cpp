// Outputs that are made anew when the design changes.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <signal.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

// A run of `a.scad --watch`.
class Watched {
 public:
  Watched(const TemporaryFolder& folder, const std::string& output,
          std::vector<std::string> more = {})
      : path_(folder.file(output)),
        process_(words(output, std::move(more)), folder.path(),
                 streams_.write("errors", "")) {}
  ~Watched() { stop(); }

  // Waits until the output is this text.
  bool comes_to(const std::string& text) const {
    if (support::wait_until([&] { return output() == text; })) return true;
    ADD_FAILURE() << "it stays '" << output() << "'";
    return false;
  }

  // Waits until messages have these words.
  bool comes_to_say(const std::string& words) const {
    return support::wait_until([&] {
      return support::read_file(streams_.file("errors")).find(words) !=
             std::string::npos;
    });
  }

  std::string output() const {
    return std::filesystem::exists(path_) ? support::read_file(path_) : "";
  }

  int stop() {
    if (!is_stopped_) {
      process_.send(SIGINT);
      status_ = process_.wait();
    }
    is_stopped_ = true;
    return status_;
  }

 private:
  static std::vector<std::string> words(const std::string& output,
                                        std::vector<std::string> more) {
    more.insert(more.begin(), {"a.scad", "-o", output, "--watch"});
    return command(std::move(more));
  }

  TemporaryFolder streams_;
  std::string path_;
  support::BackgroundProcess process_;
  bool is_stopped_ = false;
  int status_ = 0;
};

TEST(Watch, FollowsEveryWayToSaveADesign) {
  const TemporaryFolder folder;
  folder.write("a.scad", "echo(1);");
  Watched watched(folder, "a.echo");
  ASSERT_TRUE(watched.comes_to("ECHO: 1\n"));
  EXPECT_TRUE(watched.comes_to_say("watching 1 file; Ctrl-C ends\n"));
  folder.write("a.scad", "echo(2);");
  ASSERT_TRUE(watched.comes_to("ECHO: 2\n"));
  folder.write("other", "echo(3);");
  std::filesystem::rename(folder.file("other"), folder.file("a.scad"));
  ASSERT_TRUE(watched.comes_to("ECHO: 3\n"));
  std::filesystem::remove(folder.file("a.scad"));
  folder.write("a.scad", "echo(4);");
  ASSERT_TRUE(watched.comes_to("ECHO: 4\n"));
  EXPECT_EQ(watched.stop(), 130);
  EXPECT_EQ(folder.entry_count(), 2U);
}

TEST(Watch, FollowsAllThatTheDesignDependsOn) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("lib"));
  folder.write("lib/u.scad", "function f() = 1;");
  folder.write("i.scad", "i = 1;");
  folder.write("s.json", R"({"parameterSets": {"s": {"p": "1"}}})");
  folder.write("d.json", "[1]");
  folder.write("a.scad",
               "use <lib/u.scad>\ninclude <i.scad>\np = 0;\n"
               "echo(f(), i, p, import(\"d.json\"));");
  Watched watched(folder, "a.echo", {"-p", "s.json", "-P", "s"});
  ASSERT_TRUE(watched.comes_to("ECHO: 1, 1, 1, [1]\n"));
  folder.write("lib/u.scad", "function f() = 2;");
  ASSERT_TRUE(watched.comes_to("ECHO: 2, 1, 1, [1]\n"));
  folder.write("i.scad", "i = 2;");
  ASSERT_TRUE(watched.comes_to("ECHO: 2, 2, 1, [1]\n"));
  folder.write("s.json", R"({"parameterSets": {"s": {"p": "2"}}})");
  ASSERT_TRUE(watched.comes_to("ECHO: 2, 2, 2, [1]\n"));
  folder.write("d.json", "[2]");
  ASSERT_TRUE(watched.comes_to("ECHO: 2, 2, 2, [2]\n"));
}

TEST(Watch, FollowsWhatIsMissingAtFirst) {
  const TemporaryFolder folder;
  folder.write("a.scad", "include <i.scad>\nuse <u.scad>\necho(i, f());");
  Watched watched(folder, "a.echo");
  ASSERT_TRUE(watched.comes_to_say("Can't open include file 'i.scad'"));
  folder.write("i.scad", "i = 1;");
  folder.write("u.scad", "function f() = 2;");
  ASSERT_TRUE(watched.comes_to("ECHO: 1, 2\n"));
}

TEST(Watch, KeepsTheOutputWhereTheDesignFails) {
  const TemporaryFolder folder;
  folder.write("i.scad", "i = 1;");
  folder.write("a.scad", "include <i.scad>\ncube(i);");
  Watched watched(folder, "a.csg");
  const std::string one = "cube(size = [1, 1, 1], center = false);\n\n";
  ASSERT_TRUE(watched.comes_to(one));
  folder.write("a.scad", "cube(2;");
  ASSERT_TRUE(watched.comes_to_say("error: "));
  EXPECT_EQ(watched.output(), one);
  // What the design depended on when it was good is still watched.
  folder.write("i.scad", "i = 3;");
  folder.write("a.scad", "include <i.scad>\ncube(i);");
  ASSERT_TRUE(watched.comes_to("cube(size = [3, 3, 3], center = false);\n\n"));
}

// What an earlier save has tried to read is no input of a later one.
TEST(Watch, WritesAgainAfterASaveThatReadsTheOutput) {
  const TemporaryFolder folder;
  folder.write("a.scad", "echo(1);");
  Watched watched(folder, "a.json", {"--export-format", "echo"});
  ASSERT_TRUE(watched.comes_to("ECHO: 1\n"));
  folder.write("a.scad", "echo(import(\"a.json\"));");
  ASSERT_TRUE(watched.comes_to_say("this run reads it, too"));
  folder.write("a.scad", "echo(3);");
  ASSERT_TRUE(watched.comes_to("ECHO: 3\n"));
}

// Nor is an output that was moved away one any more.
TEST(Watch, ReadsWhatWasTheOutputUnderAnotherName) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  const std::string one = "cube(size = [1, 1, 1], center = false);\n";
  const std::string two = "cube(size = [2, 2, 2], center = false);\n";
  Watched watched(folder, "a.csg");
  ASSERT_TRUE(watched.comes_to(one + "\n"));
  std::filesystem::rename(folder.file("a.csg"), folder.file("old.csg"));
  folder.write("a.scad", "include <old.csg>\ncube(2);");
  ASSERT_TRUE(watched.comes_to(one + two + "\n"));
  // The new one still is.
  folder.write("a.scad", "include <a.csg>\ncube(3);");
  ASSERT_TRUE(watched.comes_to_say("this run reads it, too"));
}

// What changed may have any name.
TEST(Watch, NamesAreNoLines) {
  const TemporaryFolder folder;
  folder.write("b\nerror: forged.json", "1");
  folder.write("a.scad", "echo(import(\"b\\nerror: forged.json\"));");
  Watched watched(folder, "a.echo");
  ASSERT_TRUE(watched.comes_to("ECHO: 1\n"));
  folder.write("b\nerror: forged.json", "2");
  ASSERT_TRUE(watched.comes_to("ECHO: 2\n"));
  EXPECT_TRUE(watched.comes_to_say(" b\\u000Aerror: forged.json changed\n"));
}

TEST(Watch, IsForOneDesignAndAFile) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  EXPECT_EQ(run(folder, {"a.scad", "a.scad", "--watch"}).status, 2);
  EXPECT_EQ(
      run(folder, {"a.scad", "-o", "-", "--export-format", "slc", "--watch"})
          .status,
      2);
}

}  // namespace
}  // namespace lamina::cli
