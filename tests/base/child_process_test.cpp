#include "base/child_process.h"

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace lamina {
namespace {

constexpr unsigned kMostSeconds = 20;

TEST(ChildProcess, GivesBackWhatItsWorkWrites) {
  std::string text(1 << 20, 'a');
  text.back() = 'z';
  ChildProcess child(
      [&](const ChildOutput& output) {
        output.write(text.data(), text.size());
      },
      kMostSeconds);
  std::string read(text.size(), ' ');
  EXPECT_TRUE(child.read(read.data(), read.size()));
  EXPECT_EQ(read, text);
  EXPECT_FALSE(child.read(read.data(), 1));
  EXPECT_EQ(child.wait(), ChildFault::kNone);
}

TEST(ChildProcess, TellsHowItEnded) {
  ChildProcess crash([](const ChildOutput&) { std::raise(SIGSEGV); },
                     kMostSeconds);
  EXPECT_EQ(crash.wait(), ChildFault::kCrashed);
  ChildProcess killed([](const ChildOutput&) { std::raise(SIGKILL); },
                      kMostSeconds);
  EXPECT_EQ(killed.wait(), ChildFault::kKilled);
  ChildProcess endless(
      [](const ChildOutput&) {
        while (::getppid() != 0) {
        }
      },
      1);
  EXPECT_EQ(endless.wait(), ChildFault::kOutOfTime);
}

TEST(ChildProcess, HasNoStreams) {
  testing::internal::CaptureStdout();
  ChildProcess child(
      [](const ChildOutput& output) {
        const char text[] = "heard";
        const bool is_open = ::write(STDOUT_FILENO, text, sizeof text) > 0 ||
                             ::read(STDIN_FILENO, nullptr, 0) > 0;
        output.write(&is_open, sizeof is_open);
      },
      kMostSeconds);
  bool is_open = true;
  EXPECT_TRUE(child.read(&is_open, sizeof is_open));
  EXPECT_FALSE(is_open);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(ChildProcess, HasItsMemoryCounted) {
  constexpr std::size_t kSize = std::size_t{100} << 20;
  EXPECT_EQ(memory_of_children(), 0U);
  {
    ChildProcess child(
        [](const ChildOutput&) {
          std::vector<char> bytes(kSize, 'a');
          while (bytes.back() == 'a') ::pause();
        },
        kMostSeconds);
    for (int i = 0; i < 2000 && memory_of_children() < kSize; ++i) {
      ::usleep(10000);
    }
    EXPECT_GE(memory_of_children(), kSize);
    EXPECT_LT(memory_of_children(), kSize + kSize / 4);
  }
  EXPECT_EQ(memory_of_children(), 0U);
}

}  // namespace
}  // namespace lamina
