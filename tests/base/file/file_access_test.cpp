#include "base/file/file_access.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

namespace fs = std::filesystem;

class ConfinedAccess : public testing::Test {
 protected:
  ConfinedAccess() {
    for (const char* name : {"root", "root/sub", "more", "beyond"}) {
      fs::create_directory(all_.file(name));
    }
    all_.write("root/in", "mine");
    all_.write("root/sub/in", "below");
    all_.write("more/in", "more");
    all_.write("beyond/out", "secret");
  }

  FileAccess access() const {
    return FileAccess::within({all_.file("root"), {all_.file("more")}, false});
  }
  void link(const std::string& target, const std::string& name) const {
    fs::create_symlink(target, all_.file(name));
  }
  // What is read there; "outside", or the error.
  std::string read(const std::string& path) const {
    const FileAccess files = access();
    if (!files.allows(path)) {
      EXPECT_FALSE(files.read(path)) << path;
      EXPECT_FALSE(files.is_there(path)) << path;
      return "outside";
    }
    const auto text = files.read(path);
    return text ? *text : std::strerror(errno);
  }

  support::TemporaryFolder all_;
};

TEST_F(ConfinedAccess, FollowsLinksInsideAndNoOthers) {
  link("in", "root/relative");
  link(all_.file("root/in"), "root/absolute");
  link("../in", "root/sub/up");
  link("sub", "root/folder");
  link("../more/in", "root/to-more");
  link("../beyond/out", "root/out");
  link("../beyond", "root/away");
  link("/", "root/top");
  link("loop", "root/loop");
  link("none", "root/dangling");
  const std::string missing = std::strerror(ENOENT);
  const std::pair<const char*, std::string> expected[] = {
      {"root/in", "mine"},
      {"root/./sub/../in", "mine"},
      {"root//sub//in", "below"},
      {"root/relative", "mine"},
      {"root/absolute", "mine"},
      {"root/sub/up", "mine"},
      {"root/folder/in", "below"},
      {"root/folder/up", "mine"},
      {"root/folder/../in", "mine"},
      {"root/to-more", "more"},
      {"root/../more/in", "more"},
      {"root/../root/in", "mine"},
      {"root/out", "outside"},
      {"root/away/out", "outside"},
      {"root/away/none", "outside"},
      {"root/away/../root/in", "mine"},
      {"root/../beyond/out", "outside"},
      {"root/../beyond/none", "outside"},
      {"root/../../../../../../../../etc/passwd", "outside"},
      {"root/top/etc/passwd", "outside"},
      {"beyond/out", "outside"},
      {"beyond", "outside"},
      {"root/none", missing},
      {"root/none/../../beyond/out", missing},
      {"root/dangling", missing},
      {"root/loop", std::strerror(ELOOP)},
      {"root/in/", std::strerror(ENOTDIR)},
      {"root/in/..", std::strerror(ENOTDIR)},
      {"root/in/../in", std::strerror(ENOTDIR)},
  };
  for (const auto& [path, text] : expected) {
    EXPECT_EQ(read(all_.file(path)), text) << path;
  }
  EXPECT_EQ(read("/etc/passwd"), "outside");
  EXPECT_EQ(read("/"), "outside");
  EXPECT_EQ(read("/dev/null"), "outside");
  EXPECT_EQ(read("/proc/self/environ"), "outside");
}

// The kernel takes "..\\0" for "..".
TEST_F(ConfinedAccess, ANameWithANulLeadsNowhere) {
  using namespace std::string_literals;
  link("in", "root/link");
  for (const std::string& path :
       {"root/link\0"s, "root/..\0/beyond/out"s,
        "root/sub/..\0/..\0/beyond/out"s, "root/..\0x/beyond/none"s,
        "beyond\0/out"s, "root/in\0.scad"s, "root\0/in"s, "root/in\0"s,
        "\0"s}) {
    const std::string file = all_.file(path);
    for (const FileAccess& files : {access(), FileAccess()}) {
      errno = 0;
      EXPECT_FALSE(files.read(file));
      EXPECT_EQ(errno, ENOENT);
      EXPECT_FALSE(files.read_regular(file));
      EXPECT_FALSE(files.open(file));
      EXPECT_FALSE(files.look_at(file));
      EXPECT_FALSE(files.is_link(file));
      EXPECT_EQ(files.canonical(file), "");
      EXPECT_EQ(files.find_output(file).error, ENOENT);
    }
  }
  for (const FileAccess& files : {access(), FileAccess()}) {
    EXPECT_FALSE(files.list(all_.file("root/sub\0"s)));
    EXPECT_FALSE(files.list(all_.file("root/..\0"s)));
    files.make_folders(all_.file("root/new\0/a"s));
    EXPECT_FALSE(files.is_there(all_.file("root/new")));
    files.make_folders(all_.file("root/..\0/new"s));
    EXPECT_FALSE(fs::exists(all_.file("new")));
  }
}

