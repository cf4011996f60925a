// The line that shows how far a long run is.

#include "cli/process/progress.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

TEST(ProgressText, TellsWhatIsDoneHowFastAndHowLongItTakesYet) {
  EXPECT_EQ(progress_text({1000, 4000, "layers", 2}, 60),
            "[=====>               ] 1000 of 4000 layers, 500/s, 6 s left");
  EXPECT_EQ(progress_text({7, 200, "pieces", 2}, 40),
            "  7 of 200 pieces, 3.5/s, 56 s left");
  EXPECT_EQ(progress_text({2, 66, "layers", 2}, 45),
            " 2 of 66 layers, 1.0/s, 1 min 04 s left");
}

TEST(ProgressText, PromisesNothingBeforeThreePercent) {
  EXPECT_EQ(progress_text({29, 1000, "layers", 2}, 25), "  29 of 1000 layers");
  EXPECT_EQ(progress_text({30, 1000, "layers", 2}, 45),
            "  30 of 1000 layers, 15/s, 1 min 05 s left");
}

TEST(ProgressText, NeedsNoMoreThanItsWidth) {
  for (std::size_t width = 0; width < 120; ++width) {
    EXPECT_LE(progress_text({1000, 4000, "layers", 2}, width).size(), width);
    EXPECT_LE(progress_text({0, 4000, "layers", 0}, width).size(), width);
  }
}

TEST(ProgressText, KnowsNoRateBeforeTheFirstIsDone) {
  EXPECT_EQ(progress_text({0, 9, "layers", 3}, 20), "0 of 9 layers");
}

// Some seconds of work.
std::vector<std::string> long_run(const TemporaryFolder& folder) {
  folder.write("a.scad", "cylinder(r1 = 30, r2 = 20, h = 60, $fn = 500);");
  return command({"a.scad", "--layer", "0.0005", "--threads", "1"});
}

// What stands on the last line of a terminal in the end.
std::string last_line(const std::string& shown) {
  std::string line;
  std::size_t column = 0;
  for (const char c : shown) {
    if (c == '\n') line.clear();
    if (c == '\n' || c == '\r') {
      column = 0;
      continue;
    }
    line.resize(std::max(line.size(), column + 1), ' ');
    line[column++] = c;
  }
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

class Progress : public testing::Test {
 protected:
  void SetUp() override {
    if (!support::has_terminals()) GTEST_SKIP() << "no terminals here";
  }
};

TEST_F(Progress, IsShownOnATerminalAndErasedAtTheEnd) {
  const TemporaryFolder folder;
  const auto result = support::run_on_terminal(long_run(folder), folder.path());
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.output.find(" of 120000 layers, "), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find(" s left"), std::string::npos);
  const std::size_t end =
      result.output.rfind('\r', result.output.find("a.slc:"));
  EXPECT_EQ(result.output.substr(end, 7), "\ra.slc:");
  EXPECT_EQ(last_line(result.output), "");
}

TEST_F(Progress, SaysWhatIsDoneBeforeTheFirstLayer) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "for (i = [0 : 9e5]) let (x = i) if (x < 0) cube(1);"
               "cube(1);");
  const auto result =
      support::run_on_terminal(command({"a.scad"}), folder.path());
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.output.find("\revaluating ..."), std::string::npos)
      << result.output;
  EXPECT_EQ(last_line(result.output), "");
}

TEST_F(Progress, IsNotForPipesQuietRunsAndShortOnes) {
  const TemporaryFolder folder;
  std::vector<std::string> words = long_run(folder);
  EXPECT_EQ(support::run_process(words, folder.path()).errors.find('\r'),
            std::string::npos);
  words.emplace_back("-q");
  EXPECT_EQ(support::run_on_terminal(words, folder.path()).output, "");
  folder.write("b.scad", "cube(1);");
  const auto small =
      support::run_on_terminal(command({"b.scad"}), folder.path());
  EXPECT_EQ(small.output.find("left"), std::string::npos);
}

TEST_F(Progress, MessagesHaveColoursOnATerminalOnly) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);\nx = y;\ncube(;\n");
  const std::vector<std::string> plain = command({"a.scad"});
  std::vector<std::string> words = {"env", "TERM=xterm"};
  words.insert(words.end(), plain.begin(), plain.end());
  const auto shown = support::run_on_terminal(words, folder.path());
  EXPECT_NE(shown.output.find("a.scad:3:6: \x1b[1;31merror:\x1b[m Parser"),
            std::string::npos)
      << shown.output;
  words.insert(words.begin() + 1, "NO_COLOR=1");
  EXPECT_EQ(support::run_on_terminal(words, folder.path()).output.find('\x1b'),
            std::string::npos);
  EXPECT_EQ(support::run_process(plain, folder.path()).errors.find('\x1b'),
            std::string::npos);
}

TEST_F(Progress, LeavesNothingBehindAnInterrupt) {
  const TemporaryFolder folder;
  const auto result = support::run_on_terminal(long_run(folder), folder.path(),
                                               " of 120000 layers");
  EXPECT_EQ(result.status, 130);
  EXPECT_EQ(last_line(result.output), "");
  EXPECT_EQ(folder.entry_count(), 1U);  // the design
}

// As by Ctrl-S: who writes to it waits.
TEST_F(Progress, OnAStoppedTerminalKeepsNoRunAlive) {
  int terminal = -1;
  int other_end = -1;
  char name[256];
  ASSERT_EQ(::openpty(&terminal, &other_end, name, nullptr, nullptr), 0);
  ASSERT_EQ(::tcflow(other_end, TCOOFF), 0);
  const TemporaryFolder folder;
  std::string line =
      "exec timeout --foreground --preserve-status -s TERM "
      "-k 20 1.5";
  for (const std::string& word : long_run(folder)) line += " " + word;
  const auto result =
      support::run_process({"bash", "-c", line + " 2> " + name}, folder.path());
  ::close(terminal);
  ::close(other_end);
  EXPECT_EQ(result.status, 130);
  EXPECT_EQ(folder.entry_count(), 1U);  // the design
}

}  // namespace
}  // namespace lamina::cli
