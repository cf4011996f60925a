#include "base/child_process.h"

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/diagnostic.h"

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

TEST(ChildProcess, ItsTimeCountsWhenItHasEnded) {
  const double before = seconds_of_children();
  const double before_of_thread = thread_seconds_of_children();
  ChildProcess endless(
      [](const ChildOutput&) {
        while (::getppid() != 0) {
        }
      },
      1);
  EXPECT_EQ(endless.wait(), ChildFault::kOutOfTime);
  EXPECT_GT(seconds_of_children() - before, 0.5);
  EXPECT_GT(thread_seconds_of_children() - before_of_thread, 0.5);
}

// A shell's `ulimit -t` sets both limits; at the hard one the system kills.
TEST(ChildProcess, IsOutOfTimeAtAHardLimit) {
  ChildProcess endless(
      [](const ChildOutput&) {
        const rlimit both{1, 1};
        ::setrlimit(RLIMIT_CPU, &both);
        while (::getppid() != 0) {
        }
      },
      1);
  EXPECT_EQ(endless.wait(), ChildFault::kOutOfTime);
}

// Even where a library hides it.
TEST(ChildProcess, EndsWhereItsMemoryDoes) {
  ChildProcess child(
      [](const ChildOutput&) {
        try {
          ::operator delete(::operator new (std::size_t{1} << 60));
        } catch (const std::bad_alloc&) {
        }
      },
      kMostSeconds);
  EXPECT_EQ(child.wait(), ChildFault::kOutOfMemory);
}

// Lowers what this process may take while it lives.
class Limit {
 public:
  Limit(__rlimit_resource_t resource, rlim_t value) : resource_(resource) {
    ::getrlimit(resource, &before_);
    const rlimit now{value, before_.rlim_max};
    ::setrlimit(resource, &now);
  }
  ~Limit() { ::setrlimit(resource_, &before_); }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;

 private:
  __rlimit_resource_t resource_;
  rlimit before_{};
};

TEST(ChildProcess, HasNoMoreTimeThanItsParent) {
  constexpr unsigned kLess = 5000;
  const Limit limit(RLIMIT_CPU, kLess);
  ChildProcess child(
      [](const ChildOutput& output) {
        rlimit now{};
        ::getrlimit(RLIMIT_CPU, &now);
        output.write(&now.rlim_cur, sizeof now.rlim_cur);
      },
      2 * kLess);
  rlim_t seconds = 0;
  EXPECT_TRUE(child.read(&seconds, sizeof seconds));
  EXPECT_EQ(seconds, kLess);
  EXPECT_EQ(child.most_seconds(), kLess);
}

// And leaves other children of its program alone.
TEST(ChildProcess, SaysThatTheSystemGrantsNone) {
  const pid_t other = ::fork();
  if (other == 0) ::_exit(7);
  {
    const Limit limit(RLIMIT_NOFILE, 1);
    try {
      const ChildProcess child([](const ChildOutput&) {}, kMostSeconds);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.diagnostic().message,
                "the system grants no further process, or no pipe to it "
                "(ulimit -u, -n): Too many open files");
    }
  }
  EXPECT_EQ(memory_of_children(), 0U);
  int status = 0;
  EXPECT_EQ(::waitpid(other, &status, 0), other);
  EXPECT_EQ(WEXITSTATUS(status), 7);
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