TEST_F(ConfinedAccess, AWholeFileSystemIsAFolder) {
  const FileAccess files = FileAccess::within({"/", {}, false});
  EXPECT_EQ(
      files.read(all_.file("root/../../../../../../" + all_.file("root/in")))
          .value_or(""),
      "mine");
  EXPECT_EQ(files.read(all_.file("root/sub/../in")).value_or(""), "mine");
  EXPECT_FALSE(files.open("/dev/null"));
  EXPECT_FALSE(files.open("/proc/self/environ"));
  EXPECT_FALSE(files.read("/proc/self/environ"));
  EXPECT_FALSE(files.read("/sys/devices/system/cpu/online"));
  EXPECT_TRUE(FileAccess().read("/proc/self/environ"));
}

// A file of sysfs claims a whole page and has a line: as one that is shortened
// while it is read.
TEST(FreeAccess, AFileThatIsShorterThanItWasIsAnError) {
  EXPECT_THROW(FileAccess().read("/sys/devices/system/cpu/online"), FileError);
}

// Lowers the number of descriptors.
class NoDescriptors {
 public:
  explicit NoDescriptors(rlim_t limit) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit lower{limit, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &lower);
  }
  ~NoDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

// Whatever is asked, there is the right answer or an error: never one that
// reads like a missing file.
TEST_F(ConfinedAccess, DescriptorsThatEndAreAnError) {
  fs::create_directory(all_.file("root/sub/deep"));
  all_.write("root/sub/deep/in", "deep");
  link("sub/deep", "root/folder");
  const FileAccess files = access();
  const std::string file = all_.file("root/folder/in");
  const std::string top = all_.file("root/in");
  const std::string folder = all_.file("root/sub");
  int failures = 0;
  const auto expect = [&](rlim_t limit, const auto& is_right) {
    try {
      // Ends before the error is looked at: sanitizers need descriptors, too.
      const NoDescriptors few(limit);
      EXPECT_TRUE(is_right()) << limit;
    } catch (const FileError& error) {
      ++failures;
      EXPECT_NE(std::string(error.what()).find(std::strerror(EMFILE)),
                std::string::npos)
          << error.what();
    }
  };
  for (rlim_t limit = 1; limit < 40; ++limit) {
    expect(limit, [&] { return files.read(file) == "deep"; });
    expect(limit, [&] { return files.read(top) == "mine"; });
    expect(limit, [&] { return files.is_file(file); });
    expect(limit, [&] { return files.is_there(all_.file("root")); });
    expect(limit, [&] { return files.allows(file); });
    expect(limit, [&] { return !files.canonical(file).empty(); });
    expect(limit, [&] { return !files.weakly_canonical(file).empty(); });
    expect(limit, [&] { return files.list(folder).has_value(); });
    expect(limit, [&] { return FileAccess().list(folder).has_value(); });
    expect(limit, [&] { return FileAccess().read(top) == "mine"; });
  }
  EXPECT_GT(failures, 0);
}

TEST_F(ConfinedAccess, WritesInTheRootOnly) {
  link("../more", "root/to-more");
  link("../beyond/new", "root/new");
  const FileAccess files = access();
  EXPECT_EQ(files.find_output(all_.file("root/a")).error, 0);
  EXPECT_EQ(files.find_output(all_.file("root/none/a")).error, ENOENT);
  EXPECT_EQ(files.find_output(all_.file("root")).error, EISDIR);
  for (const char* path : {"more/a", "beyond/a", "root/to-more/a", "root/new",
                           "root/../beyond/a", "root/../a"}) {
    EXPECT_THROW(files.find_output(all_.file(path)), AccessError) << path;
  }
}

TEST_F(ConfinedAccess, PathsLoseTheirLinks) {
  link("sub", "root/folder");
  const FileAccess files = access();
  EXPECT_EQ(files.canonical(all_.file("root/folder/in")),
            fs::canonical(all_.file("root/sub/in")));
  EXPECT_EQ(files.canonical(all_.file("root/none")), "");
  EXPECT_EQ(files.canonical(all_.file("beyond/out")), "");
  EXPECT_EQ(files.weakly_canonical(all_.file("root/folder/none/x/../y")),
            fs::weakly_canonical(all_.file("root/sub/none/y")));
}

// Whatever stands there at any moment, what is read is of the root.
TEST_F(ConfinedAccess, ASwapBetweenLookingAndOpeningGainsNothing) {
  constexpr int kAttempts = 20000;
  fs::create_directory(all_.file("root/a"));
  all_.write("root/a/f", "mine");
  all_.write("beyond/f", "secret");
  link(all_.file("beyond"), "root/b");
  std::atomic<bool> is_done = false;
  std::thread swapper([&] {
    while (!is_done) {
      ::renameat2(AT_FDCWD, all_.file("root/a").c_str(), AT_FDCWD,
                  all_.file("root/b").c_str(), RENAME_EXCHANGE);
    }
  });
  const FileAccess files = access();
  const std::string path = all_.file("root/a/f");
  int read = 0;
  for (int i = 0; i < kAttempts; ++i) {
    const auto text = files.read(path);
    if (!text) continue;
    ++read;
    ASSERT_EQ(*text, "mine");
  }
  is_done = true;
  swapper.join();
  EXPECT_GT(read, 0);
  EXPECT_LT(read, kAttempts);
}

}  // namespace
}  // namespace lamina
