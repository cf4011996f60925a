#include "cli/process/landlock.h"

#include <cerrno>
#include <functional>
#include <iostream>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file/open_file.h"
#include "tests/support/temporary_folder.h"

namespace lamina::cli {
namespace {

// What `attempt` comes to in a process that may use the folder only: 0, or
// errno.
int try_confined(const std::string& folder,
                 const std::function<bool()>& attempt) {
  const pid_t child = ::fork();
  if (child == 0) {
    restrict_process(FileAccess::within({folder, {}, false}));
    errno = 0;
    ::_exit(attempt() ? 0 : errno);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status);
}

bool can_open(const std::string& path, int flags) {
  return static_cast<bool>(OpenFile(::open(path.c_str(), flags, 0666)));
}

TEST(Landlock, LeavesNothingButTheRoot) {
  const support::TemporaryFolder root;
  const support::TemporaryFolder beyond;
  const std::string mine = root.write("f", "mine");
  const std::string other = beyond.write("f", "secret");
  const long version = landlock_version();
  if (version < 1) {
    std::cout << "This kernel has no Landlock: the second line is missing, and "
                 "nothing else may change by that.\n";
  }
  const int refused = version < 1 ? 0 : EACCES;
  const auto attempt = [&](const std::function<bool()>& work) {
    return try_confined(root.path(), work);
  };
  EXPECT_EQ(attempt([&] { return can_open(mine, O_RDWR); }), 0);
  EXPECT_EQ(attempt([&] { return ::truncate(mine.c_str(), 2) == 0; }), 0);
  EXPECT_EQ(attempt([&] { return can_open(root.file("n"), O_CREAT | O_RDWR); }),
            0);
  EXPECT_EQ(attempt([&] { return can_open(other, O_RDONLY); }), refused);
  EXPECT_EQ(attempt([&] { return can_open(other, O_WRONLY); }), refused);
  EXPECT_EQ(
      attempt([&] { return can_open(beyond.file("n"), O_CREAT | O_RDWR); }),
      refused);
  EXPECT_EQ(attempt([&] { return can_open(beyond.path(), O_DIRECTORY); }),
            refused);
  // Before version 3 it has no word for this.
  EXPECT_EQ(attempt([&] { return ::truncate(other.c_str(), 2) == 0; }),
            version < 3 ? 0 : EACCES);
}

}  // namespace
}  // namespace lamina::cli
