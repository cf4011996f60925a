// Tests the cache of answers with programs that stand in for openscad.

#include "tests/support/openscad_cache.h"

#include <filesystem>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::support {
namespace {

namespace fs = std::filesystem;

// Called as: prlimit … openscad -o OUTPUT DESIGN. Counts the calls in the
// folder of the design.
constexpr const char* kSlowProgram = R"(#!/bin/sh
[ "$1" = --version ] && exit 0
mktemp "$3.call.XXXXXX" >&2
printf 'one half, ' > "$2"
sleep 0.2
printf 'the other' >> "$2"
)";

class OpenScadCache : public testing::Test {
 protected:
  OpenScadCache() {
    ::setenv("LAMINA_TEST_CACHE", folder_.file("cache").c_str(), 1);
    ::setenv("PATH", (folder_.path() + ":" + path_).c_str(), 1);
  }
  ~OpenScadCache() override { ::setenv("PATH", path_.c_str(), 1); }

  void install(const std::string& script) {
    fs::permissions(folder_.write("openscad", script), fs::perms::owner_all);
  }

  // The messages and the output.
  std::string ask() {
    const OpenScadResult result = ask_openscad(design_, "echo");
    return result.output.empty() ? "nothing"
                                 : read_file(result.output.string());
  }

  std::ptrdiff_t calls() const {
    std::ptrdiff_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      count += entry.path().filename().string().starts_with("a.scad.call");
    }
    return count;
  }

  std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(cache_folder()), {});
  }

  const std::string path_ = ::getenv("PATH");
  TemporaryFolder folder_;
  const std::string design_ = folder_.write("a.scad", "cube(1);");
};

TEST_F(OpenScadCache, AsksOnceForEachText) {
  install(kSlowProgram);
  EXPECT_EQ(ask(), "one half, the other");
  EXPECT_EQ(ask(), "one half, the other");
  EXPECT_EQ(calls(), 1);
  folder_.write("a.scad", "cube(2);");
  EXPECT_EQ(ask(), "one half, the other");
  EXPECT_EQ(calls(), 2);
}

TEST_F(OpenScadCache, GivesWholeAnswersToAllWhoAskAtOnce) {
  install(kSlowProgram);
  std::vector<std::future<std::string>> askers;
  for (int i = 0; i < 8; ++i) {
    askers.push_back(std::async(std::launch::async, [&] { return ask(); }));
  }
  for (auto& asker : askers) EXPECT_EQ(asker.get(), "one half, the other");
  EXPECT_EQ(entries(), 1);
}

TEST_F(OpenScadCache, KeepsThatADesignMakesNothing) {
  install("#!/bin/sh\n[ $1 = --version ] || { echo empty >&2; exit 1; }\n");
  for (int i = 0; i < 2; ++i) {
    const OpenScadResult result = ask_openscad(design_, "stl");
    EXPECT_EQ(result.words, "empty\n");
    EXPECT_TRUE(result.output.empty());
  }
  EXPECT_EQ(entries(), 1);
}

TEST_F(OpenScadCache, KeepsNothingOfAProgramThatCrashesOrIsKilled) {
  for (const char* const signal : {"SEGV", "ABRT", "KILL", "XCPU", "TERM"}) {
    install(std::string("#!/bin/sh\n[ $1 = --version ] && exit 0\n") +
            "echo half > $2; echo bad luck >&2; kill -" + signal + " $$\n");
    try {
      ask();
      ADD_FAILURE() << signal << " went unnoticed";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("bad luck"), std::string::npos)
          << error.what();
    }
    EXPECT_EQ(entries(), 0) << signal;
  }
  install(kSlowProgram);
  EXPECT_EQ(ask(), "one half, the other");
}

TEST_F(OpenScadCache, FailsWhereTheProgramIsMissing) {
  ::setenv("PATH", folder_.path().c_str(), 1);
  EXPECT_THROW(ask(), std::runtime_error);
}

}  // namespace
}  // namespace lamina::support
