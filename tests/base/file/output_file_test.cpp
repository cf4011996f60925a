#include "base/file/output_file.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {
namespace {

using support::read_file;
using support::TemporaryFolder;

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  OutputFile output = OutputFile::open(folder.file("a"), files);
  output.write("hello");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a")));
  output.commit();
  EXPECT_EQ(read_file(folder.file("a")), "hello");
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(OutputFile, LeavesNothingBehindWithoutCommit) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  { OutputFile::open(folder.file("a"), files).write("hello"); }
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(OutputFile, KeepsTheOldFileWithoutCommit) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  folder.write("a", "old");
  { OutputFile::open(folder.file("a"), files).write("new"); }
  EXPECT_EQ(read_file(folder.file("a")), "old");
}

TEST(OutputFile, PatchesWhatWasWrittenBeforeAcrossItsBuffer) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  OutputFile output = OutputFile::open(folder.file("a"), files);
  const std::string large(3'000'000, 'x');
  output.write(large);
  output.patch(1, "yy");
  output.write("end");
  EXPECT_EQ(output.size(), 3'000'003U);
  output.commit();
  std::string expected = large + "end";
  expected[1] = expected[2] = 'y';
  EXPECT_EQ(read_file(folder.file("a")), expected);
}

TEST(OutputFile, InsertsBetweenWhatWasWrittenBefore) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  std::string expected;
  for (int i = 0; i < 200'000; ++i) expected += std::to_string(i);
  OutputFile output = OutputFile::open(folder.file("a"), files);
  output.write(expected);
  const std::string piece(1000, '-');
  output.insert(7, piece);
  output.insert(output.size(), "behind");
  output.write("end");
  expected.insert(7, piece);
  expected += "behindend";
  EXPECT_EQ(output.size(), expected.size());
  output.commit();
  EXPECT_EQ(read_file(folder.file("a")), expected);
}

TEST(OutputFile, WritesThroughASymbolicLink) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  folder.write("target", "old");
  std::filesystem::create_symlink(folder.file("target"), folder.file("link"));
  OutputFile output = OutputFile::open(folder.file("link"), files);
  output.write("new");
  output.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(read_file(folder.file("target")), "new");
}

TEST(OutputFile, LeavesADeviceADevice) {
  TemporaryFiles files;
  OutputFile output = OutputFile::open("/dev/null", files);
  output.write("gone");
  output.commit();
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(OutputFile, SaysWhyItCannotBeMade) {
  TemporaryFiles files;
  const TemporaryFolder folder;
  EXPECT_THROW(OutputFile::open(folder.file("no/such/folder"), files),
               FileError);
  EXPECT_THROW(OutputFile::open(folder.path(), files), FileError);
  try {
    OutputFile::open(folder.file("no/a.slc"), files);
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("no/a.slc"), std::string::npos);
  }
}

TEST(OutputFile, AFullDiskIsAnError) {
  TemporaryFiles files;
  OutputFile output = OutputFile::open("/dev/full", files);
  output.write("x");
  EXPECT_THROW(output.commit(), FileError);
}

TEST(OutputFile, HasNoNameWhileItIsWritten) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  OutputFile output = OutputFile::open(folder.file("a"), files);
  output.write(std::string(1'000'000, 'x'));
  EXPECT_EQ(folder.entry_count(), 0U);
  output.commit();
  EXPECT_EQ(folder.entry_count(), 1U);
}

// The permissions of a file that the user makes himself.
TEST(OutputFile, ObeysTheMask) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  const mode_t mask = ::umask(027);
  for (int i = 0; i < 2; ++i) {  // new, then replaced
    OutputFile output = OutputFile::open(folder.file("a"), files);
    output.commit();
    struct stat status {};
    ASSERT_EQ(::stat(folder.file("a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0640U);
  }
  ::umask(mask);
}

TEST(TemporaryFiles, DiscardAllRemovesFolders) {
  const TemporaryFolder folder;
  // Never destroyed: after discard_all nothing can be, as in a process that
  // is about to end.
  static auto* const files = new TemporaryFiles;
  const auto made = files->make_folder(folder.file("a"));
  ::close(files->open_file_in(made, "image"));
  EXPECT_EQ(folder.entry_count(), 1U);
  files->discard_all();
  EXPECT_EQ(folder.entry_count(), 0U);
}

// --- What ended runs left ---------------------------------------------------

// A run that is killed: its descriptors close, its names stay.
TEST(TemporaryFiles, TheNextRunRemovesAnAbandonedFolder) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  const auto left = files.make_folder(folder.file("a"));
  ::close(files.open_file_in(left, "image"));
  ::close(left.lock);
  auto next = files.make_folder(folder.file("a"));
  EXPECT_EQ(next.path, left.path);
  EXPECT_TRUE(std::filesystem::is_empty(next.path));
  EXPECT_TRUE(files.commit_folder(next, folder.file("a")));
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(TemporaryFiles, WhatAnotherRunIsFillingStays) {
  const TemporaryFolder folder;
  TemporaryFiles one;
  TemporaryFiles other;
  auto first = one.make_folder(folder.file("a"));
  auto second = other.make_folder(folder.file("a"));
  EXPECT_NE(first.path, second.path);
  EXPECT_EQ(folder.entry_count(), 2U);
  one.discard_folder(first);
  other.discard_folder(second);
  EXPECT_EQ(folder.entry_count(), 0U);
}

// Whoever discards a name has it locked until it is gone; else it could be that
// of a run that found it free.
TEST(TemporaryFiles, RunsThatBeginAndEndTogetherKeepWhatTheyMade) {
  const TemporaryFolder folder;
  std::atomic<int> lost = 0;
  const auto run_again_and_again = [&] {
    TemporaryFiles files;
    for (int i = 0; i < 1000; ++i) {
      auto made = files.make_folder(folder.file("a"));
      const int file = files.open_file_in(made, "image");
      ::close(file);
      const auto image = std::filesystem::path(made.path) / "image";
      if (file < 0 || !std::filesystem::exists(image)) ++lost;
      files.discard_folder(made);
    }
  };
  std::vector<std::thread> runs;
  for (int i = 0; i < 4; ++i) runs.emplace_back(run_again_and_again);
  for (std::thread& run : runs) run.join();
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(TemporaryFiles, AnAbandonedFileIsRemovedWhenItsNameIsNeeded) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  folder.write("a", "old");
  folder.write(".a.lamina-0", "of a killed run");
  OutputFile output = OutputFile::open(folder.file("a"), files);
  output.write("new");
  output.commit();
  EXPECT_EQ(read_file(folder.file("a")), "new");
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(TemporaryFiles, NamesOfTheGreatestLengthHaveAHiddenOne) {
  const TemporaryFolder folder;
  TemporaryFiles files;
  const std::string name(255, 'a');
  folder.write(name, "old");
  OutputFile output = OutputFile::open(folder.file(name), files);
  output.write("new");
  output.commit();
  EXPECT_EQ(read_file(folder.file(name)), "new");
  EXPECT_EQ(folder.entry_count(), 1U);
}

}  // namespace
}  // namespace lamina::slicer
