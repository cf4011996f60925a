// What compiler and linker put into a release (LaminaHardening.cmake),
// read out of the finished files: a flag that is given, yet without effect,
// would not be seen elsewhere.

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/process.h"
#include "tests/support/text.h"

namespace lamina {
namespace {

std::string read_elf(const std::string& what, const std::string& file) {
  const auto result = support::run_process({"readelf", "-W", what, file});
  EXPECT_EQ(result.status, 0) << result.errors;
  return result.output;
}

using support::has;

// "R", "R E", "RW " …: of the segments of one kind.
std::vector<std::string> rights_of(const std::string& kind,
                                   const std::string& file) {
  std::istringstream lines(read_elf("--segments", file));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  " + kind + " ")) continue;
    // Type, offset, two addresses, two sizes, rights, alignment.
    const std::size_t end = line.rfind(" 0x");
    const std::size_t begin = line.rfind("0x", end - 1);
    all.push_back(line.substr(line.find(' ', begin) + 1, 3));
  }
  return all;
}

// The program and its modules.
class Hardening : public testing::TestWithParam<const char*> {};

TEST_P(Hardening, NoMemoryIsBothWrittenAndRun) {
  EXPECT_EQ(rights_of("GNU_STACK", GetParam()),
            std::vector<std::string>{"RW "});
  // Code lies apart from constants, which would lend it bytes to jump into.
  EXPECT_EQ(rights_of("LOAD", GetParam()),
            (std::vector<std::string>{"R  ", "R E", "R  ", "RW "}));
}

TEST_P(Hardening, TablesOfTheLoaderAreReadOnlyBeforeMain) {
  EXPECT_EQ(rights_of("GNU_RELRO", GetParam()),
            std::vector<std::string>{"R  "});
  EXPECT_TRUE(has(read_elf("--dynamic", GetParam()), "BIND_NOW"));
}

TEST_P(Hardening, LiesAtRandomAddresses) {
  EXPECT_TRUE(has(read_elf("--file-header", GetParam()), "DYN ("));
}

TEST_P(Hardening, ChecksStacks) {
  EXPECT_TRUE(has(read_elf("--dyn-syms", GetParam()), " __stack_chk_fail@"));
}

// Of the files below, in their order.
constexpr std::array kFileNames = {"Program", "TextModule", "CadModule",
                                   "DecimateModule", "HttpModule"};

INSTANTIATE_TEST_SUITE_P(
    Files, Hardening,
    testing::Values(LAMINA_PROGRAM, LAMINA_TEXT_MODULE, LAMINA_CAD_MODULE,
                    LAMINA_DECIMATE_MODULE, LAMINA_HTTP_MODULE),
    [](const auto& file) { return kFileNames[file.index]; });

TEST(HardenedProgram, ChecksBuffersAndContainers) {
  const std::string symbols = read_elf("--dyn-syms", LAMINA_PROGRAM);
  EXPECT_TRUE(has(symbols, " __memcpy_chk@")) << symbols;
  EXPECT_TRUE(has(symbols, "__glibcxx_assert_fail")) << symbols;
}

}  // namespace
}  // namespace lamina
