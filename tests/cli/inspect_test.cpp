#include <gtest/gtest.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Inspect, ASoundFileEndsWithZeroAndShowsItsFigures) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "difference() { cube([4, 5, 2]);"
               "translate([1, 1, -1]) cube([1, 1, 9]); }");
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.5"}).status, 0);
  const auto result = run(folder, {"inspect", "a.slc"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.output, "layers    4")) << result.output;
  EXPECT_TRUE(has(result.output, "loops     8, 4 of them holes; 32 vertices"));
  EXPECT_TRUE(has(result.output, "volume    38.000000 mm³"));
  EXPECT_TRUE(has(result.output, "defects   none"));
}

TEST(Inspect, LongFilesAreSummarisedUnlessAllIsWanted) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  ASSERT_EQ(run(folder, {"a.scad"}).status, 0);
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_LT(lines(run(folder, {"inspect", "a.slc"}).output), 50);
  EXPECT_GT(lines(run(folder, {"inspect", "--all", "a.slc"}).output), 200);
}

TEST(Inspect, ADefectEndsWithOne) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(2);");
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "2"}).status, 0);
  std::string bytes = support::read_file(folder.file("a.slc"));
  bytes[bytes.size() - 9] = 0x41;  // of the last vertex
  folder.write("b.slc", bytes);
  const auto result = run(folder, {"inspect", "b.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.output, "is not closed")) << result.output;
}

TEST(Inspect, WhatIsNoSlcEndsWithOne) {
  const TemporaryFolder folder;
  folder.write("a.slc", "Slice V0.2");
  const auto result = run(folder, {"inspect", "a.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "Stratasys")) << result.errors;
}

}  // namespace
}  // namespace lamina::cli
